"""How large friction may be: by the impulses of the contacts that it acts at."""

from functools import cached_property

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.constraint_rows import Friction
from sandbox.physics.engine.batch import Integers


class FrictionBounds:
    """The bounds of friction in scaled rows; m rows, f of friction.

    Parameters
    ----------
    friction
        Its rows.
    size
        (m,), by what impulses are scaled.
    """

    def __init__(self, friction: Friction, size: Array) -> None:
        self.row, self.contact = friction.row, friction.contact
        self._friction, self._size = friction, size

    @cached_property
    def _scale(self) -> Array:
        """How friction is scaled by the impulse of each contact: (2, f)."""
        return np.asarray(self._size.take(self.row) / self._size.take(self.contact))

    @cached_property
    def _sticks(self) -> Array:
        return self._friction.shares[0] * self._scale

    @cached_property
    def _slips(self) -> Array:
        return self._friction.shares[1] * self._scale

    def sticking(self, impulse: Array) -> Array:
        """Return how large friction that sticks may be with impulses, (m,): (f,)."""
        return self._bounds(impulse, self._sticks)

    def slipping(self, impulse: Array) -> Array:
        """Return how large friction that slips is with impulses, (m,): (f,)."""
        return self._bounds(impulse, self._slips)

    def _bounds(self, impulse: Array, coefficients: Array) -> Array:
        bounds = coefficients * np.maximum(impulse.take(self.contact), 0.0)
        return np.asarray(bounds[0] + bounds[1])

    def sticking_by_each(self) -> Array:
        """Return how large friction that sticks may be by each impulse, one by one: (f, m)."""
        return self._by_each(self._sticks)

    def slipping_by_each(self) -> Array:
        """Return how large friction that slips is by each impulse, one by one: (f, m)."""
        return self._by_each(self._slips)

    def _by_each(self, coefficients: Array) -> Array:
        shares, each = np.zeros((len(self.row), len(self._size))), np.arange(len(self.row))
        for contact, share in zip(self.contact, coefficients, strict=True):
            shares[each, contact] += share
        return shares

    def follow(self, slip: Integers) -> Array:
        """Return what impulses follow from those of rows that hold: (m, m).

        Friction that slips one way or the other, (f,), is at its bound.
        """
        gives = np.eye(len(self._size))
        for contact, share in zip(self.contact, self._slips * slip, strict=True):
            gives[self.row, contact] += share
        return gives
