"""The bounds of friction, given by the impulses of its contacts (Coulomb's law)."""

from functools import cached_property

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.complementarity.complementarity_problem import Friction
from sandbox.physics.engine.space_arrays import Integers


class FrictionBounds:
    """The bounds of friction in scaled rows; m rows, f of friction.

    `size`, (m,), has the factors by which impulses are scaled; `sizes` has them as plain numbers.
    """

    def __init__(self, friction: Friction, size: Array) -> None:
        self.row, self.contact = friction.row, friction.contact
        self._friction, self._size = friction, size
        self.sizes: list[float] = size.tolist()

    @cached_property
    def _scaled_coefficients(self) -> tuple[Array, Array]:
        """The static and the kinetic coefficients of each contact, scaled: (2, f) each."""
        (sticks, slips), size = self._friction.coefficients, self._size
        scale = size.take(self.row) / size.take(self.contact)
        return sticks * scale, slips * scale

    def sticking(self, impulse: Array) -> Array:
        """Return the bounds of friction while it sticks, (f,), with impulses (m,)."""
        return self._bounds(impulse, self._scaled_coefficients[0])

    def slipping(self, impulse: Array) -> Array:
        """Return the size of friction while it slips, (f,), with impulses (m,)."""
        return self._bounds(impulse, self._scaled_coefficients[1])

    def _bounds(self, impulse: Array, coefficients: Array) -> Array:
        bounds = coefficients * np.maximum(impulse.take(self.contact), 0.0)
        return np.asarray(bounds[0] + bounds[1])

    def sticking_by_each(self) -> Array:
        """Return the matrix, (f, m), that maps impulses to the bounds while friction sticks."""
        return self._by_each(self._scaled_coefficients[0])

    def slipping_by_each(self) -> Array:
        """Return the matrix, (f, m), that maps impulses to the sizes while friction slips."""
        return self._by_each(self._scaled_coefficients[1])

    def _by_each(self, coefficients: Array) -> Array:
        shares, each = np.zeros((len(self.row), len(self._size))), np.arange(len(self.row))
        for contact, share in zip(self.contact, coefficients, strict=True):
            shares[each, contact] += share
        return shares

    def substitute_slip(self, slip: Integers) -> Array:
        """Return the matrix, (m, m), that maps the impulses of active rows to all impulses.

        Friction that slips, in the direction of its sign in `slip`, (f,), is the coefficient times
        the impulse of its contact.
        """
        gives, size = np.eye(len(self._size)), self.sizes
        for sign, (row, contacts, _, slips) in zip(slip.tolist(), self._friction.each, strict=True):
            for contact in contacts if sign else ():
                gives[row, contact] += sign * (slips * (size[row] / size[contact]))
        return gives
