"""Snapshots: the state of a world at one step, or at many."""

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Self

import numpy as np

from sandbox.model.expressions import Array


@dataclass(frozen=True, slots=True)
class Snapshot:
    """Everything that moves, read at one instant; n bodies in the level's order, j joints.

    Arrays may have leading dimensions in front of those given here: a recorded run of T steps is a
    snapshot too, with T in front. Velocities are those *at* the step, not between two steps.

    Attributes
    ----------
    t
        (), time [s].
    position, velocity, acceleration
        (n, 2) [m, m/s, m/s²].
    angle, angular_velocity, angular_acceleration
        (n,) [rad, rad/s, rad/s²].
    normal, friction
        (n,), the sizes of the contact forces on each body, added up [N].
    tension
        (j,), with which each joint pulls [N]; of a wire, with which it pushes its bead to its left.
        0 of springs: theirs follows from the motion (`Joints.tension`).
    torque
        (j,), of each weld or motor on its second body [N m].
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
        """Put instants of one world behind each other, time in front."""
        names = [field.name for field in fields(cls)]
        return cls(**{name: np.array([getattr(s, name) for s in snapshots]) for name in names})
