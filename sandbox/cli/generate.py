"""`generate`: writes a level of many bodies."""

from pathlib import Path

import typer

from sandbox.model.atomic_file_writing import check_writable, write_atomically
from sandbox.model.level_writing import text
from sandbox.model.loading import parse
from sandbox.model.many_body_level_generator import crowd


def generate(kind: str, bodies: int, output: Path) -> None:
    """Write a level with a number of bodies."""
    check_writable(output)
    document = crowd(kind, bodies)
    content = text(document)
    parse(content, str(output))
    write_atomically(output, content)
    typer.echo(f"{output}: {document['title']}; watch it with 'play {output}'")
