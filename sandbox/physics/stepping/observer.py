"""The state at a step, from the velocities half a kick before and after it.

The velocity at a step is the mean of the two, and the acceleration their difference over the kick.
Where something hits there is no such mean (see `post_impact` and `sequential_impacts`), and joints
know better where a step has several kicks (see `shake`).
"""

from typing import TYPE_CHECKING

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.level import Level, Stepping
from sandbox.physics.contacts.post_impact import impacts
from sandbox.physics.engine.batch import Contacts
from sandbox.physics.scene.integrators import Substep
from sandbox.physics.scene.scene import Scene
from sandbox.physics.state.motion import Instant
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.applied_forces import Forces

if TYPE_CHECKING:
    from sandbox.physics.contacts.direct.solver import Direct
    from sandbox.physics.contacts.sequential_impacts import Sequence


class Observer:
    """Makes snapshots of a scene; n bodies.

    Parameters
    ----------
    level, stepping
        What the scene was built from.
    scene
        What moves.
    forces
        What gravity and the force laws do.
    strikes
        What finds impacts, and tells what they did; None where that is pymunk.
    """

    def __init__(
        self,
        level: Level,
        stepping: Stepping,
        scene: Scene,
        forces: Forces,
        strikes: "Sequence | Direct | None",
    ) -> None:
        self._dt, self._leapfrog = 1 / stepping.rate, not stepping.as_it_comes
        self._mass, self._joints, self._hollows = scene.mass, scene.joints, scene.hollows
        self._forces, self._strikes = forces, strikes
        self._bounces = level.effects.restitution is not None
        self._untouched = np.zeros(len(scene.mass))
        self._untouched.setflags(write=False)

    def rates(
        self, state: Array, before: Array, contacts: Contacts, parts: list[Substep]
    ) -> tuple[Array, Array]:
        """Return the velocities and accelerations at a step: (n, 3) each.

        Parameters
        ----------
        state
            (n, 6), places at the step, and velocities half a kick after it.
        before
            (n, 3), the velocities half a kick before it [m/s, rad/s].
        contacts
            Of the kick.
        parts
            What the step is made of.
        """
        after = state[:, 3:]
        velocity, acceleration = after, (after - before) / parts[-1].kick
        if not self._leapfrog:
            return velocity, acceleration
        velocity = (before + after) / 2
        if len(parts) > 1 and self._joints.together:
            velocity, acceleration = self._joints.together.motion(velocity, self._forces.smooth)
        if self._strikes:
            struck = self._strikes.last
            if len(hit := np.flatnonzero(struck.struck)):
                acceleration[hit] = (after - struck.velocity)[hit] / (self._dt / 2)
                velocity[hit] = struck.velocity[hit]
        elif contacts.first.any() or self._bounces:
            solid, pull = self._joints.solids.pairs, self._forces.smooth
            place = state[:, :3]
            if self._hollows:
                contacts = self._hollows.impacts(contacts)
            hit, onwards = impacts(
                contacts, solid, place, before, after, pull, self._mass, self._dt
            )
            acceleration[hit] = onwards
            velocity[hit] = after[hit] - onwards * (self._dt / 2)
        return velocity, acceleration

    def snapshot(
        self,
        t: float,
        state: Array,
        velocity: Array,
        acceleration: Array,
        contacts: Contacts,
        kick: float,
    ) -> Snapshot:
        """Return the state at a step.

        Parameters
        ----------
        t
            The time [s].
        state
            (n, 6), of which places count.
        velocity, acceleration
            (n, 3), at the step.
        contacts
            Of the kick around it.
        kick
            How long that was [s].
        """
        normal = friction = self._untouched
        if len(contacts.bodies):
            normal, friction = (
                _sums(contacts, values / kick, len(self._untouched))
                for values in (contacts.normal, contacts.friction)
            )
            if self._strikes:
                normal = normal + self._strikes.last.impulse / kick
        motion = Instant.at(t, state, velocity)
        return Snapshot(
            *motion,
            acceleration=acceleration[:, :2],
            angular_acceleration=acceleration[:, 2],
            normal=normal,
            friction=friction,
            tension=self._joints.tension(motion),
            torque=self._joints.torque(),
        )


def _sums(contacts: Contacts, values: Array, count: int) -> Array:
    """Add up for each body the values of its contacts."""
    sums = np.bincount(contacts.bodies.T.ravel(), np.concatenate((values, values)), count)
    return sums.astype(np.float64, copy=False)
