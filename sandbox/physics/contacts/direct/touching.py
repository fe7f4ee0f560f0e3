"""Which points of which bodies touch in a step, and where their rows stand in the Jacobian."""

from typing import NamedTuple

import numpy as np

from sandbox.physics.contacts.direct.outlines import Figures, Outlines
from sandbox.physics.engine.batch import Booleans, Contacts, Integers

FROM_TO = np.array([[-1.0], [1.0]])
"""How a way from the first body to the second counts for each."""


class Touching(NamedTuple):
    """Which points of which bodies touch; k points, f of them stand for the friction of a contact.

    Attributes
    ----------
    bodies
        (2, k), the first and the second.
    pair, point
        (k,), the contact each belongs to, and which of its two points it is.
    number
        (k,), the same as one number: the points of contacts in a row, two of each.
    rubs
        (f,), those with friction: the two points of a side share that of the first.
    rows
        (k + f,), which points the gaps are of, and then the friction.
    held
        (2, k + f), the bodies of these.
    into
        Where in the Jacobian of gaps and friction the bodies stand: x and y of the first ones, of
        the second ones, and then the angles.
    figures
        The outlines of all bodies.
    outlines
        Those that touch, (2, k) each.
    yields
        (k,), whether the first body moves and the second does not: of two sides that face each
        other, that of the second counts.
    """

    bodies: Integers
    pair: Integers
    point: Integers
    number: Integers
    rubs: Integers
    rows: Integers
    held: Integers
    into: Integers
    figures: Figures
    outlines: Outlines
    yields: Booleans

    @classmethod
    def between(
        cls, contacts: Contacts, rubs: Booleans, figures: Figures, moves: Booleans
    ) -> "Touching":
        """Return the points of contacts: the first of all, then the second ones.

        Parameters
        ----------
        rubs
            Which contacts there is friction at, (c,).
        figures
            The outlines of all bodies.
        moves
            (n,), which of them anything can move.
        """
        count, two = len(contacts.bodies), np.flatnonzero(contacts.touches == 2)
        pair = np.concatenate((np.arange(count), two))
        point = np.repeat((0, 1), (count, len(two)))
        bodies, rubbing = contacts.bodies[pair].T.copy(), np.flatnonzero(rubs)
        rows = np.concatenate((np.arange(len(pair)), rubbing))
        held, everything = bodies[:, rows], figures.of(bodies)
        into, yields = _into(held, len(moves) + 1), moves[bodies[0]] & ~moves[bodies[1]]
        return cls(
            bodies,
            pair,
            point,
            2 * pair + point,
            rubbing,
            rows,
            held,
            into,
            figures,
            everything,
            yields,
        )

    def rubbing_at(self, points: Integers) -> "Touching":
        """Return the same with the friction of each side at one of its points: (f,)."""
        rows = np.concatenate((np.arange(len(self.pair)), points))
        return self._replace(rubs=points, rows=rows)

    @property
    def sliding(self) -> Integers:
        """The bodies of the friction: (2, f)."""
        return self.held[:, len(self.pair) :]


def _into(bodies: Integers, count: int) -> Integers:
    """Return where in the Jacobian of s rows bodies, (2, s), stand; there are so many."""
    start = np.arange(bodies.shape[1]) * (3 * count)
    x = start + 2 * bodies
    plane = np.stack((x, x + 1), axis=2).ravel()
    return np.concatenate((plane, (start + 2 * count + bodies).ravel()))
