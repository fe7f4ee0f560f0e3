"""The commands, their arguments and their help."""

from pathlib import Path
from typing import Annotated

import typer

app = typer.Typer(
    name="sandbox",
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)

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


@app.callback(invoke_without_command=True)
def start(context: typer.Context) -> None:
    """Play with the textbook's mechanics, and see how closely it is kept.

    Without a command, the sandbox opens its window.

    Exit status: 0 if all is well, 1 if a check or a level failed, 2 for wrong usage.
    """
    if context.invoked_subcommand is None:
        from sandbox.cli.play import open_sandbox

        raise typer.Exit(open_sandbox())


@app.command()
def play(
    level: LevelArgument,
    set_: SetOption = None,
    accuracy: AccuracyOption = None,
    race: RaceOption = False,
) -> None:
    """Open a level in the window."""
    from sandbox.cli.play import play

    play(level, set_ or [], accuracy, racing=race)


@app.command("list")
def list_() -> None:
    """List the levels: their names, titles, effects and summaries.

    Into a file or another program, each level is one line with tabs between the four.
    """
    from sandbox.cli.list import show_levels

    show_levels()


@app.command()
def check(
    levels: Annotated[
        list[str],
        typer.Argument(
            metavar="LEVEL", help="Names of levels, or paths of files.", show_default=False
        ),
    ],
) -> None:
    """Check whether levels are well formed.

    Every mistake is shown with its file, line and column, the path inside the level, the rule that
    it breaks, and where possible what was probably meant; springs and drags that are too strong
    for the level's rate among them. Nothing is run.
    """
    from sandbox.cli.check import check

    raise typer.Exit(check(levels))


@app.command()
def simulate(
    level: LevelArgument,
    output: Annotated[
        Path,
        typer.Option(metavar="FILE.csv", help="The table that is written.", show_default=False),
    ],
    set_: SetOption = None,
    duration: DurationOption = None,
    rate: RateOption = None,
    scheme: SchemeOption = None,
    iterations: IterationsOption = None,
    accuracy: AccuracyOption = None,
    record: RecordOption = None,
    without: WithoutOption = None,
    with_: WithOption = None,
) -> None:
    """Run a level and write it as a CSV file.

    No window is opened. The comments at the top of the file say all that is needed to run it
    again. What the level's checks found is printed, and the exit status is 1 if one failed.

    With --without or --with the changed run is written, and what is printed is how it differs from
    the level as it is, in the quantities of its checks and in time.
    """
    from sandbox.cli.accuracy import Choice
    from sandbox.cli.simulate import simulate

    raise typer.Exit(
        simulate(
            level,
            output,
            set_ or [],
            duration,
            Choice(rate, scheme, iterations),
            record or [],
            without or [],
            with_ or [],
            accuracy,
        )
    )


@app.command()
def effects(level: LevelArgument, set_: SetOption = None) -> None:
    """Switch each effect of a level off in turn, and rank them by what they change.

    Shown is the quantity, of the level's checks and of where its bodies are, that the effect
    changes most, and what the effect costs a step. An effect that changes nothing is named.
    """
    from sandbox.cli.effects import weigh

    weigh(level, set_ or [])


@app.command()
def render(
    level: LevelArgument,
    output: Annotated[
        Path,
        typer.Option(metavar="FILE.png", help="The picture that is written.", show_default=False),
    ],
    set_: SetOption = None,
    at: Annotated[
        float | None,
        typer.Option(metavar="S", help="The time that is shown, in seconds.", show_default=False),
    ] = None,
    without: WithoutOption = None,
    with_: WithOption = None,
    accuracy: AccuracyOption = None,
    race: RaceOption = False,
) -> None:
    """Draw a level as a PNG picture, without a window.

    With --without or --with the changed run is drawn, over the level as it is: dashed.
    """
    from sandbox.cli.render import render

    render(level, output, set_ or [], at, without or [], with_ or [], accuracy, racing=race)


@app.command()
def describe(
    level: LevelArgument,
    set_: SetOption = None,
    at: Annotated[
        float, typer.Option(metavar="S", help="The time that is described, in seconds.")
    ] = 0.0,
) -> None:
    """Say in words what is on the stage: for a terminal, or a screen reader.

    Told are the parameters, where each body is and how it moves, what ties bodies together and with
    which force, what touches, and how the checks stand.
    """
    from sandbox.cli.describe import describe

    describe(level, set_ or [], at)


@app.command()
def generate(
    kind: Annotated[
        str,
        typer.Argument(metavar="SCENE", help="gas, pile, chain or cluster.", show_default=False),
    ],
    output: Annotated[
        Path,
        typer.Option(metavar="FILE.json", help="The level that is written.", show_default=False),
    ],
    bodies: Annotated[
        int, typer.Option(metavar="N", help="How many bodies move.", show_default=True)
    ] = 1000,
) -> None:
    """Write a level of many bodies, to watch or to measure."""
    from sandbox.cli.generate import generate

    generate(kind, bodies, output)


@app.command()
def tour(
    output: Annotated[
        Path,
        typer.Option(metavar="DIR", help="The folder for it; made if missing.", show_default=False),
    ],
) -> None:
    """Run, check and draw every level, without a window.

    The folder receives a picture of each level, and an index.html that shows them all with what
    their checks found. The exit status is 1 if any level or check failed.
    """
    from sandbox.cli.tour import tour

    raise typer.Exit(tour(output))
