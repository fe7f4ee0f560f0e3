"""The drifts before and after a kick, where landings or a subdivision cut them into parts."""

from collections.abc import Sequence

from sandbox.model.expressions import Array
from sandbox.physics.contacts.detection.contact_queries import pairs_of
from sandbox.physics.contacts.direct.drifts.fallback_subdivision import DividedDrift
from sandbox.physics.contacts.direct.drifts.landing_record import LandingImpact, LandingRecord
from sandbox.physics.engine.space_arrays import NO_CONTACTS, Booleans, Contacts


class Drifts:
    """Records the drifts before and after a kick; n bodies.

    If the drift after the kick is taken in parts, `divided` is that drift, and `kicked`, (n, 3),
    are the velocities after the kick [m/s, rad/s]; else both are None. In the same way, `drifted`
    is the drift before the kick, and `led`, (n, 3), are the mean velocities in it [m/s, rad/s].
    `parted` are the contacts of its landings that had parted at its end, without impulses;
    `landings` tells what collided in them.
    """

    def __init__(self, count: int) -> None:
        self._none = LandingRecord(count)
        self.kicked: Array | None = None
        self.divided: DividedDrift | None = None
        self.drifted: DividedDrift | None = None
        self.led: Array | None = None
        self._leads: Array | None = None  # the same for the drift after the kick
        self.parted = NO_CONTACTS
        self.landings = self._lands = self._none

    @property
    def struck(self) -> Sequence[LandingImpact]:
        """The collisions in the landings of the drift before it, in order."""
        return self.landings.struck

    @property
    def jerked(self) -> Booleans:
        """Which bodies joints may jerk in the drift after it: (n,).

        The forces of such joints in the kick are then partly those of the jerk.
        """
        return self._lands.jerked

    def begin(self, contacts: Contacts) -> None:
        """Go on to the next kick, at whose beginning there are some contacts."""
        self.kicked, self.drifted, self.divided = None, self.divided, None
        self.led, self._leads = self._leads, None
        self.landings, self._lands = self._lands, self._none
        self.parted = _without(self.landings.met, contacts)

    def take_back(self) -> None:
        """Go back to before the last `begin`, since its kick is solved again."""
        self.divided, self._leads, self._lands = self.drifted, self.led, self.landings

    def forget(self) -> None:
        """Forget the drift after the last kick: bodies were put elsewhere, or joints changed."""
        self.divided = self._leads = None
        self._lands = self._none

    def divide(self, divided: DividedDrift, mean: Array) -> None:
        """Record that the drift after the kick is taken in parts, with mean velocities, (n, 3)."""
        self.divided, self.kicked, self._leads = divided, divided.left, mean

    def land(self, landings: LandingRecord) -> None:
        """Record the landings in the drift after the kick."""
        self._lands = landings


def _without(met: Contacts, others: Contacts) -> Contacts:
    """Return the contacts whose pairs of bodies are not among others."""
    if not len(met.bodies):
        return met
    touch = set(pairs_of(others))
    left = [pair not in touch for pair in pairs_of(met)]
    return Contacts._make(field[left] for field in met)
