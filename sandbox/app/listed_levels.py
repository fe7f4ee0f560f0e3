"""The level files in the window's list: those of the catalogue, and the user's own."""

from pathlib import Path

from sandbox.app.files.level_list_entries import entry
from sandbox.app.files.recent_files import RecentFiles
from sandbox.app.panels import level_list


class ListedLevels:
    """The list of levels."""

    def __init__(self) -> None:
        self.recent = RecentFiles()
        """The files that were opened recently."""
        opened = (entry(path, "opened") for path in self.recent.paths)
        self.entries = [*opened, *level_list.entries()]
        """The entries of the list, in its order."""

    def translate(self) -> None:
        """Translate the list into the current language."""
        self.entries = [entry.in_current_language() for entry in self.entries]

    def read_again(self, path: Path) -> None:
        """Update the entry of a file; add one if there was none."""
        for i, old_entry in enumerate(self.entries):
            if old_entry.path == path:
                self.entries[i] = entry(path, old_entry.chapter)
                return
        self.entries.insert(0, entry(path, "opened"))

    def neighbour(self, path: Path | None, direction: int) -> Path | None:
        """Return the next or the previous level, cyclically; None if the list is empty."""
        paths = [entry.path for entry in self.entries]
        if not paths:
            return None
        index = paths.index(path) if path in paths else -min(direction, 0)
        return paths[(index + direction) % len(paths)]
