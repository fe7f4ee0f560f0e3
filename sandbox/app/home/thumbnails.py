"""The pictures on the cards, read from disk or drawn in the background without waiting."""

from collections.abc import Sequence
from io import BytesIO
from pathlib import Path

import pygame

from sandbox.app.background_process import BackgroundTask
from sandbox.app.home import picture_cache
from sandbox.app.home.picture_cache import SIZE

AT_ONCE = 3
"""The number of pictures that are read from disk per frame."""
BATCH = 16
"""The largest number of levels that are ordered at once."""
ENOUGH = 32
"""After this many pictures, another process draws the next ones, as its time is limited."""
MOST = 80
"""The number of pictures that are kept in memory: more than are ever visible at once."""


class Thumbnails(BackgroundTask):
    """Loads and draws the pictures of levels."""

    def __init__(self) -> None:
        super().__init__()
        self._pictures: dict[Path, pygame.Surface] = {}  # least recently used first
        self._lacking: set[Path] = set()  # not on disk
        self._kept: set[Path] = set()  # on disk, unless they could not be saved
        self._hopeless: set[Path] = set()  # cannot be drawn
        self._drawing: list[Path] = []  # ordered; the first is being drawn
        self._drawn = 0  # by the process
        self._size = SIZE

    def forget(self) -> None:
        """Forget all pictures, since files may have changed."""
        for cache in (self._pictures, self._lacking, self._kept, self._hopeless):
            cache.clear()

    def of(self, path: Path) -> pygame.Surface | None:
        """Return the picture of a level; None if it is not ready."""
        found = self._pictures.pop(path, None)
        if found is not None:
            self._pictures[path] = found
        return found

    def hopeless(self, path: Path) -> bool:
        """Whether a level cannot be drawn."""
        return path in self._hopeless

    def resize(self, size: tuple[int, int]) -> None:
        """Set the size of the pictures [px]."""
        if size != self._size:
            self._size = size
            self._pictures.clear()

    def follow(self, seen: Sequence[Path], others: Sequence[Path]) -> None:
        """Take in finished pictures, and request more: visible cards first, then the others."""
        came = False
        for made in self._work.results():
            came, self._drawn = True, self._drawn + 1
            self._drawing = [path for path in self._drawing if path != made.path]
            self._take(made.path, made.png, seen=made.path in seen)
        if not self._work.running:
            self._hopeless.update(self._drawing[:1])  # at which the process ended early
            self._drawing = []
        waiting = [path for path in seen if self._unknown(path)]
        for path in waiting[:AT_ONCE]:
            self._look_up(path)
        for_nobody = not any(path in self._drawing for path in seen)
        hurried = for_nobody and any(path in self._lacking for path in seen)
        if not waiting and (not self._drawing or (hurried and came)):
            self._order(seen, others)

    def _unknown(self, path: Path) -> bool:
        """Whether the picture of a visible card has not been looked up yet."""
        is_known = path in self._pictures or path in self._lacking or path in self._hopeless
        return not is_known and path not in self._drawing

    def _look_up(self, path: Path) -> None:
        try:
            png = picture_cache.cached(picture_cache.key(path))
        except OSError:
            self._hopeless.add(path)
            return
        if png:
            self._take(path, png, seen=True)
        else:
            self._lacking.add(path)

    def _order(self, seen: Sequence[Path], others: Sequence[Path]) -> None:
        """Order the next few levels, after the one that is being drawn; or end the process."""
        known = self._kept | self._hopeless
        wanted = [path for path in seen if path in self._lacking]
        wanted += [path for path in others if path not in known and path not in wanted]
        if not (wanted or self._drawing) or (self._drawn >= ENOUGH and not self._drawing):
            self._work.cancel()
        if not wanted:
            return
        if not self._work.running:
            self._drawn = 0
            self._work.start(picture_cache.draw_all, picture_cache.folder(), listens=True)
        now = self._drawing[:1]
        self._drawing = now + [path for path in wanted if path not in now][:BATCH]
        self._work.send(list(self._drawing))

    def _take(self, path: Path, png: bytes, *, seen: bool) -> None:
        """Keep a finished picture of a visible card; an invalid one marks its level as hopeless."""
        self._lacking.discard(path)
        self._kept.add(path)
        if not seen and png:
            return  # it will be read from disk once it is visible
        try:
            drawn = pygame.image.load(BytesIO(png), "x.png").convert()
        except pygame.error:
            self._hopeless.add(path)
            return
        self._pictures[path] = pygame.transform.smoothscale(drawn, self._size)
        while len(self._pictures) > MOST:
            self._pictures.pop(next(iter(self._pictures)))

    def cancel(self) -> None:
        """Stop drawing."""
        super().cancel()
        self._drawing = []
