"""The command `generate`."""

from pathlib import Path
from typing import Annotated

import typer


def command(
    kind: Annotated[
        str,
        typer.Argument(
            metavar="SCENE",
            help="The kind of scene: gas, pile, chain or cluster.",
            show_default=False,
        ),
    ],
    output: Annotated[
        Path,
        typer.Option(metavar="FILE.json", help="The file to write.", show_default=False),
    ],
    bodies: Annotated[
        int, typer.Option(metavar="N", help="The number of moving bodies.", show_default=True)
    ] = 1000,
) -> None:
    """Write a level with many bodies, to watch or to measure."""
    from sandbox.cli.generate import generate

    generate(kind, bodies, output)
