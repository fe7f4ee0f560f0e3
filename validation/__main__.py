"""`python -m validation`."""

from sandbox import environment_defaults, interrupts, standard_streams


def main() -> None:
    """Run the command line, and exit with its status."""
    interrupts.install()
    standard_streams.install()
    environment_defaults.install()
    with standard_streams.standard():
        from validation.cli import app  # takes a while, and may be interrupted as well

        app()


if __name__ == "__main__":
    main()
