"""The placement of labels, so that none covers another."""

from collections.abc import Iterable, Sequence
from itertools import chain

import pygame

from sandbox.model.shapes import XY


class Labels:
    """The places that are taken by words in one picture."""

    def __init__(self, bounds: pygame.Rect) -> None:
        self._bounds = bounds
        self._taken: list[pygame.Rect] = []
        self._crossed: list[tuple[XY, XY]] = []

    def take(self, place: pygame.Rect) -> None:
        """Keep words from a place [px]."""
        self._taken.append(place)

    def mark(self, start: XY, end: XY) -> None:
        """Let words rather not lie over a line, such as an arrow [px]."""
        self._crossed.append((start, end))

    def find(
        self, places: Iterable[pygame.Rect], avoid: Sequence[pygame.Rect] = ()
    ) -> pygame.Rect | None:
        """Take the first of some places that is free; None if there is none.

        Parameters
        ----------
        places
            Where words could stand [px], the best first.
        avoid
            What they should rather not cover, even less than a line; they may if nothing else is
            left.
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
        """Whether a line goes through a place."""
        return any(pygame.FRect(place).clipline(line) for line in self._crossed)
