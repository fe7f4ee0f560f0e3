"""A pair of shapes that pymunk found to be close, read through its private handles.

Through pymunk's public interface it takes 12 µs to read an arbiter's shapes, bodies and points, and
as much again to replace a point. There is no public way to mark a pair as not having touched yet.
"""

import pymunk
from pymunk._chipmunk_cffi import ffi, lib


def address(shape: pymunk.Shape) -> int:
    """Return the memory address of a shape, which identifies it during its lifetime."""
    return int(ffi.cast("uintptr_t", shape._shape))  # noqa: SLF001


class PreSolveContact:
    """Two shapes that pymunk found to be close, before it solves their contact."""

    __slots__ = ("_arbiter", "shapes")

    def __init__(self, arbiter: pymunk.Arbiter) -> None:
        self._arbiter = arbiter._arbiter  # noqa: SLF001
        self.shapes: tuple[int, int] = (
            int(ffi.cast("uintptr_t", self._arbiter.a)),
            int(ffi.cast("uintptr_t", self._arbiter.b)),
        )

    def poses(self) -> tuple[tuple[complex, complex], tuple[complex, complex]]:
        """Return the positions and rotations of the two bodies: x + iy [m], cos + i sin."""
        arbiter = self._arbiter
        return _pose(arbiter.body_a), _pose(arbiter.body_b)

    @property
    def normal(self) -> complex:
        """The unit normal of the contact, from the first to the second."""
        return complex(self._arbiter.n.x, self._arbiter.n.y)

    @property
    def point(self) -> complex:
        """The first contact point, on the surface of the first [m]."""
        arm = self._arbiter.contacts[0].r1
        return _pose(self._arbiter.body_a)[0] + complex(arm.x, arm.y)

    def motions(self) -> tuple[tuple[complex, float], tuple[complex, float]]:
        """Return the velocities and angular velocities of the two bodies [m/s, rad/s]."""
        arbiter = self._arbiter
        return _motion(arbiter.body_a), _motion(arbiter.body_b)

    def bounce(self, restitution: float) -> None:
        """Set the restitution of the pair."""
        self._arbiter.e = restitution

    @property
    def restitution(self) -> float:
        """The coefficient of restitution of the pair."""
        return float(self._arbiter.e)

    def refuse(self) -> None:
        """Ignore the contact in this step."""
        self._arbiter.processCollision = False

    def accept(self, *, first: bool) -> None:
        """Accept the contact, as a first one if the two did not touch in the step before."""
        self._arbiter.processCollision = True
        if first:
            self._arbiter.state = 0  # pymunk counts contacts that were refused as old ones

    def replace(self, normal: complex, one: complex, other: complex) -> None:
        """Replace pymunk's normal, from first to second, and the contact points on both [m]."""
        arbiter, contact = self._arbiter, self._arbiter.contacts[0]
        (a, _), (b, _) = self.poses()
        arbiter.n = normal.real, normal.imag
        contact.r1 = (one - a).real, (one - a).imag
        contact.r2 = (other - b).real, (other - b).imag


def _motion(body: object) -> tuple[complex, float]:
    velocity = lib.cpBodyGetVelocity(body)
    return complex(velocity.x, velocity.y), lib.cpBodyGetAngularVelocity(body)


def _pose(body: object) -> tuple[complex, complex]:
    position, rotation = lib.cpBodyGetPosition(body), lib.cpBodyGetRotation(body)
    return complex(position.x, position.y), complex(rotation.x, rotation.y)
