"""Places labels so that none covers another."""

from collections.abc import Iterable, Mapping, Sequence
from itertools import chain

import pygame

from sandbox.model.shapes import XY


class Labels:
    """The areas of a picture that are occupied by labels and lines.

    `kept` has the last place of each named label, as an index: a label stays there from picture to
    picture while no other place is better.
    """

    def __init__(self, bounds: pygame.Rect, kept: dict[str, int] | None = None) -> None:
        self.bounds = bounds
        """The area for labels [px]."""
        self._kept = {} if kept is None else kept
        self._taken: list[pygame.Rect] = []
        self._crossed: list[tuple[XY, XY]] = []

    def take(self, place: pygame.Rect) -> None:
        """Mark an area as occupied [px]."""
        self._taken.append(place)

    def mark(self, start: XY, end: XY) -> None:
        """Mark a line, such as an arrow, that labels avoid if possible [px]."""
        self._crossed.append((start, end))

    def find(
        self,
        places: Iterable[pygame.Rect],
        avoid: Sequence[pygame.Rect] = (),
        *,
        name: str = "",
        strict: bool = False,
    ) -> pygame.Rect | None:
        """Return the best free place [px], and mark it as occupied; None if there is none.

        The best of the places comes first. Areas to avoid count for more than lines; if `strict`,
        no place is better than one in such an area. A label without a name may change places in the
        next picture.
        """
        free = {
            i: place
            for i, place in enumerate(places)
            if self.bounds.contains(place) and place.collidelist(self._taken) < 0
        }
        clear = {i: place for i, place in free.items() if place.collidelist(avoid) < 0}
        first = self._kept.get(name, -1) if name else -1
        best = self._choose(first, clear, {} if strict else free)
        if best is None:
            return None
        self._kept[name] = best
        self.take(free[best])
        return free[best]

    def _choose(
        self, first: int, clear: Mapping[int, pygame.Rect], free: Mapping[int, pygame.Rect]
    ) -> int | None:
        """Return the best place: `first` if none is better, else the first one that is as good."""
        apart = (i for i in (first, *clear) if i in clear and not self._crosses(clear[i]))
        lesser = (i for pool in (clear, free) for i in (first, *pool) if i in pool)
        return next(chain(apart, lesser), None)

    def _crosses(self, place: pygame.Rect) -> bool:
        """Whether a marked line crosses a place."""
        return any(pygame.FRect(place).clipline(line) for line in self._crossed)
