"""The records of a kick with impacts: its stages, and its result."""

from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.complementarity.complementarity_problem import Active
from sandbox.physics.contacts.direct.rows.kick_system import Kick
from sandbox.physics.contacts.impacts.impact_outcome import ImpactOutcome
from sandbox.physics.engine.space_arrays import Booleans, Contacts
from sandbox.physics.joints.exact.constraint_interface import Coordinates


class Stage(NamedTuple):
    """A stage of a kick with impacts: before them, the impacts themselves, or after them.

    `duration` is its length, 0 for the impacts [s], and `velocity`, (n, 3), are the velocities at
    its end [m/s, rad/s]. `joint_impulses`, (m,), are the impulses of the equations of the joints,
    positive where they pull; the contacts come with their impulses.
    """

    duration: float
    velocity: Array
    joint_impulses: Array
    contacts: Contacts

    @classmethod
    def of(cls, kick: Kick, duration: float, ended: Array, impulse: Array) -> "Stage":
        """Return a stage from its length, final velocities, and the impulses of its rows: (r,)."""
        return cls(duration, ended, impulse[kick.layout.joints], kick.contacts_with(impulse))

    def among(self, bodies: Booleans, joints: Booleans) -> "Stage":
        """Return it with only the impulses on some bodies, (n,), and of some joints, (m,)."""
        both = self.contacts
        some = np.any(bodies[both.bodies], axis=1)
        contacts = both._replace(
            normal=both.normal * some,
            friction=both.friction * some,
            impulse=both.impulse * some[:, None],
        )
        return self._replace(
            joint_impulses=np.where(joints, self.joint_impulses, 0.0), contacts=contacts
        )


class KickResult(NamedTuple):
    """The result of a kick; r rows, N bodies with the plane.

    Attributes
    ----------
    kick
        Its rows.
    velocity
        (3 N,), the velocities after it [m/s, rad/s].
    forces
        (r,), the forces after its impacts, or throughout if it has none [N].
    active
        The active rows after its impacts.
    impulse
        (r,), the impulses of the whole kick.
    impacts
        Its impacts; None if it has none.
    stages
        Its stages, if it has impacts; else empty.
    start_velocity
        (3 N,), the velocities right after its impacts, or at its beginning [m/s, rad/s].
    duration
        The length of the kick from there [s].
    slides
        Whether anything slips in it, or did in the kick before.
    strikes
        Whether a corner strikes within the drift after it.
    flat
        Whether contacts constrain velocities in it, and may end deeper than they began.
    """

    kick: Kick
    velocity: Array
    forces: Array
    active: Active
    impulse: Array
    impacts: ImpactOutcome | None
    stages: tuple[Stage, ...]
    start_velocity: Array
    duration: float
    slides: bool
    strikes: bool = False
    flat: bool = False

    @property
    def coordinates(self) -> tuple[Coordinates, Coordinates]:
        """The positions at its time, and the velocities after it."""
        return self.kick.pose, Coordinates(self.velocity)
