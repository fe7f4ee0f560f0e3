"""What an exact joint says: equations between the coordinates of bodies.

The plane is complex here: a point is x + iy, and dC = Re(conj(J) dz) + K dθ.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple, Protocol

from sandbox.model.expressions import Array
from sandbox.physics.anchor import Plane


class Coordinates(NamedTuple):
    """Places or velocities of all bodies, the plane itself last: (n + 1,) each."""

    plane: Plane
    angle: Array


class Rows(NamedTuple):
    """What rows add up to (m,), and their gradients (m, n + 1) in the plane and in the angles."""

    total: Array
    gradient: Plane
    turning: Array | None


class Reply(NamedTuple):
    """How the bodies answer a unit impulse of each row: (m, n + 1)."""

    plane: Plane
    angle: Array | None

    def to(self, impulse: Array, motion: Coordinates) -> Coordinates:
        """Return the motion after impulses along the rows; a positive one pulls."""
        return Coordinates(
            motion.plane - impulse @ self.plane,
            motion.angle if self.angle is None else motion.angle - impulse @ self.angle,
        )

    def answers(self, rows: Rows) -> Array:
        """Return how fast each row shortens by a unit impulse of each: (m, m)."""
        slope: Array = (rows.gradient.conj() @ self.plane.T).real
        if rows.turning is not None and self.angle is not None:
            slope += rows.turning @ self.angle.T
        return slope


class Share(NamedTuple):
    """How an equation changes with one body's place and angle."""

    body: int
    """its number; −1 is the plane itself"""
    plane: complex
    angle: float


class Condition(Protocol):
    """Something that keeps a value, C(q) = `length`; its unit is a length, or a multiple of one."""

    @property
    def joint(self) -> str:
        """The name of the joint it belongs to."""
        ...

    @property
    def length(self) -> float:
        """The value that it keeps."""
        ...

    @property
    def changing(self) -> Callable[[float], float] | None:
        """What is to be added to that value at a time; None if it stays."""
        ...

    @property
    def pulls_only(self) -> bool:
        """Whether the value may also be smaller, as the length of a rope."""
        ...


class Equation(Condition, Protocol):
    """A condition that knows its own value and gradient."""

    def look(self, place: Coordinates) -> tuple[float, Sequence[Share]]:
        """Return the value somewhere, and its gradient there."""
        ...
