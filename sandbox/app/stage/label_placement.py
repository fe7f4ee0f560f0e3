"""Places labels so that none covers another."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain

import pygame

from sandbox.model.shapes import XY

GAP = 4  # px, between two labels beside each other


class Labels:
    """The areas of a picture that are occupied by labels and lines.

    `last_places` has the last place of each named label, as an index: a label stays there from
    picture to picture while no other place is better.
    """

    def __init__(self, bounds: pygame.Rect, last_places: dict[str, int] | None = None) -> None:
        self.bounds = bounds
        """The area for labels [px]."""
        self._kept = {} if last_places is None else last_places
        self._taken: list[pygame.Rect] = []
        self._crossed: list[tuple[XY, XY]] = []

    def occupy(self, place: pygame.Rect) -> None:
        """Mark an area as occupied [px]."""
        self._taken.append(place)

    def mark(self, start: XY, end: XY) -> None:
        """Mark a line, such as an arrow, that labels avoid if possible [px]."""
        self._crossed.append((start, end))

    def place_for(
        self,
        places: Iterable[pygame.Rect],
        avoid: Sequence[pygame.Rect] = (),
        *,
        name: str = "",
        strict: bool = False,
    ) -> pygame.Rect | None:
        """Return the best free place [px], and mark it as occupied; None if there is none.

        The best of the places comes first. Areas to avoid count for more than lines, which count
        where no place is outside of these areas, too; if `strict`, no place is better than one in
        such an area. A label without a name may change places in the next picture.
        """
        spots = list(places)
        first = self._kept.get(name, len(spots)) if name else len(spots)
        order = [first, *range(len(spots))] if first < len(spots) else range(len(spots))

        def free() -> Iterator[int]:
            return (i for i in order if self._is_free(spots[i]))

        def clear() -> Iterator[int]:
            return (i for i in free() if spots[i].collidelist(avoid) < 0)

        def apart(found: Iterable[int]) -> Iterator[int]:
            return (i for i in found if not self._crosses(spots[i]))

        beyond = () if strict else chain(apart(free()), free())
        best = next(chain(apart(clear()), clear(), beyond), None)
        if best is None:
            return None
        self._kept[name] = best
        self.occupy(spots[best])
        return spots[best]

    def _is_free(self, place: pygame.Rect) -> bool:
        """Whether a place is within the bounds, and apart from the labels beside it."""
        roomy = place.inflate(2 * GAP, 0)
        return self.bounds.contains(place) and roomy.collidelist(self._taken) < 0

    def _crosses(self, place: pygame.Rect) -> bool:
        """Whether a marked line crosses a place."""
        return any(map(pygame.FRect(place).clipline, self._crossed))
