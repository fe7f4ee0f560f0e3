"""Snapshots: the state of a world at one step, or at many."""

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Self

import numpy as np

from sandbox.model.expressions import Array


@dataclass(frozen=True, slots=True)
class Snapshot:
    """The state of a world at one instant; n bodies and j joints, in the level's order.

    Arrays may have leading axes before those given here: a recorded run of T steps is a snapshot
    with a leading axis of length T. Velocities are those *at* the step, not between two steps.

    Attributes
    ----------
    t
        (), time [s].
    position, velocity, acceleration
        (n, 2) [m, m/s, m/s²].
    angle, angular_velocity, angular_acceleration
        (n,) [rad, rad/s, rad/s²].
    normal, friction
        (n,), the sums of the sizes of the contact forces on each body [N].
    tension
        (j,), the force by which each joint pulls, or a wire pushes its bead to its left [N]. It is
        0 for springs, whose force follows from the motion (`Joints.tension`).
    torque
        (j,), the torque of each joint on its second body [N m].
    """

    t: Array
    position: Array
    angle: Array
    velocity: Array
    angular_velocity: Array
    acceleration: Array
    angular_acceleration: Array
    normal: Array
    friction: Array
    tension: Array
    torque: Array

    @classmethod
    def stack(cls, snapshots: Sequence[Self]) -> Self:
        """Return many instants of one world as one snapshot, with time as the leading axis."""
        names = [field.name for field in fields(cls)]
        return cls(**{name: np.array([getattr(s, name) for s in snapshots]) for name in names})
