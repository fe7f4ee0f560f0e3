"""Subdivision of a drift whose contacts and joints have no solution as a whole.

A heavy wheel on a chain of light planks whips them straight. No impulses then keep their lengths
until the end of the drift: the equations of the step have no solution. For a shorter drift they
have one. So this drift is divided into equal parts, as few as suffice, with a kick between any two.
In these kicks the forces are those of the last one, and the contacts and joints stay the same.
pymunk receives the mean velocities of the whole drift.
"""

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.kicks.kick_records import KickResult, Stage
from sandbox.physics.contacts.direct.rows.kick_system import Kick
from sandbox.physics.contacts.direct.solving.end_of_drift_impulses import hold
from sandbox.physics.engine.space_arrays import Booleans, Integers
from sandbox.physics.joints.exact.constraint_interface import Coordinates
from sandbox.physics.joints.exact.joint_system import KeptLengths
from sandbox.physics.state.simulation_errors import JointFailure, NoForces

PARTS = (2, 4, 8, 16, 32)
"""The numbers of parts that are tried in turn. Only with the last one may velocities be constrained
where positions cannot be."""


class KickBetweenParts(NamedTuple):
    """A kick between two parts of a drift; n bodies, m equations of joints.

    `pose`, (n, 3), are the positions there [m, rad], `jacobian`, (m, n, 3), is that of the joints'
    equations there, and `stage` is the kick.
    """

    pose: Array
    jacobian: Array
    stage: Stage


class DividedDrift(NamedTuple):
    """A drift in parts, for the rest of the step; n bodies.

    Attributes
    ----------
    post_kick_velocity
        (n, 3), the velocities after a whole kick before it [m/s, rad/s].
    pre_kick_velocity
        (n, 3), the velocities before a whole kick after it [m/s, rad/s].
    reached
        (n,), which bodies move in parts; the others go straight on through all of it.
    stages_before
        The stages of the kick before it, which ends in the middle of the first part of the drift.
    kicks_between
        The kicks in it, and at its end the excess of the whole kick after it, taken back.
    first_fraction
        The first share of it, in the middle of which the books are read.
    end_pose
        (n, 3), the positions at its end [m, rad].
    excess_energy
        The excess of the energy in the middle of it that only another acceleration explains [J].
    """

    post_kick_velocity: Array
    pre_kick_velocity: Array
    reached: Booleans
    stages_before: tuple[Stage, ...]
    kicks_between: tuple[KickBetweenParts, ...]
    first_fraction: float
    end_pose: Array
    excess_energy: float = 0.0


class SolvedInnerKick(NamedTuple):
    """A solved kick between two parts of a drift; r rows, N bodies with the plane.

    `kick` is its system, and `duration` its length [s]. `impulse`, (r,), are its impulses, and
    `velocity`, (3 N,), the velocities after it [m/s, rad/s].
    """

    kick: Kick
    duration: float
    impulse: Array
    velocity: Array

    def kick_record(self, start: Array, origin: Array, order: Integers) -> KickBetweenParts:
        """Return it for the rest of the step.

        `start`, (n, 3), and `origin`, (3 N,), are the positions at the start of the drift, by
        bodies and as coordinates [m, rad]; `order`, (n, 3), has the indices of the coordinates of
        each body.
        """
        kick = self.kick
        pose = start + (kick.pose.values - origin)[order]
        jacobian = -kick.rows_at_start.jacobian[kick.layout.joints][:, order]
        stage = Stage.of(kick, self.duration, self.velocity[order], self.impulse)
        return KickBetweenParts(pose, jacobian, stage)


class SolvedDrift(NamedTuple):
    """A solved drift in parts; r rows, N bodies with the plane.

    `first` is the kick before it, shorter than a whole one by the time `missing` [s]; `inner` are
    the kicks in it. The acceleration, (3 N,), is that by gravity and force laws in all of
    them [m/s², rad/s²]; `displacement`, (3 N,), is that of the bodies [m, rad].
    """

    first: KickResult
    inner: tuple[SolvedInnerKick, ...]
    acceleration: Array
    missing: float
    displacement: Array

    @property
    def full_impulse(self) -> Array:
        """(r,), the impulses of a whole kick before it."""
        return self.first.impulse + self.missing * self.first.forces

    def drift_record(self, start: Array, order: Integers) -> DividedDrift:
        """Return it for the rest of the step, from the pose `start`, (n, 3) [m, rad]."""
        first, missing = self.first, self.missing
        kick, velocity = first.kick, first.velocity
        forces = first.forces.dot(kick.response)
        length = kick.joints.kick - missing
        velocity_before = (self.inner[-1].velocity - missing * self.acceleration)[order]
        between = [one.kick_record(start, kick.pose.values, order) for one in self.inner]
        end, last = start + self.displacement[order], between[-1]
        nothing = Stage.of(
            self.inner[-1].kick, -missing, velocity_before, 0.0 * self.inner[-1].impulse
        )
        back = KickBetweenParts(end, last.jacobian, nothing)
        return DividedDrift(
            (velocity + missing * (self.acceleration + forces))[order],
            velocity_before,
            np.ones(len(start), dtype=bool),
            first.stages or (Stage.of(kick, length, velocity[order], first.impulse),),
            (*between, back),
            1 / (len(between) + 1),
            end,
        )


def through(
    kick: Kick, acceleration: Array, until: float, take: Callable[..., KickResult]
) -> SolvedDrift:
    """Return the drift after a kick of a step, in parts.

    The system of `kick` has no solution for the whole drift, which ends at the time `until` [s].
    `acceleration`, (3 N,), is that by gravity and force laws [m/s², rad/s²]. `take` takes a kick,
    whose length its joints know; for `placed` see `hold`. Raises `JointFailure` or `NoForces` if
    there is no solution in any number of parts.
    """
    joints, whole = kick.joints, kick.joints.drift
    last_error: JointFailure | NoForces | None = None
    for parts in PARTS:
        times = until - whole + whole * np.arange(parts + 1) / parts
        kept_lengths_by_part = [joints.kept_lengths(*drift) for drift in pairwise(times.tolist())]
        try:
            return _in_parts(
                kick, acceleration, kept_lengths_by_part, take, placed=parts < PARTS[-1]
            )
        except (JointFailure, NoForces) as error:
            last_error = error
        finally:
            joints.time(whole, whole)
    assert last_error
    raise last_error


def _in_parts(
    kick: Kick,
    acceleration: Array,
    kept_lengths_by_part: Sequence[KeptLengths],
    take: Callable[..., KickResult],
    *,
    placed: bool,
) -> SolvedDrift:
    """Return the drift, given the joints' lengths in its parts."""
    joints, whole = kick.joints, kick.joints.drift
    drift = whole / len(kept_lengths_by_part)
    missing = (whole - drift) / 2  # of the length of the kicks before and after
    joints.time(whole - missing, drift)
    first = take(kick.before_drift(kept_lengths_by_part[0]), placed=placed)
    velocity, forces, active = first.velocity, first.forces, first.active
    joints.time(drift, drift)
    pose, inner = Coordinates(kick.pose.values + drift * velocity), []
    for kept_lengths in kept_lengths_by_part[1:]:
        now = kick.between(pose, kept_lengths)
        motion = velocity + drift * acceleration
        impulse, velocity, active, _ = hold(
            now, motion, (drift * forces, active), driven=False, placed=placed
        )
        inner.append(SolvedInnerKick(now, drift, impulse, velocity))
        forces = impulse / drift
        pose = Coordinates(pose.values + drift * velocity)
    return SolvedDrift(first, tuple(inner), acceleration, missing, pose.values - kick.pose.values)
