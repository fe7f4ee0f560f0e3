"""The observer: the state at a step, from the velocities half a kick before and after it.

The velocity at a step is the mean of the two, and the acceleration their difference over the kick.
For bodies that collide the mean is wrong (see `impact_step_velocity` and `sequential_impacts`). If
a step has several kicks, the joints determine velocity and acceleration (see `rattle`).
"""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.space_arrays import NO_CONTACTS, Contacts
from sandbox.physics.state.motion import Instant
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.step_plugin import Plugins, Setup

if TYPE_CHECKING:
    from sandbox.physics.energy.step_record import StepRecord


class Observation(NamedTuple):
    """The observed state at a step; n bodies."""

    steps: int
    """The number of steps taken."""
    snapshot: Snapshot
    contacts: Contacts
    """The state, and the contacts."""
    pre_kick_velocity: Array
    """(n, 3), the velocities at the beginning of the last kick [m/s, rad/s]."""
    post_kick_velocity: Array | None
    """(n, 3), the velocities at its end; None at the start of a run."""


class Observer:
    """Makes snapshots of a scene, with contacts and impacts that plugins report; n bodies."""

    def __init__(self, setup: Setup, plugins: Plugins) -> None:
        self._scene, self._forces, self._kicks = setup.scene, setup.forces, setup.kicks
        self._leapfrog, effects = setup.leapfrog, setup.level.effects
        self._has_contacts = effects.contact is not None
        self._impact_solver = setup.scene.sequence or setup.scene.direct
        self._has_restitution = effects.restitution is not None
        self._plugins = plugins
        self._no_forces = np.zeros(len(setup.scene.mass))
        self._no_forces.setflags(write=False)

    def observe(self, pre_kick_velocity: Array) -> Observation:
        """Return the state at the last step.

        `pre_kick_velocity`, (n, 3), are the velocities half a kick before the step [m/s, rad/s].
        """
        state, contacts, direct = self._scene.batch.state(), self.contacts(), self._scene.direct
        if (
            direct and direct.drifts.post_kick_velocity is not None
        ):  # landing bodies have changed them since
            state[:, 3:] = direct.drifts.post_kick_velocity
        begun = self._forces.after_belated_change(pre_kick_velocity)
        rates = self._rates(state, begun, contacts)
        if (impacts := self._plugins.impacts) and (found := impacts()):
            from sandbox.physics.events.impact_response import as_contacts

            contacts = as_contacts(found).followed_by(contacts)
        snapshot = self.snapshot(state, *rates, contacts, self._kicks.clock.dt)
        return Observation(
            self._kicks.clock.steps, snapshot, contacts, pre_kick_velocity, state[:, 3:]
        )

    def velocity(self, observation: Observation) -> Array:
        """Return the velocities between the last step and the next: (n, 3) [m/s, rad/s]."""
        if direct := self._scene.direct:
            return direct.velocity()
        if observation.post_kick_velocity is None or observation.steps != self._kicks.clock.steps:
            return self._scene.batch.velocity()
        return observation.post_kick_velocity

    def record(self, observation: Observation) -> "StepRecord":
        """Return the record of the last observed step, for books."""
        from sandbox.physics.energy.step_record import StepRecord

        forces, kicks = self._forces, self._kicks
        record = StepRecord(
            steps=kicks.clock.steps,
            dt=kicks.clock.dt,
            snapshot=observation.snapshot,
            contacts=observation.contacts,
            pre_kick_velocity=observation.pre_kick_velocity,
            post_kick_velocity=observation.post_kick_velocity,
            law_motion=forces.law_motion,
            law_acceleration=forces.law_acceleration,
            turning_acceleration=forces.turning_acceleration,
            parts=kicks.parts,
            trail=kicks.trail or (),
            hold=forces.hand.hold if forces.hand else None,
            belated_change=forces.belated_change,
        )
        for add in self._plugins.record:
            record = add(record)
        return record

    def contacts(self) -> Contacts:
        """Return the contacts of the last kick."""
        if not self._has_contacts:
            return NO_CONTACTS
        touches = self._scene.joints.touches
        contacts = (self._plugins.contacts or self._scene.batch.contacts)()
        return touches.with_latest(contacts) if touches else contacts

    def _rates(self, state: Array, before: Array, contacts: Contacts) -> tuple[Array, Array]:
        """Return the velocities and accelerations at a step: (n, 3) each.

        `state`, (n, 6), has the positions at the step and the velocities half a kick after it;
        `before`, (n, 3), has the velocities half a kick before it.
        """
        after, parts = state[:, 3:], self._kicks.parts
        acceleration = (after - before) / parts[-1].kick
        if not self._leapfrog:
            return after, acceleration
        velocity = (before + after) / 2
        if (turning := self._forces.turning_rates) is not None:
            from sandbox.physics.forces.velocity_rotation import at_the_step

            velocity[:, :2] = at_the_step(turning, velocity[:, :2], self._kicks.clock.dt)
        if len(parts) > 1 and (joints := self._scene.joints.together):
            velocity, acceleration = joints.motion(velocity, self._forces.law_acceleration)
        if self._impact_solver:
            impacts, half = self._impact_solver.last, self._kicks.clock.dt / 2
            if len(hit := np.flatnonzero(impacts.struck)):
                acceleration[hit] = (after - impacts.velocity)[hit] / half
                velocity[hit] = impacts.velocity[hit]
        elif self._has_contacts and (self._has_restitution or contacts.first.any()):
            self._take_impacts(state, before, contacts, (velocity, acceleration))
        return velocity, acceleration

    def _take_impacts(
        self, state: Array, before: Array, contacts: Contacts, rates: tuple[Array, Array]
    ) -> None:
        """Correct the velocities and accelerations of bodies that collided in pymunk's kick."""
        from sandbox.physics.contacts.impacts.impact_step_velocity import impacts

        (velocity, acceleration), after = rates, state[:, 3:]
        scene = self._scene
        law_acceleration = self._forces.law_acceleration
        dt = self._kicks.clock.dt
        if scene.hollows:
            contacts = scene.hollows.impacts(contacts)
        welded, pose = scene.joints.joined, state[:, :3]
        hit, later_acceleration = impacts(
            contacts, welded, pose, before, after, law_acceleration, scene.mass, dt
        )
        acceleration[hit] = later_acceleration
        velocity[hit] = after[hit] - later_acceleration * (dt / 2)

    def snapshot(
        self, state: Array, velocity: Array, acceleration: Array, contacts: Contacts, kick: float
    ) -> Snapshot:
        """Return the state at the present step.

        Of `state`, (n, 6), the positions are used; `velocity` and `acceleration`, (n, 3), are those
        at the step, `contacts` those of the kick around it, and `kick` is its length [s].
        """
        normal = friction = self._no_forces
        if len(contacts.bodies):
            both, count = contacts.bodies.T.ravel(), len(self._no_forces)
            normal, friction = (
                np.bincount(both, np.concatenate((force, force)), count).astype(float, copy=False)
                for force in (contacts.normal / kick, contacts.friction / kick)
            )
            if self._impact_solver:
                normal = normal + self._impact_solver.last.impulse / kick
        motion = Instant.at(self._kicks.clock.after(0), state, velocity)
        return Snapshot(
            *motion,
            acceleration=acceleration[:, :2],
            angular_acceleration=acceleration[:, 2],
            normal=normal,
            friction=friction,
            tension=self._scene.joints.tensions(),
            torque=self._scene.joints.torque(),
        )
