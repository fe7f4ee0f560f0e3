"""The drifts before and after a kick, where landings or a subdivision cut them into parts."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.contact_queries import pairs_of
from sandbox.physics.contacts.direct.convex_parts import Pair
from sandbox.physics.contacts.direct.drift_subdivision import Divided
from sandbox.physics.engine.batch import NO_CONTACTS, Contacts


class Struck(NamedTuple):
    """Two bodies that collided within a drift.

    Attributes
    ----------
    bodies
        Their indices.
    time
        The time since the step before [s].
    """

    bodies: Pair
    time: float


class Drifts:
    """Records the drifts before and after a kick; n bodies.

    Attributes
    ----------
    kicked
        (n, 3), the velocities after the kick, if the drift after it is taken in parts; else None
        [m/s, rad/s].
    divided
        The drift after the kick, if it is taken in parts; else None.
    drifted
        The same for the drift before it.
    led
        (n, 3), the mean velocities in `drifted`, if that was taken in parts; else None [m/s,
        rad/s].
    parted
        The contacts of its landings that had parted at its end, without impulses.
    pushed
        (n,), the sums of the sizes of the impulses of its landings on each body [N s].
    struck
        Who collided in its landings, in turn.
    given
        The normal impulses of its landings, by pair, in turn [N s].
    """

    def __init__(self, count: int) -> None:
        self._none: Array = np.zeros(count)
        self.kicked: Array | None = None
        self.divided: Divided | None = None
        self.drifted: Divided | None = None
        self.led: Array | None = None
        self._leads: Array | None = None  # the same for the drift after the kick
        self.parted = self._met = NO_CONTACTS
        self.pushed = self._pushes = self._none
        self.struck: Sequence[Struck] = ()
        self._strikes: Sequence[Struck] = ()
        self.given: Mapping[Pair, float] = {}
        self._gives: Mapping[Pair, float] = {}

    def begin(self, contacts: Contacts) -> None:
        """Go on to the next kick, at whose beginning there are some contacts."""
        self.kicked, self.drifted, self.divided = None, self.divided, None
        self.led, self._leads = self._leads, None
        self.parted, self._met = _without(self._met, contacts), NO_CONTACTS
        self.pushed, self._pushes = self._pushes, self._none
        self.struck, self._strikes = self._strikes, ()
        self.given, self._gives = self._gives, {}

    def forget(self) -> None:
        """Forget the drift after the last kick: bodies were put elsewhere, or joints changed."""
        self.divided = self._leads = None
        self._met, self._pushes, self._strikes = NO_CONTACTS, self._none, ()
        self._gives = {}

    def divide(self, divided: Divided, mean: Array) -> None:
        """Record that the drift after the kick is taken in parts, with mean velocities, (n, 3)."""
        self.divided, self.kicked, self._leads = divided, divided.left, mean

    def land(
        self,
        met: Contacts,
        pushed: Array,
        struck: Sequence[Struck],
        given: Mapping[Pair, float],
    ) -> None:
        """Record the landings in the drift after the kick; for the rest see the attributes."""
        self._met, self._pushes, self._strikes, self._gives = met, pushed, struck, given


def _without(met: Contacts, others: Contacts) -> Contacts:
    """Return the contacts whose pairs of bodies are not among others."""
    if not len(met.bodies):
        return met
    touch = set(pairs_of(others))
    left = [pair not in touch for pair in pairs_of(met)]
    return Contacts._make(field[left] for field in met)
