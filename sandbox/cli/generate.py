"""`generate`: a level of many bodies as a file."""

from pathlib import Path

import typer

from sandbox.cli import usage
from sandbox.model.crowds import crowd
from sandbox.model.files import write_atomically
from sandbox.model.loading import parse
from sandbox.model.writing import text


def generate(kind: str, bodies: int, output: Path) -> None:
    """Write a level with so many bodies."""
    usage.output_file(output)
    document = crowd(kind, bodies)
    said = text(document)
    parse(said, str(output))
    write_atomically(output, said)
    typer.echo(f"{output}: {document['title']}; watch it with 'play {output}'")
