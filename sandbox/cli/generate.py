"""`generate`: writes a level of many bodies."""

from pathlib import Path

import typer

from sandbox.cli import argument_parsing
from sandbox.model.crowd_levels import crowd
from sandbox.model.files import write_atomically
from sandbox.model.loading import parse
from sandbox.model.writing import text


def generate(kind: str, bodies: int, output: Path) -> None:
    """Write a level with a number of bodies."""
    argument_parsing.output_file(output)
    document = crowd(kind, bodies)
    said = text(document)
    parse(said, str(output))
    write_atomically(output, said)
    typer.echo(f"{output}: {document['title']}; watch it with 'play {output}'")
