"""A watch on files, which says when asked whether they have changed."""

from collections.abc import Iterable
from pathlib import Path

PAUSE = 0.2
"""s, between two looks at a file."""

Stamp = tuple[int, int] | None
"""When a file was written and how long it is; None if it is not there."""


class Watch:
    """The state of some files when they were last looked at."""

    def __init__(self, paths: Iterable[Path]) -> None:
        self._stamps = {path: stamp(path) for path in paths}

    def changed(self) -> set[Path]:
        """Look again, and return the files that are no longer as they were."""
        found = {path: stamp(path) for path in self._stamps}
        changed = {path for path, seen in found.items() if seen != self._stamps[path]}
        self._stamps = found
        return changed


def stamp(path: Path) -> Stamp:
    """Return when a file was written and how long it is; None if it is not there."""
    try:
        status = path.stat()
    except (OSError, ValueError):
        return None
    return status.st_mtime_ns, status.st_size
