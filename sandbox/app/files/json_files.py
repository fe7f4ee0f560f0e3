"""Small files in the user's data folder."""

import os
from contextlib import suppress
from pathlib import Path
from typing import TypeVar

from pydantic import TypeAdapter, ValidationError

from sandbox.app.words.language import say
from sandbox.model.atomic_file_writing import make_folder, write_atomically
from sandbox.model.errors import SandboxError
from sandbox.model.file_reading import read_ordinary

LARGEST = 1_000_000
"""The largest file that is read [bytes]; a larger one was not written by this program."""

ASIDE = ".broken"
"""Added to the name of a file that is not valid."""

Value = TypeVar("Value")


def read(file: Path, kind: TypeAdapter[Value], default: Value) -> Value:
    """Return the contents of a file; `default` if it is missing or not valid."""
    try:
        return kind.validate_json(read_ordinary(file, LARGEST) or b"")
    except (OSError, ValidationError):
        return default


def write(file: Path, kind: TypeAdapter[Value], value: Value) -> str:
    """Write a file, completely or not at all; return why that fails, else an empty string.

    What stands there and is not valid is kept beside it, as somebody may want to mend it.
    """
    try:
        make_folder(file.parent)
        _put_aside(file, kind)
        write_atomically(file, kind.dump_json(value, indent=1), follow=False)
    except (OSError, SandboxError, ValueError) as error:
        return say("{error}", error=error)
    return ""


def _put_aside(file: Path, kind: TypeAdapter[Value]) -> None:
    """Rename a file that is not valid."""
    with suppress(FileNotFoundError):
        content = read_ordinary(file, LARGEST)
        try:
            kind.validate_json(content or b"")
        except ValidationError:
            if content:
                os.replace(file, file.with_name(f"{file.name}{ASIDE}"))
