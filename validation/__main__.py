"""`python -m validation`."""

from sandbox import environment_defaults, interrupts, streams


def main() -> None:
    """Run the command line, and exit with its status."""
    interrupts.install()
    streams.install()
    environment_defaults.install()
    with streams.standard():
        from validation.cli import app  # takes a while, and may be interrupted as well

        app()


if __name__ == "__main__":
    main()
