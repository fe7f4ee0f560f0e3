"""The command `list`."""


def command() -> None:
    """List the levels: their names, titles, effects and summaries.

    Into a file or another program, each level is one line with tabs between the four.
    """
    from sandbox.cli.list import show_levels

    show_levels()
