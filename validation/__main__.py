"""`python -m validation`."""

from sandbox import interrupts, plugins, streams, threads


def main() -> None:
    """Run the command line, and leave the process with its exit status."""
    interrupts.install()
    streams.install()
    threads.spare()
    plugins.spare()
    with streams.standard():
        from validation.cli import app  # that takes a while, and may be interrupted, too

        app()


if __name__ == "__main__":
    main()
