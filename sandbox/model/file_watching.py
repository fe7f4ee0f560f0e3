"""A watch on files, which tells on request whether they have changed."""

from collections.abc import Iterable
from pathlib import Path

PAUSE = 0.2
"""The time between two looks at a file [s]."""

Stamp = tuple[int, int] | None
"""The modification time and length of a file; None if it does not exist."""


class Watch:
    """The state of some files at the last look."""

    def __init__(self, paths: Iterable[Path]) -> None:
        self._stamps = {path: stamp(path) for path in paths}

    def changed(self) -> set[Path]:
        """Look again, and return the files that have changed."""
        found = {path: stamp(path) for path in self._stamps}
        changed = {path for path, seen in found.items() if seen != self._stamps[path]}
        self._stamps = found
        return changed


def stamp(path: Path) -> Stamp:
    """Return the modification time and length of a file; None if it does not exist."""
    try:
        status = path.stat()
    except (OSError, ValueError):
        return None
    return status.st_mtime_ns, status.st_size
