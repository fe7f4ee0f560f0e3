"""Arguments and options that several commands have."""

from typing import Annotated, Any

import typer


def argument(metavar: str, text: str) -> Any:  # noqa: ANN401 (typer's own type)
    """Return an argument; if it can be left out, its help says what that means.

    Whoever reads a file says better than typer why it cannot be read.
    """
    return typer.Argument(metavar=metavar, help=text, show_default=False, readable=False)


def option(metavar: str, text: str, *names: str) -> Any:  # noqa: ANN401 (typer's own type)
    """Return an option with a value, as `argument` does."""
    return typer.Option(*names, metavar=metavar, help=text, show_default=False, readable=False)


LevelsArgument = Annotated[list[str], argument("LEVEL", "Names of levels, or paths of files.")]
LevelArgument = Annotated[
    str,
    argument(
        "LEVEL", "A name that 'list' shows, such as newton/atwood, or the path of a level's file."
    ),
]
SetOption = Annotated[
    list[str] | None,
    option(
        "NAME=VALUE",
        "Give a parameter of the level another value, in the parameter's own unit:"
        " --set m2=3. Can be repeated.",
        "--set",
    ),
]
WithoutOption = Annotated[
    list[str] | None,
    option(
        "EFFECT",
        "Switch off an effect that the level declares, and whatever makes no sense without it."
        " Can be repeated.",
        "--without",
    ),
]
WithOption = Annotated[
    list[str] | None,
    option(
        "EFFECT[.SETTING=VALUE]",
        "Switch an effect on, or set it: --with drag.linear=0.1. Can be repeated.",
        "--with",
    ),
]
DurationOption = Annotated[
    float | None, option("S", "The duration of the run, in seconds. Default: the level's own.")
]
RateOption = Annotated[float | None, option("HZ", "Steps per second. Default: the level's own.")]
SchemeOption = Annotated[
    str | None,
    option(
        "NAME",
        "The scheme of integration, such as leapfrog or fourth-order. Default: the level's own.",
    ),
]
IterationsOption = Annotated[
    int | None,
    option(
        "N",
        "Iterations of the solver over contacts and joints in each step. Default: the level's own.",
    ),
]
SolverOption = Annotated[
    str | None,
    option(
        "NAME",
        "direct solves contacts directly, where the level leaves that open. Default: the"
        " level's own.",
    ),
]
AccuracyOption = Annotated[
    float | None,
    option(
        "ERROR",
        "The largest error that the level's checks may have, such as 1e-6, instead of a rate."
        " The cheapest setting that reaches it is searched for, and kept for the next time.",
        "--accuracy",
    ),
]
RecordOption = Annotated[
    list[str] | None,
    option(
        "QUANTITY",
        "A quantity to write as a column, such as ball.position.x or system.energy; 'all' for"
        " everything. Can be repeated. Default: what the level's checks need, and the position and"
        " velocity of every body that moves freely.",
    ),
]
RaceOption = Annotated[
    bool,
    typer.Option(
        "--race",
        help="Draw the runs of the other schemes that the level can use, up to four, over it.",
    ),
]
FirstPictureOption = Annotated[
    bool,
    typer.Option(
        "--first-picture",
        help="Close the window after its first picture, and print when it was there, in seconds of"
        " a clock that all processes share. Needs no display.",
    ),
]
