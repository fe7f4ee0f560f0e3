"""The files that were opened recently, kept in the user's data folder."""

import os
from pathlib import Path

from pydantic import TypeAdapter

from sandbox.app.files import json_files
from sandbox.app.words.language import later, say
from sandbox.model.atomic_file_writing import data_folder

_PATHS = TypeAdapter(list[str])

MOST = 12
"""The largest number of files that are kept."""


def file() -> Path:
    """Return the path of the list; the file need not exist."""
    return data_folder() / "recent.json"


class RecentFiles:
    """The files that were opened recently.

    A list that is missing or not valid counts as empty.
    """

    def __init__(self) -> None:
        self.paths: tuple[Path, ...] = tuple(map(Path, filter(os.path.isfile, _read())))
        """The files that still exist, the latest first."""

    def add(self, path: Path) -> str:
        """Add an opened file and save the list; return why that fails, else an empty string."""
        if self.paths[:1] == (path,):
            return ""
        self.paths = (path, *(each for each in self.paths if each != path))[:MOST]
        others = [each for each in _read() if each != str(path)]  # with those of other windows
        why = json_files.write(file(), _PATHS, [str(path), *others][:MOST])
        message = later("the list of recent files could not be saved: {why}")
        return say(message, why=why) if why else ""


def _read() -> list[str]:
    found = json_files.read(file(), _PATHS, [])
    return [path for path in found if "\0" not in path and Path(path).is_absolute()][:MOST]
