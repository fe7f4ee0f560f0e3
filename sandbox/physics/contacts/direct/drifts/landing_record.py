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

    `body_impulse`, (n,), are the sums of the sizes of their impulses on each body [N s], and
    `contacts` are the contacts that take part in them, without impulses. `impacts` are the
    collisions in them, in order; `pair_impulse` has the sum of the normal impulses of each pair [N
    s]. `jerked`, (n,), tells which bodies may be jerked by joints that catch in the drift.
    """

    def __init__(self, count: int) -> None:
        self.body_impulse = np.zeros(count)
        self.contacts = NO_CONTACTS
        self.impacts: list[LandingImpact] = []
        self.pair_impulse: dict[Pair, float] = {}
        self.jerked: Booleans = np.zeros(count, dtype=bool)

    def note(self, pairs: Sequence[Pair], time: float, pushed: Contacts, landed: Integers) -> None:
        """Note a landing, of pairs that collided at a time since the start of the drift [s].

        `pushed` are all contacts, with the impulses of the landing; `landed` tells which of them
        have landed.
        """
        self.impacts += (LandingImpact(pair, time) for pair in pairs)
        self.pair_impulse |= {pair: self.pair_impulse.get(pair, 0.0) for pair in pairs}
        both = pushed.bodies.T.ravel()
        pushes = np.bincount(both, np.tile(pushed.normal, 2), len(self.body_impulse))
        self.body_impulse = self.body_impulse + pushes
        takes = pushed.normal > 0
        takes[landed] = True
        none = 0.0 * pushed.normal
        calm = pushed._replace(normal=none, friction=none, impulse=0.0 * pushed.impulse)
        self.contacts = self.contacts.followed_by(Contacts._make(field[takes] for field in calm))
        for pair, push in zip(pairs_of(pushed), pushed.normal.tolist(), strict=True):
            self.pair_impulse[pair] = self.pair_impulse.get(pair, 0.0) + push
