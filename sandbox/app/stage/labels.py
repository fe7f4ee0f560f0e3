"""Places labels so that none covers another."""

from collections.abc import Iterable, Sequence
from itertools import chain

import pygame

from sandbox.model.shapes import XY


class Labels:
    """The areas of a picture that are occupied by labels and lines."""

    def __init__(self, bounds: pygame.Rect) -> None:
        self._bounds = bounds
        self._taken: list[pygame.Rect] = []
        self._crossed: list[tuple[XY, XY]] = []

    def take(self, place: pygame.Rect) -> None:
        """Mark an area as occupied [px]."""
        self._taken.append(place)

    def mark(self, start: XY, end: XY) -> None:
        """Mark a line, such as an arrow, that labels avoid if possible [px]."""
        self._crossed.append((start, end))

    def find(
        self, places: Iterable[pygame.Rect], avoid: Sequence[pygame.Rect] = ()
    ) -> pygame.Rect | None:
        """Return the first free place, and mark it as occupied; None if there is none.

        Parameters
        ----------
        places
            The possible places of a label [px], the best first.
        avoid
            Areas to avoid if possible, with priority over lines [px].
        """
        free = [
            place
            for place in places
            if self._bounds.contains(place) and place.collidelist(self._taken) < 0
        ]
        clear = [place for place in free if place.collidelist(avoid) < 0]
        apart = (place for place in clear if not self._crosses(place))
        found = next(chain(apart, clear, free), None)
        if found:
            self.take(found)
        return found

    def _crosses(self, place: pygame.Rect) -> bool:
        """Whether a marked line crosses a place."""
        return any(pygame.FRect(place).clipline(line) for line in self._crossed)
