"""The commands of `python -m validation`: one module each, and one list of them.

Each module has one function, `command`, which declares its arguments and its help, and returns
whether all is well. Slow imports are made when it is called.
"""

import typer

from validation.cli import compose, cost, effects, fuzz, pace, report, requests, run, stability
from validation.cli.options import with_status

COMMANDS = (run, compose, cost, requests, pace, effects, report, stability, fuzz)
"""All commands in the order of the help; each is named after its module."""

app = typer.Typer(
    name="validation",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)

for _module in COMMANDS:
    app.command(_module.__name__.rpartition(".")[2])(with_status(_module.command))


@app.callback()
def validation() -> None:
    """Validate the sandbox against the textbook, case by case, beside stock pymunk."""
