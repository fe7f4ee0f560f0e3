"""Small files in the user's data folder."""

from pathlib import Path
from typing import TypeVar

from pydantic import TypeAdapter, ValidationError

from sandbox.app.words.language import say
from sandbox.model.errors import SandboxError
from sandbox.model.file_writing import make_folder, read_ordinary, write_atomically

LARGEST = 1_000_000
"""The largest file that is read [bytes]; a larger one was not written by this program."""

Value = TypeVar("Value")


def read(file: Path, kind: TypeAdapter[Value], otherwise: Value) -> Value:
    """Return the contents of a file; `otherwise` if it is missing or not valid."""
    try:
        return kind.validate_json(read_ordinary(file, LARGEST) or b"")
    except (OSError, ValidationError):
        return otherwise


def keep(file: Path, kind: TypeAdapter[Value], value: Value) -> str:
    """Write a file, completely or not at all; return why that fails, else an empty string."""
    try:
        make_folder(file.parent)
        write_atomically(file, kind.dump_json(value, indent=1), follow=False)
    except (OSError, SandboxError, ValueError) as error:
        return say("{error}", error=error)
    return ""
