"""Grabbing: a stiff spring by which a hand holds a body."""

from collections.abc import Sequence

import numpy as np
import pymunk

from sandbox.model.expressions import Array
from sandbox.model.shapes import XY

STRENGTH = 200
"""m/s², the largest acceleration of the grabbed body: about twenty times g."""

TINY = 1e-300


class Hand:
    """Pulls at a point of one body at a time, like a stiff spring."""

    def __init__(self, space: pymunk.Space, bodies: Sequence[pymunk.Body]) -> None:
        self._space, self._bodies = space, bodies
        self._grip: pymunk.PivotJoint | None = None

    def grab(self, row: int, point: XY) -> None:
        """Take hold of a dynamic body at a point of the plane [m]."""
        body = self._bodies[row]
        self.release()
        grip = pymunk.PivotJoint(self._space.static_body, body, point, body.world_to_local(point))
        grip.max_force = STRENGTH * body.mass
        grip.error_bias = 0.8**60
        self._space.add(grip)
        self._grip = grip

    def drag(self, point: XY) -> None:
        """Pull the body that is held towards a point of the plane [m]."""
        if self._grip:
            self._grip.anchor_a = point

    def release(self) -> None:
        """Release the body."""
        if self._grip:
            self._space.remove(self._grip)
            self._grip = None

    def pull(self, velocity: Array, inverse_mass: Array, dt: float) -> Array:
        """Return the accelerations by its pull in a kick of length dt [s]: (n, 3) [m/s², rad/s²].

        They are those of pymunk's joint, for kicks that pymunk does not take. `velocity`, (n, 3),
        is that before the kick [m/s, rad/s]; `inverse_mass`, (n, 3), has masses and
        moments [1/kg, 1/(kg m²)].
        """
        accelerations = np.zeros_like(velocity)
        if self._grip is None or self.hold is None:
            return accelerations
        row, (x, y) = self.hold
        vx, vy, spin = velocity[row]
        inverse, inverse_moment = inverse_mass[row, 0], inverse_mass[row, 2]
        gap = self._grip.anchor_a - self._grip.b.position - (x, y)
        back = (1 - self._grip.error_bias**dt) / dt
        closing_velocity = np.array([gap.x * back - vx + spin * y, gap.y * back - vy - spin * x])
        delassus = inverse * np.eye(2) + inverse_moment * np.array(
            [[y * y, -x * y], [-x * y, x * x]]
        )
        impulse = np.linalg.solve(delassus, closing_velocity)
        impulse *= min(1.0, self._grip.max_force * dt / max(float(np.hypot(*impulse)), TINY))
        angular_impulse = x * impulse[1] - y * impulse[0]
        accelerations[row] = (
            impulse[0] * inverse,
            impulse[1] * inverse,
            angular_impulse * inverse_moment,
        )
        return accelerations / dt

    @property
    def hold(self) -> tuple[int, XY] | None:
        """The row of the body that is held, and the lever arm from its centre to the grip [m]."""
        if self._grip is None:
            return None
        body = self._grip.b
        return self._bodies.index(body), self._grip.anchor_b.rotated(body.angle)
