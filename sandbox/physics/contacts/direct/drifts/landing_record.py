"""What collided in the landings of a drift, and how hard."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from sandbox.physics.contacts.detection.contact_queries import pairs_of
from sandbox.physics.contacts.direct.prediction.convex_parts import Pair
from sandbox.physics.engine.space_arrays import NO_CONTACTS, Booleans, Contacts, Integers


class LandingImpact(NamedTuple):
    """Two bodies that collided within a drift, and the time of that since the step before [s]."""

    bodies: Pair
    time: float


class LandingRecord:
    """Records the landings of a drift; n bodies.

    `pushed`, (n,), are the sums of the sizes of their impulses on each body [N s], and `met` are
    the contacts that take part in them, without impulses. `struck` are the collisions in them, in
    order; `given` has the sum of the normal impulses of each pair [N s]. `jerked`, (n,), tells
    which bodies may be jerked by joints that catch in the drift.
    """

    def __init__(self, count: int) -> None:
        self.pushed = np.zeros(count)
        self.met = NO_CONTACTS
        self.struck: list[LandingImpact] = []
        self.given: dict[Pair, float] = {}
        self.jerked: Booleans = np.zeros(count, dtype=bool)

    def note(self, pairs: Sequence[Pair], time: float, pushed: Contacts, landed: Integers) -> None:
        """Note a landing, of pairs that collided at a time since the start of the drift [s].

        `pushed` are all contacts, with the impulses of the landing; `landed` tells which of them
        have landed.
        """
        self.struck += (LandingImpact(pair, time) for pair in pairs)
        self.given |= {pair: self.given.get(pair, 0.0) for pair in pairs}
        both = pushed.bodies.T.ravel()
        pushes = np.bincount(both, np.tile(pushed.normal, 2), len(self.pushed))
        self.pushed = self.pushed + pushes
        takes = pushed.normal > 0
        takes[landed] = True
        none = 0.0 * pushed.normal
        calm = pushed._replace(normal=none, friction=none, impulse=0.0 * pushed.impulse)
        self.met = self.met.followed_by(Contacts._make(field[takes] for field in calm))
        for pair, push in zip(pairs_of(pushed), pushed.normal.tolist(), strict=True):
            self.given[pair] = self.given.get(pair, 0.0) + push
