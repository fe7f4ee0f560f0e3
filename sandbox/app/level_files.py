"""The files of levels that the window lists: those of the catalogue, and a person's own."""

from pathlib import Path

from sandbox.app.files.level_entries import entry
from sandbox.app.files.recent import Recent
from sandbox.app.panels import levels


class LevelFiles:
    """All levels that can be chosen.

    Attributes
    ----------
    entries
        What the list shows of each, in its order.
    recent
        The files that were opened last.
    """

    def __init__(self) -> None:
        self.recent = Recent()
        opened = (entry(path, "opened") for path in self.recent.paths)
        self.entries = [*opened, *levels.entries()]

    def say_anew(self) -> None:
        """Show the list in the present language."""
        self.entries = [known.said_anew() for known in self.entries]

    def read_again(self, path: Path) -> None:
        """Let the list say what a file is called now; list it, if it was not there."""
        for i, known in enumerate(self.entries):
            if known.path == path:
                self.entries[i] = entry(path, known.chapter)
                return
        self.entries.insert(0, entry(path, "opened"))

    def neighbour(self, path: Path | None, direction: int) -> Path | None:
        """Return the next level, or the previous one, in a circle; None if there is none."""
        paths = [known.path for known in self.entries]
        if not paths:
            return None
        here = paths.index(path) if path in paths else -min(direction, 0)
        return paths[(here + direction) % len(paths)]
