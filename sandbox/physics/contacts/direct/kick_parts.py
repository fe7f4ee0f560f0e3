"""The parts of a kick, and what each did."""

from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.constraint_rows import Active
from sandbox.physics.contacts.direct.kick_system import Kick
from sandbox.physics.contacts.sequential_impacts import Impacts
from sandbox.physics.engine.batch import Booleans, Contacts


class Stage(NamedTuple):
    """A part of a kick with impacts: before them, the impacts, or after them.

    Attributes
    ----------
    lasts
        How long it is; 0 of the impacts [s].
    velocity
        (n, 3), the velocities that it ends with [m/s, rad/s].
    pulls
        (m,), the impulses along what joints keep; positive where they pull.
    contacts
        With the impulses in it.
    """

    lasts: float
    velocity: Array
    pulls: Array
    contacts: Contacts

    @classmethod
    def of(cls, kick: Kick, lasts: float, ended: Array, impulse: Array) -> "Stage":
        """Return what impulses, (r,), did in a part of a kick; for the others see above."""
        return cls(lasts, ended, impulse[kick.layout.joints], kick.pushing(impulse))

    def among(self, bodies: Booleans, joints: Booleans) -> "Stage":
        """Return what it gave some of the bodies, (n,), by some of what the joints keep, (m,)."""
        both = self.contacts
        some = np.any(bodies[both.bodies], axis=1)
        contacts = both._replace(
            normal=both.normal * some,
            friction=both.friction * some,
            impulse=both.impulse * some[:, None],
        )
        return self._replace(pulls=np.where(joints, self.pulls, 0.0), contacts=contacts)

    def normal(self, count: int) -> Array:
        """Return what pushed each of so many bodies, whichever way: (n,) [N s]."""
        both = self.contacts.bodies.T.ravel()
        pushed = np.bincount(both, np.tile(self.contacts.normal, 2), count)
        return np.asarray(pushed, dtype=float)


class Taken(NamedTuple):
    """A kick that was taken; r rows, N bodies with the plane.

    Attributes
    ----------
    kick
        Which.
    moved
        (3 N,), the velocities after it [m/s, rad/s].
    forces
        (r,), since its impacts, if it had any [N].
    active
        Which rows hold since.
    total
        (r,), the impulses of the whole kick.
    impacts
        What impacts did in it; None if there were none.
    stages
        Its parts, if there were impacts; else none.
    begun
        (3 N,), the velocities from which it goes on, after its impacts [m/s, rad/s].
    lasts
        How long it goes on from there [s].
    strikes
        Whether a corner strikes within the drift after it.
    """

    kick: Kick
    moved: Array
    forces: Array
    active: Active
    total: Array
    impacts: Impacts | None
    stages: tuple[Stage, ...]
    begun: Array
    lasts: float
    strikes: bool = False
