"""A series of arrays in bounded memory, thinned when it is full: paths of bodies, energies."""

import numpy as np

from sandbox.model.expressions import Array

CAPACITY = 4000  # instants
FIELDS = 400_000  # instants times bodies


class ThinnedSeries:
    """A series of arrays of one shape, such as the positions of bodies.

    When it is full, every second instant is dropped, and new ones are kept half as often.
    """

    def __init__(self, position: Array) -> None:
        self._room = max(min(CAPACITY, FIELDS // max(len(position), 1)), 16)
        self._points = np.empty((self._room, *position.shape))
        self._stride = 1
        self._seen = 0
        self._count = 0
        self.version = 0
        """Changes whenever earlier instants are dropped."""
        self.add(position)

    def __len__(self) -> int:
        return self._count

    def add(self, position: Array) -> None:
        """Add the next instant, such as the positions of bodies, (n, 2) [m]."""
        if self._seen % self._stride == 0:
            if self._count == self._room:
                self._thin()
            self._points[self._count] = position
            self._count += 1
        self._seen += 1

    def restart(self, position: Array) -> None:
        """Forget everything, as after a body was moved by hand."""
        self._seen = self._count = 0
        self._stride = 1
        self.version += 1
        self.add(position)

    def drop_last(self, count: int) -> None:
        """Drop the last instants that were added; a copy of the series keeps them."""
        self._points = self._points.copy()
        self._seen -= count
        self._count = -(-self._seen // self._stride)
        self.version += 1

    @property
    def points(self) -> Array:
        """All instants that are kept, such as (k, n, 2) [m]."""
        return self._points[: self._count]

    def _thin(self) -> None:
        kept = self._points[::2]
        self._count = len(kept)
        self._points[: self._count] = kept.copy()
        self._stride *= 2
        self.version += 1
