"""`python -m validation`."""

from sandbox import program


def main() -> None:
    """Run the command line, and exit with its status."""
    with program.started():
        from validation.cli import app  # takes a while, and may be interrupted as well

        app()


if __name__ == "__main__":
    main()
