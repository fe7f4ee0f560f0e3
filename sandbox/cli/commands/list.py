"""The command `list`."""


def command() -> None:
    """List the levels: their names, titles, effects and summaries.

    If the output is not a terminal, each level is one line, with tabs between the columns.
    """
    from sandbox.cli.list import show_levels

    show_levels()
