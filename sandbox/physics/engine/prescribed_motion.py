"""Kinematic bodies that follow formulas of time."""

from collections.abc import Mapping

import numpy as np

from sandbox.model.body import Body, Motion
from sandbox.model.expressions import Array, Values
from sandbox.model.shapes import XY
from sandbox.physics.engine.space_arrays import Batch


class Motions:
    """Sets the velocities of bodies that follow formulas; the rows of these are `bodies`, (k,).

    In a drift a body moves in a straight line. So between two steps its velocity is that of the
    chord,

        v = (x(t + h) − x(t)) / h,

    which is leapfrog's velocity midway between them: at each step the body is where its formula
    says, to rounding, and contacts and joints see a surface of the body's own velocity. At a step
    its velocity is the central difference (x(t + h) − x(t − h)) / 2 h, at the start the derivative.
    """

    def __init__(self, bodies: Mapping[str, Body], values: Values, batch: Batch, dt: float) -> None:
        self._values, self._batch, self._dt = values, batch, dt
        self._formulas = [
            (*body.motion.displacement, body.motion.turn) for body in bodies.values() if body.motion
        ]
        self.bodies = np.flatnonzero([body.motion is not None for body in bodies.values()])
        self._next = np.zeros((len(self.bodies), 3))

    def accelerations(self, t: float, length: float) -> Array:
        """Find the velocities of the drift after a step, and return the accelerations: (k, 3).

        `t` is the time of the step, and `length` the duration of the kick that sets the
        velocities [s].
        """
        ends = np.array([t, t + self._dt])
        for row, formulas in enumerate(self._formulas):
            for axis, formula in enumerate(formulas):
                start, end = formula.over(self._values, ends)
                self._next[row, axis] = (end - start) / self._dt
        change: Array = self._next - self._batch.velocity()[self.bodies]
        return change / length

    def set_velocities(self) -> None:
        """Set these velocities."""
        velocity = self._batch.velocity()
        velocity[self.bodies] = self._next
        self._batch.set_velocity(velocity)


def velocities_at_start(motion: Motion, values: Values) -> tuple[XY, float]:
    """Return the initial velocity and angular velocity of a motion [m/s, rad/s]."""
    x, y, turn = (
        float(formula.slope("t").at(values, {"t": np.zeros(())}))
        for formula in (*motion.displacement, motion.turn)
    )
    return (x, y), turn
