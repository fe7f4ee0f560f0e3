"""Files of unsaved work, which outlive a process that dies.

Each is written atomically, is named after the process that keeps it, and is deleted once the work
is saved or given up. Those of processes that have ended can be recovered.
"""

import os
import re
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from uuid import uuid4

from sandbox.model.atomic_file_writing import lives, make_folder, write_atomically
from sandbox.model.errors import SandboxError
from sandbox.model.translatable_message import NOTHING, Message

_NAME = re.compile(r"(?:(\d+)-)?[0-9a-f]{32}\..+")
"""The name of such a file: the process, which the first versions did not name, and a number."""

_OPEN = set[str]()
"""The names of the files that this process keeps."""


class UnsavedFile:
    """The file of some work; it is not made before it is written."""

    def __init__(self, ending: str) -> None:
        self._name = f"{os.getpid()}-{uuid4().hex}{ending}"

    def write(self, folder: Path, text: str) -> Message:
        """Write the file into a folder, made if missing; return the reason if that failed."""
        try:
            make_folder(folder)
            _OPEN.add(self._name)
            write_atomically(folder / self._name, text, follow=False)
        except SandboxError as error:
            return Message(
                "unsaved changes cannot be stored, and are lost if this window crashes: {error}",
                error=error.message,
            )
        return NOTHING

    def forget(self, folder: Path) -> None:
        """Delete the file."""
        delete(folder / self._name)
        _OPEN.discard(self._name)


def leftovers(folder: Path, ending: str) -> Iterator[Path]:
    """Yield the files in a folder that were left by processes that have ended."""
    for file in folder.glob(f"*{ending}"):
        found = _NAME.fullmatch(file.name)
        process = int(found[1] or os.getpid()) if found else None
        if process is None or file.name in _OPEN:
            continue
        if process == os.getpid() or not lives(process):
            yield file


def delete(file: Path) -> None:
    """Delete a file, as far as that is possible."""
    with suppress(OSError):
        file.unlink(missing_ok=True)
