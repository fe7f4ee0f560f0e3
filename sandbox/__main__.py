"""The command line: `python -m sandbox`, and the console script `mechanics-sandbox`."""

from sandbox import environment_defaults, interrupts, standard_streams


def main() -> None:
    """Run the command line, and leave the process with its exit status."""
    interrupts.install()
    standard_streams.install()
    environment_defaults.install()
    with standard_streams.standard():
        from sandbox.cli.main import main as run  # that takes a while, and may be interrupted, too

        run()


if __name__ == "__main__":
    main()
