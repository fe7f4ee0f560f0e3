"""`python -m validation`."""

from sandbox import environment_defaults, interrupts, streams


def main() -> None:
    """Run the command line, and leave the process with its exit status."""
    interrupts.install()
    streams.install()
    environment_defaults.install()
    with streams.standard():
        from validation.cli import app  # that takes a while, and may be interrupted, too

        app()


if __name__ == "__main__":
    main()
