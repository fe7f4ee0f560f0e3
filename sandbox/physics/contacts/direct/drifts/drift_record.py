"""The drifts before and after a kick, where landings or a subdivision cut them into parts."""

from collections.abc import Sequence

from sandbox.model.expressions import Array
from sandbox.physics.contacts.detection.contact_queries import pairs_of
from sandbox.physics.contacts.direct.drifts.fallback_subdivision import DividedDrift
from sandbox.physics.contacts.direct.drifts.landing_record import LandingImpact, LandingRecord
from sandbox.physics.engine.space_arrays import NO_CONTACTS, Booleans, Contacts


class Drifts:
    """Records the drifts before and after a kick; n bodies.

    If the drift after the kick is taken in parts, `drift_after` is that drift, and
    `post_kick_velocity`, (n, 3), are the velocities after the kick [m/s, rad/s]; else both are
    None. In the same way, `drift_before` is the drift before the kick, and `mean_velocity_before`,
    (n, 3), are the mean velocities in it [m/s, rad/s]. `separated_contacts` are the contacts of its
    landings that had parted at its end, without impulses; `landings` tells what collided in them.
    """

    def __init__(self, count: int) -> None:
        self._none = LandingRecord(count)
        self.post_kick_velocity: Array | None = None
        self.drift_after: DividedDrift | None = None
        self.drift_before: DividedDrift | None = None
        self.mean_velocity_before: Array | None = None
        self._mean_velocity_after: Array | None = None  # the same for the drift after the kick
        self.separated_contacts = NO_CONTACTS
        self.landings = self._landings_after = self._none

    @property
    def impacts(self) -> Sequence[LandingImpact]:
        """The collisions in the landings of the drift before it, in order."""
        return self.landings.impacts

    @property
    def jerked(self) -> Booleans:
        """Which bodies joints may jerk in the drift after it: (n,).

        The forces of such joints in the kick are then partly those of the jerk.
        """
        return self._landings_after.jerked

    def begin(self, contacts: Contacts) -> None:
        """Go on to the next kick, at whose beginning there are some contacts."""
        self.post_kick_velocity, self.drift_before, self.drift_after = None, self.drift_after, None
        self.mean_velocity_before, self._mean_velocity_after = self._mean_velocity_after, None
        self.landings, self._landings_after = self._landings_after, self._none
        self.separated_contacts = _without(self.landings.contacts, contacts)

    def take_back(self) -> None:
        """Go back to before the last `begin`, since its kick is solved again."""
        self.drift_after, self._landings_after = self.drift_before, self.landings
        self._mean_velocity_after = self.mean_velocity_before

    def forget(self) -> None:
        """Forget the drift after the last kick: bodies were put elsewhere, or joints changed."""
        self.drift_after = self._mean_velocity_after = None
        self._landings_after = self._none

    def divide(self, divided: DividedDrift, mean: Array) -> None:
        """Record that the drift after the kick is taken in parts, with mean velocities, (n, 3)."""
        self.drift_after, self._mean_velocity_after = divided, mean
        self.post_kick_velocity = divided.post_kick_velocity

    def land(self, landings: LandingRecord) -> None:
        """Record the landings in the drift after the kick."""
        self._landings_after = landings


def _without(met: Contacts, others: Contacts) -> Contacts:
    """Return the contacts whose pairs of bodies are not among others."""
    if not len(met.bodies):
        return met
    touch = set(pairs_of(others))
    left = [pair not in touch for pair in pairs_of(met)]
    return Contacts._make(field[left] for field in met)
