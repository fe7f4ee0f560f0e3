"""The contact points of a step, and the indices of their rows in the Jacobian."""

from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.rows.contact_outlines import Figures, Outlines
from sandbox.physics.engine.space_arrays import Booleans, Contacts, Integers

FROM_TO = np.array([[-1.0], [1.0]], dtype=complex)  # as the directions are
"""The sign of the direction from the first body to the second, for each of the two."""


class Sides(NamedTuple):
    """What follows from which bodies have the sides; fields as of `Features`."""

    side: Integers
    is_owner: Array
    rolls: Array
    circles: Array


class SidesMemory:
    """The sides in the last step, where all points have one: they seldom change."""

    def __init__(self) -> None:
        self._last: tuple[bytes, Sides] | None = None

    def recall(self, owns: Booleans) -> Sides | None:
        """Return what was noted for these bodies with sides, (2, k)."""
        return self._last[1] if self._last and self._last[0] == owns.tobytes() else None

    def note(self, owns: Booleans, sides: Sides) -> None:
        """Note what follows from them; it must not be changed."""
        self._last = owns.tobytes(), sides


class ContactPoints(NamedTuple):
    """The contact points: k of them, f of which carry the friction of their contact.

    Attributes
    ----------
    bodies
        (2, k), the first and the second.
    pair, point
        (k,), the contact of each, and which of its two points it is.
    number
        (k,), the same as one index: 2 pair + point.
    friction_points
        (f,), the points that carry friction: the first of each contact with friction.
    rows
        (k + f,), the points of all rows: first those of the gaps, then those of friction.
    row_bodies
        (2, k + f), the bodies of these.
    jacobian_indices
        The indices of the bodies' coordinates in the flattened Jacobian of gaps and friction: of x
        and y by turns, (2, 2 (k + f)), and of the angles, (2, k + f).
    figures
        The outlines of all bodies.
    outlines
        The outlines of the bodies that touch, (2, k) each.
    yields
        (k,), whether the first body moves and the second does not: where two sides face each other,
        the side of the second is then the reference.
    memory
        The sides in the last step.
    ends
        (2, k), where they touch with the end of a side, though with its normal; None if nowhere.
    """

    bodies: Integers
    pair: Integers
    point: Integers
    number: Integers
    friction_points: Integers
    rows: Integers
    row_bodies: Integers
    jacobian_indices: tuple[Integers, Integers]
    figures: Figures
    outlines: Outlines
    yields: Booleans
    memory: SidesMemory
    ends: Booleans | None = None

    @classmethod
    def between(
        cls, contacts: Contacts, has_friction: Booleans, figures: Figures, movable: Booleans
    ) -> "ContactPoints":
        """Return the points of contacts: the first points of all contacts, then the second ones.

        `has_friction`, (c,), tells which contacts have friction, and `movable`, (n,), which bodies
        are dynamic; `figures` are the outlines of all bodies.
        """
        count, two = len(contacts.bodies), np.flatnonzero(contacts.touches == 2)
        pair = np.concatenate((np.arange(count), two))
        point = np.repeat((0, 1), (count, len(two)))
        bodies, rubbing = contacts.bodies[pair].T.copy(), np.flatnonzero(has_friction)
        rows = np.concatenate((np.arange(len(pair)), rubbing))
        row_bodies, everything = bodies[:, rows], figures.of(bodies)
        into, yields = _into(row_bodies, len(movable) + 1), movable[bodies[0]] & ~movable[bodies[1]]
        return cls(
            bodies,
            pair,
            point,
            2 * pair + point,
            rubbing,
            rows,
            row_bodies,
            into,
            figures,
            everything,
            yields,
            SidesMemory(),
        )

    @property
    def partner(self) -> Integers:
        """(k,), the other point of the same contact; −1 if there is none."""
        seconds = np.flatnonzero(self.point)
        found = np.full(len(self.pair), -1)
        found[seconds] = self.pair[seconds]
        found[self.pair[seconds]] = seconds
        return found

    def pairs(self, points: Integers) -> list[tuple[int, int]]:
        """Return the pairs of bodies at some of the points, each once, the lower index first."""
        return sorted({(min(pair), max(pair)) for pair in self.bodies.T[points].tolist()})

    def with_friction_at(self, points: Integers) -> "ContactPoints":
        """Return the same with friction at other points: (f,)."""
        rows = np.concatenate((np.arange(len(self.pair)), points))
        return self._replace(friction_points=points, rows=rows, memory=SidesMemory())

    @property
    def friction_bodies(self) -> Integers:
        """The bodies of the rows of friction: (2, f)."""
        return self.row_bodies[:, len(self.pair) :]


def _into(bodies: Integers, count: int) -> tuple[Integers, Integers]:
    """Return the indices of the bodies, (2, s), in a flattened Jacobian of s rows."""
    start = np.arange(bodies.shape[1]) * (3 * count)
    x = start + 2 * bodies
    plane = np.stack((x, x + 1), axis=2).reshape(2, -1)
    return plane, start + 2 * count + bodies
