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
        help="Switch an effect that the level declares off, and what makes no sense without it."
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
    typer.Option(metavar="S", help="How long, in seconds; as the level says if left out."),
]
RateOption = Annotated[
    float | None,
    typer.Option(metavar="HZ", help="Steps a second; as the level says if left out."),
]
SchemeOption = Annotated[
    str | None,
    typer.Option(
        metavar="NAME",
        help="How a step is taken, as leapfrog or fourth-order; as the level says if left out.",
    ),
]
IterationsOption = Annotated[
    int | None,
    typer.Option(
        metavar="N",
        help="Sweeps of the solver over contacts and joints, a step; as the level says if left"
        " out.",
    ),
]
AccuracyOption = Annotated[
    float | None,
    typer.Option(
        "--accuracy",
        metavar="ERROR",
        help="Ask for the largest error that the level's checks may have, such as 1e-6, in place of"
        " a rate: the cheapest setting that reaches it is found out, and kept for the next time.",
        show_default=False,
    ),
]
RecordOption = Annotated[
    list[str] | None,
    typer.Option(
        metavar="QUANTITY",
        help="What to write a column of, such as ball.position.x or system.energy; 'all' is"
        " everything. Can be repeated. If left out: what the level's checks need, and the"
        " position and velocity of every body that moves freely.",
        show_default=False,
    ),
]
RaceOption = Annotated[
    bool,
    typer.Option(
        "--race", help="Let every scheme that the level can use run over it, up to four of them."
    ),
]
