"""A watch on the file of the open level, which may change on disk."""

from pathlib import Path

from sandbox.model.file_watching import PAUSE, Watch


class FileWatch:
    """Reports when a file has changed, once its writer has finished.

    A file that was changed at the last look is left for the next one: an editor may be half way.
    """

    def __init__(self) -> None:
        self._path: Path | None = None
        self._watch = Watch(())
        self._since = 0.0  # s
        self._writing = False

    def changed(self, path: Path | None, seconds: float) -> bool:
        """Let time pass [s], and return whether a file is another one than when it was shown.

        Of a file that was not asked for the last time, it is noted what it looks like.
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
