"""A hand that takes hold of bodies."""

from collections.abc import Sequence

import pymunk

from sandbox.model.shapes import XY

STRENGTH = 200
"""m/s², by which it can accelerate what it holds: about twenty times g."""


class Hand:
    """Pulls at a point of one body at a time, as with a stiff spring."""

    def __init__(self, space: pymunk.Space, bodies: Sequence[pymunk.Body]) -> None:
        self._space, self._bodies = space, bodies
        self._grip: pymunk.PivotJoint | None = None

    def grab(self, row: int, point: XY) -> None:
        """Take hold of a dynamic body at a point of the plane [m]."""
        held = self._bodies[row]
        self.release()
        grip = pymunk.PivotJoint(self._space.static_body, held, point, held.world_to_local(point))
        grip.max_force = STRENGTH * held.mass
        grip.error_bias = 0.8**60
        self._space.add(grip)
        self._grip = grip

    def drag(self, point: XY) -> None:
        """Pull what is held towards a point of the plane [m]."""
        if self._grip:
            self._grip.anchor_a = point

    def release(self) -> None:
        """Let go of what is held."""
        if self._grip:
            self._space.remove(self._grip)
            self._grip = None

    @property
    def hold(self) -> tuple[int, XY] | None:
        """The row of the body that is held, and the arm from its centre to the grip [m]."""
        if self._grip is None:
            return None
        body = self._grip.b
        return self._bodies.index(body), self._grip.anchor_b.rotated(body.angle)
