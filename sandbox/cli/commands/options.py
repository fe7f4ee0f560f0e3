"""Arguments and options that several commands have."""

from typing import Annotated

import typer

LevelArgument = Annotated[
    str,
    typer.Argument(
        metavar="LEVEL",
        help="A name that 'list' shows, such as newton/atwood, or the path of a level's file.",
        show_default=False,
    ),
]
SetOption = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="NAME=VALUE",
        help="Give a parameter of the level another value, in the parameter's own unit:"
        " --set m2=3. Can be repeated.",
        show_default=False,
    ),
]
WithoutOption = Annotated[
    list[str] | None,
    typer.Option(
        "--without",
        metavar="EFFECT",
        help="Switch off an effect that the level declares, and whatever makes no sense without it."
        " Can be repeated.",
        show_default=False,
    ),
]
WithOption = Annotated[
    list[str] | None,
    typer.Option(
        "--with",
        metavar="EFFECT[.SETTING=VALUE]",
        help="Switch an effect on, or set it: --with drag.linear=0.1. Can be repeated.",
        show_default=False,
    ),
]
DurationOption = Annotated[
    float | None,
    typer.Option(
        metavar="S", help="The duration of the run, in seconds. Default: the level's own."
    ),
]
RateOption = Annotated[
    float | None,
    typer.Option(metavar="HZ", help="Steps per second. Default: the level's own."),
]
SchemeOption = Annotated[
    str | None,
    typer.Option(
        metavar="NAME",
        help="The scheme of integration, such as leapfrog or fourth-order. Default: the level's"
        " own.",
    ),
]
IterationsOption = Annotated[
    int | None,
    typer.Option(
        metavar="N",
        help="Iterations of the solver over contacts and joints in each step. Default: the level's"
        " own.",
    ),
]
SolverOption = Annotated[
    str | None,
    typer.Option(
        metavar="NAME",
        help="direct solves contacts directly, where the level leaves that open. Default: the"
        " level's own.",
    ),
]
AccuracyOption = Annotated[
    float | None,
    typer.Option(
        "--accuracy",
        metavar="ERROR",
        help="The largest error that the level's checks may have, such as 1e-6, instead of a rate."
        " The cheapest setting that reaches it is searched for, and kept for the next time.",
        show_default=False,
    ),
]
RecordOption = Annotated[
    list[str] | None,
    typer.Option(
        metavar="QUANTITY",
        help="A quantity to write as a column, such as ball.position.x or system.energy; 'all' for"
        " everything. Can be repeated. Default: what the level's checks need, and the position and"
        " velocity of every body that moves freely.",
        show_default=False,
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
