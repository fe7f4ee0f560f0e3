"""The applied forces, which bodies are given before each kick."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.space_arrays import Integers
from sandbox.physics.forces.law import add_belated
from sandbox.physics.forces.variable_mass import MassFlows
from sandbox.physics.scene.make_scene import Scene
from sandbox.physics.state.kick_context import Kick
from sandbox.physics.state.motion import Reading

if TYPE_CHECKING:
    from sandbox.physics.contacts.direct.drifts.fallback_subdivision import DividedDrift
    from sandbox.physics.contacts.impacts.impact_outcome import ImpactOutcome
    from sandbox.physics.engine.grab_spring import Hand
    from sandbox.physics.joints.exact.shake import ExactJoints


class Forces:
    """Gravity and the force laws of a scene; n bodies.

    The last force of joints, `warm_started`, acts from the start of a kick. In `leapfrog`, the
    velocities before a kick are half a step old. `law_motion` is the motion that the laws saw in
    the last kick; None without laws, or before it. `hand` is the hand that grabs bodies; None until
    one has. `turning_rates`, (n,) [rad/s], and `turning_acceleration`, (n, 2) [m/s²], are how the
    last kick rotated velocities; None if nothing did. `belated_change`, (n, 3), is added to the
    velocities at the beginning of the last kick, to make up for what forces did differently before
    it, see `Reading.path` [m/s, rad/s]; None if there is nothing to make up for.
    """

    def __init__(self, scene: Scene, warm_started: "ExactJoints | None", *, leapfrog: bool) -> None:
        self._batch, self._laws = scene.batch, scene.hooked_laws
        self._mass_flows = (
            scene.mass_fraction if isinstance(scene.mass_fraction, MassFlows) else None
        )
        self._turns = scene.rotations
        self._mass, self._moment, self._inverse = scene.mass, scene.moment, scene.inverse_mass
        self._bodies, self._warm_started = list(scene.bodies.values()), warm_started
        self._direct, self._together = scene.direct, scene.joints.together
        sees_velocity = any(law.effect.depends_on_velocity for law in scene.laws)
        self._extrapolates = leapfrog and (sees_velocity or bool(scene.rotations))
        self._base_acceleration = np.zeros((len(self._bodies), 3))  # acceleration by gravity
        if scene.gravity:
            self._base_acceleration[scene.mass > 0, :2] = scene.gravity.acceleration
        self._wrench = np.zeros_like(self._base_acceleration)  # by the laws in the last kick
        self._inverse_mass = scene.inverse_mass
        # (n, 3), velocities before the last kick, to extrapolate those at the next
        self._previous_velocity: Array = np.zeros_like(self._base_acceleration)
        self.hand: Hand | None = None
        self.turning_rates: Array | None = None
        self.turning_acceleration: Array | None = None
        self.law_motion: Reading | None = None
        self._struck: ImpactOutcome | None = None  # the impacts in the last kick
        self.belated_change: Array | None = None

    @property
    def acts(self) -> bool:
        """Whether any force has to be applied before a kick."""
        return bool(self._laws or self._turns or self._warm_started)

    @property
    def law_acceleration(self) -> Array:
        """The acceleration by gravity and laws in the last kick: (n, 3) [m/s², rad/s²].

        For kinematic bodies it is the one prescribed by the level.
        """
        return self._base_acceleration + self._wrench * self._inverse_mass

    def set_prescribed(self, bodies: Integers, acceleration: Array) -> None:
        """Set the accelerations of kinematic bodies: (k, 3)."""
        self._base_acceleration[bodies] = acceleration

    def start(self, velocity_before: Array, velocity_after: Array) -> None:
        """Note the first half kick: the velocities before and after it [m/s, rad/s]."""
        self.restart(velocity_before + (velocity_before - velocity_after))

    def restart(self, previous_velocity: Array) -> None:
        """Replace the velocities at the beginning of the last kick: (n, 3) [m/s, rad/s]."""
        if self._extrapolates:
            self._previous_velocity = previous_velocity

    def shift(self, jump: Array, wrench_change: Array | None = None) -> None:
        """Add a jump of velocities since the beginning of the last kick: (n, 3) [m/s, rad/s].

        `wrench_change`, (n, 3), is how the laws have changed since then [N, N m].
        """
        if wrench_change is not None:
            self._wrench = self._wrench + wrench_change
        if self._extrapolates:
            self._previous_velocity = self._previous_velocity + jump

    def shift_by_impacts(self, impacts: "ImpactOutcome") -> None:
        """Add the jumps of velocities in the impacts of the last kick, which the next one sees."""
        if self._extrapolates and np.count_nonzero(impacts.struck):
            self.shift(impacts.jump)
            self._struck = impacts

    @contextmanager
    def trial(self) -> Iterator[None]:
        """Restore the state of the last kick after trial kicks."""
        saved = self._previous_velocity, self.law_motion, self._wrench
        noted = self._struck, self.belated_change
        self._wrench = self._wrench.copy()
        try:
            yield
        finally:
            self._previous_velocity, self.law_motion, self._wrench = saved
            self._struck, self.belated_change = noted

    def acceleration_with_hand(self, dt: float) -> Array:
        """Return the accelerations in a kick of a length [s], including the hand's: (n, 3)."""
        if self.hand is None or not self.hand.hold:
            return self.law_acceleration
        return self.law_acceleration + self.hand.pull(self._batch.velocity(), self._inverse, dt)

    def after_belated_change(self, velocity: Array) -> Array:
        """Return velocities before the last kick, (n, 3), with the changes at its beginning."""
        return velocity if self.belated_change is None else velocity + self.belated_change

    def apply(self, kick: Kick) -> None:
        """Read all bodies once, add up the laws, and write all forces once."""
        constraint_change = self._constraint_change(kick) if self._turns else None
        last, struck, self._struck = self.law_motion, self._struck, None
        self.law_motion = reading = self._read(kick)
        if last and kick.start is None and (struck or self._landed):
            from sandbox.physics.stepping.forces_across_impacts import weighted_motions

            dt = kick.clock.dt
            reading.path = weighted_motions(last, reading, dt, struck, self._landed)
        if self._mass_flows:
            self._set_masses(self._mass_flows, reading.t)
        wrench = self._wrench
        wrench.fill(0.0)
        for law in self._laws:
            law.add(reading, wrench)
        belated = self._belated_wrench(reading) if reading.path else None
        self.belated_change = None
        if belated is not None:
            self.belated_change = belated * self._inverse_mass * kick.length
            self.shift(self.belated_change)
        if constraint_change is not None:
            self._add_rotation(reading, wrench, constraint_change, kick.length)
        if belated is not None:
            wrench = wrench + belated
        if self._warm_started:
            wrench = wrench.copy()
            self._warm_started.warm_start(wrench)
        self._batch.set_force(wrench if kick.scale == 1 else wrench * kick.scale)

    def _belated_wrench(self, reading: Reading) -> Array:
        """Return the mean force in a kick that makes up for the path of a motion: (n, 3)."""
        wrench = np.zeros_like(self._wrench)
        for law in self._laws:
            add_belated(law, reading, wrench)
        if self._turns:
            from sandbox.physics.forces.velocity_rotation import mean_acceleration

            wrench[:, :2] += self._moving(mean_acceleration(self._turns, reading.path))
        return wrench

    def _constraint_change(self, kick: Kick) -> Array:
        """Return the change of velocities by joints and contacts in the last kick: (n, 2) [m/s].

        It is unknown, and 0, in the first kick of a motion, which is shorter than a step.
        """
        if not self._extrapolates or kick.start is not None or kick.length != kick.clock.dt:
            return np.zeros_like(self._base_acceleration[:, :2])
        if self._direct and self._landed:
            change = self._direct.expected_change
        else:
            change = self._batch.velocity() - self._previous_velocity
        return (change - self.law_acceleration * kick.length)[:, :2]

    def _add_rotation(
        self, reading: Reading, wrench: Array, constraint_change: Array, length: float
    ) -> None:
        """Add the forces that rotate velocities in a kick of a length [s], given all others."""
        from sandbox.physics.forces.velocity_rotation import rotation_rates, turning_acceleration

        self.turning_rates = rotation_rates(self._turns, reading)
        velocity = self._previous_velocity[:, :2] if self._extrapolates else reading.velocity
        inverse_mass = self._inverse_mass[:, :2]
        others = (
            self._base_acceleration[:, :2]
            + wrench[:, :2] * inverse_mass
            + constraint_change / length
        )
        self.turning_acceleration = acceleration = turning_acceleration(
            self.turning_rates, velocity, others, length
        )
        wrench[:, :2] += self._moving(acceleration)

    def _moving(self, acceleration: Array | float) -> Array:
        """Return the forces that give bodies an acceleration, (n, 2) [m/s²], at present: (n, 2)."""
        inverse_mass = self._inverse_mass[:, :2]
        forces: Array = np.zeros_like(inverse_mass)
        np.divide(acceleration, inverse_mass, out=forces, where=inverse_mass > 0)
        return forces

    def _read(self, kick: Kick) -> Reading:
        """Return the motion that the laws see in a kick.

        pymunk's velocities are half a step old. Those at the kick are, to second order, 3/2 of them
        less 1/2 of those one step earlier. Where bodies have landed since the last kick, the latter
        are replaced by those that forces alone would have changed to the former.
        """
        state = self._batch.state()
        if self._extrapolates:
            velocity, previous = state[:, 3:].copy(), self._previous_velocity
            if kick.start is not None:
                previous = kick.start
            elif landed := self._landed:
                reached, begun = landed.reached[:, None], landed.pre_kick_velocity
                previous = np.where(
                    reached, begun - self.law_acceleration * kick.clock.dt, previous
                )
                velocity = np.where(reached, begun, velocity)
            state[:, 3:] = 1.5 * velocity - 0.5 * previous
            self._previous_velocity = velocity
        return Reading(np.asarray(kick.t), state)

    @property
    def _landed(self) -> "DividedDrift | None":
        """The drift before this kick, if bodies landed in it."""
        return self._direct.drifts.drift_after if self._extrapolates and self._direct else None

    def _set_masses(self, flows: MassFlows, t: Array) -> None:
        """Set the variable masses to those at a time [s], for the kick around it."""
        fraction = flows(t)
        for row in flows.bodies:
            body = self._bodies[row]
            body.mass = self._mass[row] * fraction[row]
            if self._moment[row]:
                body.moment = self._moment[row] * fraction[row]
        self._inverse_mass = self._inverse / fraction[:, None]
        if self._together:
            self._together.set_inverse(self._inverse_mass)
