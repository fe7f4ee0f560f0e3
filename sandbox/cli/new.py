"""`new`: writes a level as a start for your own."""

import os
from pathlib import Path

import typer

from sandbox.cli import argument_parsing
from sandbox.model import level_catalog, templates
from sandbox.model.atomic_file_writing import check_writable, without_links, write_atomically
from sandbox.model.did_you_mean import suggestion
from sandbox.model.errors import LevelError, brief
from sandbox.model.level_writing import with_schema
from sandbox.model.loading import parse, read

_ENDING = ".json"


def new(name: str, template: str) -> None:
    """Write the file of a new level, a copy of a template or of another level.

    Raises `UsageError` if the file cannot be written, or there is no such template. Raises
    `TakenError` if the file already exists. Raises `LevelError` if the other level has mistakes.
    """
    target = _target(name)
    source = _source(template)
    typed = read(source)
    level = parse(typed, str(source))
    write_atomically(target, with_schema(typed, _schema(target)), new=True)
    typer.echo(
        f"{target}: {level.title}; open it with 'play {target}', and let 'check --watch {target}'"
        " tell mistakes while you write"
    )


def _target(name: str) -> Path:
    """Return the path of a new level."""
    stem = name.removesuffix(_ENDING)
    if not stem or stem.endswith((os.sep, "/", ".")):
        raise argument_parsing.UsageError(f"'{brief(name)}' is no name of a file; such as my-level")
    path = Path(stem + _ENDING)
    if not os.path.lexists(path):  # the writer reports an existing file
        check_writable(path)
    return path


def _source(template: str) -> Path:
    """Return the file of a template or of a level."""
    names = templates.names()
    if template in names:
        return templates.path(template)
    try:
        return level_catalog.find(template)
    except LevelError:
        levels = level_catalog.names()
        hint = suggestion(template, levels if "/" in template else names)
        rule = f"is neither a template nor a level{hint}"
        raise argument_parsing.UsageError(f"--from {brief(template)}: {rule}") from None


def _schema(target: Path) -> str:
    """Return the path of the schema as seen from a level's file: relative within a checkout."""
    schema, folder = level_catalog.root() / level_catalog.SCHEMA, without_links(target).parent
    if folder.is_relative_to(schema.parent.parent):
        return Path(os.path.relpath(schema, folder)).as_posix()
    return schema.as_uri()
