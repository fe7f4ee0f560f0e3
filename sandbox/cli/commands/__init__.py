"""The commands: what they are called, their arguments and their help, and one list of them.

What a command does is in the module of its name beside this package, which is imported when it is
called: the help of all commands has to be there at once.
"""

import typer

from sandbox.cli.commands.levels import check, describe, format_, generate, list_, migrate, new
from sandbox.cli.commands.runs import effects, experiment, replay, simulate
from sandbox.cli.commands.window_and_pictures import bench, play, render, tour, uncollected

COMMANDS = (
    play, list_, new, check, format_, migrate, simulate, describe, effects, experiment, render,
    replay, generate, tour, bench,
)  # fmt: skip
"""All commands in the order of the help."""

app = typer.Typer(
    name="sandbox",
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)

for _command in COMMANDS:
    app.command(_command.__name__.rstrip("_"))(_command)


@app.callback(invoke_without_command=True)
def start(context: typer.Context) -> None:
    """Play with the textbook's mechanics, and see how closely it is kept.

    Without a command, the sandbox opens its window.

    Exit status: 0 if all is well, 1 if a check, a level, or reading or writing a file failed, 2
    for wrong usage.
    """
    if context.invoked_subcommand is None:
        with uncollected():
            from sandbox.cli.play import open_sandbox

            raise typer.Exit(open_sandbox())
