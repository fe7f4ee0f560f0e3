"""Forces that turn velocities and do no work, as a rotation inside the kick.

This is J. P. Boris's method (Proc. 4th Conf. Numerical Simulation of Plasmas, 1970): half of the
kick by all other forces, then a rotation, then the other half,

    v₊ = R(ω h) (v₋ + a h/2) + a h/2.

The rotation is by the whole angle. So in a uniform field a velocity turns at the exact rate for any
step, and keeps its magnitude to rounding. Positions follow in straight drifts, so the radius of a
circle is too large by a fraction of (ω h)² / 24: second order, like leapfrog as a whole.

At a step, half-way through the kick, the velocity is (v₋ + v₊) / (2 cos(ω h / 2)), as v₋ + v₊ is
the chord of an arc. The impulse is v₊ − v₋ − a h = 2 tan(ω h / 2) J (v₋ + v₊)/2, where J is the
quarter turn. It is perpendicular to the mean velocity, so its work is exactly zero.

Where impacts change velocities at once, the mean of ω J v along the path is made up for in the next
kick, as that of all forces that depend on velocities; then the work is zero to second order.
"""

from collections.abc import Sequence

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.forces.law import VelocityRotation
from sandbox.physics.state.motion import Motion


def rotation_rates(turns: Sequence[VelocityRotation], motion: Motion) -> Array:
    """Return the total rate at which the velocity of each body turns: (n,) [rad/s]."""
    return np.asarray(sum(turn.rate(motion) for turn in turns))


def turning_acceleration(rate: Array, velocity: Array, others: Array, length: float) -> Array:
    """Return the mean acceleration by the rotation in a kick: (n, 2) [m/s²].

    The rates of rotation are (n,) [rad/s], the velocities those before the kick, (n, 2) [m/s];
    `others` are the accelerations by all other forces, (n, 2) [m/s²], and `length` is the duration
    of the kick [s].
    """
    middle, half = velocity + others * (length / 2), rate * (length / 2)
    s, c = np.sin(half)[:, None], np.cos(half)[:, None]
    return np.asarray(2 * s * (c * quarter_turn(middle) - s * middle) / length)  # (R − 1) v / h


def at_the_step(rate: Array, mean: Array, length: float) -> Array:
    """Return the velocities (n, 2) half-way through a kick, from the means before and after."""
    return np.asarray(mean / np.cos(rate * (length / 2))[:, None])


def mean_acceleration(
    turns: Sequence[VelocityRotation], path: Sequence[tuple[float, Motion]]
) -> Array | float:
    """Return the mean acceleration by the rotation in motions with weights: (n, 2) [m/s²].

    Without motions it is 0.
    """
    parts = (
        weight * rotation_rates(turns, motion)[:, None] * quarter_turn(motion.velocity)
        for weight, motion in path
    )
    return sum(parts, 0.0)


def quarter_turn(velocity: Array) -> Array:
    """Return velocities (n, 2) rotated by a quarter turn counter-clockwise."""
    return np.column_stack((-velocity[:, 1], velocity[:, 0]))
