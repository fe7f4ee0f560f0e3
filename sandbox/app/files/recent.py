"""The files that were opened recently, kept in the user's data folder."""

import os
from pathlib import Path

from pydantic import TypeAdapter

from sandbox.app.files import user_data
from sandbox.app.words.language import later, say
from sandbox.model.files import data_folder

_PATHS = TypeAdapter(list[str])

MOST = 12
"""How many files are remembered."""


def file() -> Path:
    """Return where they are kept; it need not be there."""
    return data_folder() / "recent.json"


class Recent:
    """The files that were opened last.

    A file that is missing, or that something else has written, counts as none.

    Attributes
    ----------
    paths
        The files that are still there, the latest first.
    """

    def __init__(self) -> None:
        self.paths: tuple[Path, ...] = tuple(map(Path, filter(os.path.isfile, _read())))

    def add(self, path: Path) -> str:
        """Note that a file was opened; return why that cannot be kept, if so."""
        if self.paths[:1] == (path,):
            return ""
        self.paths = (path, *(each for each in self.paths if each != path))[:MOST]
        others = [each for each in _read() if each != str(path)]  # another window's, too
        why = user_data.keep(file(), _PATHS, [str(path), *others][:MOST])
        message = later("the list of recent files could not be saved: {why}")
        return say(message, why=why) if why else ""


def _read() -> list[str]:
    found = user_data.read(file(), _PATHS, [])
    return [path for path in found if "\0" not in path and Path(path).is_absolute()][:MOST]
