"""False contacts, which pymunk reports and which are removed here.

For parallel shapes that are far apart, pymunk sometimes reports a contact, without a direction or
with a large overlap.
"""

from collections.abc import Callable

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.detection.contact_queries import Query, pairs_of
from sandbox.physics.engine.space_arrays import Booleans, Contacts, Integers
from sandbox.physics.joints.exact.constraint_interface import QUADRATIC

FURTHER = 1.5
"""A new contact is false if its overlap exceeds this multiple of its bodies' motion in a step."""


class FalseContacts:
    """Removes false contacts.

    A pair that did not touch in the step before cannot overlap by more than its bodies have moved
    since. A new contact that is deeper than that is false. `query` finds the contacts of bodies
    that were moved.
    """

    def __init__(self, query: Query) -> None:
        self._query = query
        self._pairs: set[tuple[int, int]] | None = None  # of the last step, if known
        self._same: Integers | None = None  # of the last step's contacts, if all were real

    def forget(self) -> None:
        """Accept all contacts of the next step, since bodies were put elsewhere."""
        self._pairs = self._same = None

    def without_false(
        self, contacts: Contacts, moved: Callable[[], tuple[Array, Array]]
    ) -> Contacts:
        """Return the contacts that are real.

        `moved` returns the positions of the bodies, (n, 2) [m], and the sizes of their
        displacements in the last step, (n, 3) [m, rad].
        """
        if not len(contacts.bodies):
            self._pairs, self._same = set(), None
            return contacts
        directed = np.count_nonzero(contacts.direction.view(complex)) == len(contacts.bodies)
        if contacts.bodies is self._same and directed:
            return contacts
        good: Booleans = np.asarray(contacts.direction.any(axis=1))
        pairs, known_pairs = pairs_of(contacts), self._pairs
        if (
            known_pairs is not None
            and (new := np.array([pair not in known_pairs for pair in pairs])).any()
        ):
            good &= ~new | (contacts.depth <= _reach(contacts, *moved()))
        self._pairs = {pair for pair, keep in zip(pairs, good, strict=True) if keep}
        whole = bool(good.all())
        self._same = contacts.bodies if whole else None
        return contacts if whole else Contacts._make(field[good] for field in contacts)

    def updated(self, contacts: Contacts, state: Array, shift: Array, min_depth: float) -> Contacts:
        """Return contacts with those that a displacement has made; the same object if none.

        `state`, (n, 6), is the state of the bodies now, see `Batch.state`; `shift`, (n, 3), are
        their displacements, and `min_depth` is the smallest one that counts [m, rad].
        """
        moved = np.flatnonzero((np.abs(shift) > min_depth).any(axis=1)).tolist()
        found = self._query.updated(contacts, moved, min_depth) if moved else contacts
        return (
            contacts
            if found is contacts
            else self.without_false(found, lambda: (state[:, :2], np.abs(shift)))
        )


def _reach(contacts: Contacts, pose: Array, displacement: Array) -> Array:
    """Return the largest overlaps that a step can cause: (k,) [m]."""
    arms = np.hypot(*np.moveaxis(contacts.points[:, :1] - pose[contacts.bodies], 2, 0))
    motion = displacement[contacts.bodies]
    path_lengths = np.hypot(motion[..., 0], motion[..., 1]) + arms * motion[..., 2]
    return np.asarray(FURTHER * path_lengths.sum(axis=1) + QUADRATIC)
