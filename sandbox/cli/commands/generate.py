"""The command `generate`."""

from pathlib import Path
from typing import Annotated

import typer

from sandbox.cli.commands.options import argument, option


def command(
    kind: Annotated[str, argument("SCENE", "The kind of scene: gas, pile, chain or cluster.")],
    output: Annotated[Path, option("FILE.json", "The file to write.")],
    bodies: Annotated[
        int, typer.Option(metavar="N", help="The number of moving bodies.", show_default=True)
    ] = 1000,
) -> None:
    """Write a level with many bodies, to watch or to measure."""
    from sandbox.cli.generate import generate

    generate(kind, bodies, output)
