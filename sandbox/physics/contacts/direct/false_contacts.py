"""False contacts of pymunk, which are taken away."""

from collections.abc import Callable

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.queries import Query, pairs_of
from sandbox.physics.engine.batch import Booleans, Contacts, Integers
from sandbox.physics.joints.exact.constraints import QUADRATIC

FURTHER = 1.5
"""How many times as far as it moves in a step a body may be found in another at first."""


class FalseContacts:
    """Takes away contacts that there are not.

    Of shapes that lie parallel, far from each other, pymunk now and then finds that they touch,
    without a direction or deep in each other. What has not touched in the step before can be no
    deeper in each other than the bodies have moved.

    Parameters
    ----------
    query
        Finds what bodies touch that were moved.
    """

    def __init__(self, query: Query) -> None:
        self._query = query
        self._pairs: set[tuple[int, int]] | None = None  # that touched in the last step, if known
        self._same: Integers | None = None  # the bodies of the last step's contacts, if all were

    def forget(self) -> None:
        """Believe everything once: bodies were put elsewhere."""
        self._pairs = self._same = None

    def sound(self, contacts: Contacts, moved: Callable[[], tuple[Array, Array]]) -> Contacts:
        """Return the contacts that there are.

        Parameters
        ----------
        moved
            Tells where the bodies are, (n, 2) [m], and how far they moved in the last step,
            whichever way, (n, 3) [m, rad].
        """
        if not len(contacts.bodies):
            self._pairs, self._same = set(), None
            return contacts
        good: Booleans = np.asarray(contacts.direction.any(axis=1))
        if contacts.bodies is self._same and good.all():
            return contacts
        pairs, known = pairs_of(contacts), self._pairs
        if known is not None and (new := np.array([pair not in known for pair in pairs])).any():
            good &= ~new | (contacts.depth <= _reach(contacts, *moved()))
        self._pairs = {pair for pair, keep in zip(pairs, good, strict=True) if keep}
        whole = bool(good.all())
        self._same = contacts.bodies if whole else None
        return contacts if whole else Contacts._make(field[good] for field in contacts)

    def since(self, contacts: Contacts, state: Array, shift: Array, least: float) -> Contacts:
        """Return contacts, and those that there are since bodies were moved; the same if none are.

        Parameters
        ----------
        state
            (n, 6), where the bodies are now, see `Batch.state`.
        shift
            (n, 3), by what they were moved [m, rad].
        least
            By how much that counts [m, rad].
        """
        moved = np.flatnonzero((np.abs(shift) > least).any(axis=1)).tolist()
        found = self._query.more(contacts, moved, least) if moved else contacts
        return (
            contacts
            if found is contacts
            else self.sound(found, lambda: (state[:, :2], np.abs(shift)))
        )


def _reach(contacts: Contacts, place: Array, way: Array) -> Array:
    """Return how far bodies can have come into each other in a step: (k,) [m]."""
    arms = np.hypot(*np.moveaxis(contacts.points[:, :1] - place[contacts.bodies], 2, 0))
    motion = way[contacts.bodies]
    ways = np.hypot(motion[..., 0], motion[..., 1]) + arms * motion[..., 2]
    return np.asarray(FURTHER * ways.sum(axis=1) + QUADRATIC)
