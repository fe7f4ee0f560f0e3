"""Watches the file of the open level for changes on disk."""

from pathlib import Path

from sandbox.model.file_watching import PAUSE, Watch


class FileWatch:
    """Reports that a file has changed, once its writer has finished.

    A change is reported only when the next check finds no further one: an editor may still be
    writing.
    """

    def __init__(self) -> None:
        self._path: Path | None = None
        self._watch = Watch(())
        self._since = 0.0  # s
        self._writing = False

    def changed(self, path: Path | None, seconds: float) -> bool:
        """Advance by some time [s], and return whether a file has changed since the first call.

        A call with another path starts a new watch.
        """
        if path != self._path:
            self._path, self._watch = path, Watch([path] if path is not None else [])
            self._since, self._writing = 0.0, False
        self._since += seconds
        if self._path is None or self._since < PAUSE:
            return False
        self._since = 0.0
        writing, self._writing = self._writing, bool(self._watch.changed())
        return writing and not self._writing
