"""The commands: one module each, which says its arguments and its help, and one list of them.

A module has one function, `command`. What that does is imported when it is called: the help of all
commands has to be there at once.
"""

import typer

from sandbox.cli.commands import (
    bench,
    check,
    describe,
    effects,
    experiment,
    generate,
    migrate,
    new,
    play,
    render,
    replay,
    simulate,
    tour,
)
from sandbox.cli.commands import format as formatting
from sandbox.cli.commands import list as listing

COMMANDS = (
    play,
    listing,
    new,
    check,
    formatting,
    migrate,
    simulate,
    describe,
    effects,
    experiment,
    render,
    replay,
    generate,
    tour,
    bench,
)
"""All commands in the order of the help; each is named after its module."""

app = typer.Typer(
    name="sandbox",
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)

for _module in COMMANDS:
    app.command(_module.__name__.rpartition(".")[2])(_module.command)


@app.callback(invoke_without_command=True)
def start(context: typer.Context) -> None:
    """Play with the textbook's mechanics, and see how closely it is kept.

    Without a command, the sandbox opens its window.

    Exit status: 0 if all is well, 1 if a check, a level or the writing of a file failed, 2 for
    wrong usage.
    """
    if context.invoked_subcommand is None:
        with play.uncollected():
            from sandbox.cli.play import open_sandbox

            raise typer.Exit(open_sandbox())
