"""`migrate`: brings levels to the newest version of the format; so far there is only one."""

from collections.abc import Sequence

import typer

from sandbox.cli.argument_parsing import levels
from sandbox.model import level_catalog
from sandbox.model.errors import SandboxError
from sandbox.model.json_document import Document, refuse
from sandbox.model.level_parts import Fault
from sandbox.model.loading import read
from sandbox.model.translatable_message import Message

NEWEST = 1
"""The newest version of the level format."""


def migrate(arguments: Sequence[str]) -> int:
    """Print the version of each level, and return the exit status."""
    bad = 0
    for argument in arguments:
        try:
            version = _version(argument)
        except SandboxError as error:
            bad += 1
            typer.echo(error, err=True)
        else:
            typer.echo(f"{argument}: format {version}, the newest; nothing to do")
    if bad:
        typer.echo(f"{bad} of {levels(len(arguments))} cannot be migrated", err=True)
    return int(bad > 0)


def _version(argument: str) -> int:
    """Return the format version of a level's file, ignoring all else; refuse an unknown one."""
    path = level_catalog.find(argument)
    document = Document(read(path), str(path))
    data = document.read()
    if not isinstance(data, dict):
        refuse(str(path), "is no level, which is an object, {...}")
    if "format" not in data:
        refuse(
            str(path),
            "has no 'format', the version of the format: \"format\": {newest}",
            newest=NEWEST,
        )
    version = data["format"]
    if type(version) is not int or version < 1:  # True equals 1
        document.refuse(
            [
                Fault(
                    ("format",),
                    "must be a whole number from 1; the newest is {newest}",
                    newest=NEWEST,
                )
            ]
        )
    if version > NEWEST:
        rule = Message(
            "is not known: the newest version here is {newest}; a newer sandbox may know it",
            newest=NEWEST,
        )
        document.refuse([Fault(("format",), rule)])
    return version
