"""The command line: `python -m sandbox`, and the console script `mechanics-sandbox`."""

from sandbox import program


def main() -> None:
    """Run the command line, and leave the process with its exit status."""
    with program.started():
        from sandbox.cli.main import main as run  # that takes a while, and may be interrupted, too

        run()


if __name__ == "__main__":
    main()
