"""Rods and wires that share no moving body: each is solved by itself, in floats.

A rod takes a tenth of the time of arrays, and a bead a quarter.
"""

from collections.abc import Sequence
from math import hypot
from typing import Protocol

from sandbox.model.expressions import Array
from sandbox.physics.engine.space_arrays import Batch
from sandbox.physics.joints.exact.bead_on_wire import WireEquation
from sandbox.physics.joints.exact.constraint_interface import (
    GROWS,
    MAX_ITERATIONS,
    QUADRATIC,
    Condition,
)
from sandbox.physics.joints.exact.distance_equations import Row


class Rod:
    """Keeps the distance of two bodies, or of a body from a point of the plane.

    The equation is that of `ExactJoints`, for the vector r from one end to the other,

        |r + h (v − λ (1/m_a + 1/m_b) r / |r|)| = L.

    It is one of those in `are_apart`. `inverse` are the inverse masses, (n + 1,), 0 of bodies that
    do not move, the plane last [1/kg]. Points of the plane are relative to the origin [m].
    """

    def __init__(self, row: Row, batch: Batch, inverse: Array, origin: complex) -> None:
        a, b = sorted(row.reaches[0], key=lambda end: end.body is not None)  # the plane first
        self._pair = batch.pair(a.body, b.body)
        self._inverse = [float(inverse[-1 if e.body is None else e.body]) for e in (a, b)]
        free = a.body is not None
        self._origin = (0.0, 0.0) if free else (origin.real, origin.imag)
        self._fixed = a.point.real, a.point.imag

    def solve(self, length: float, guess: float, drift: float) -> float:
        """Find the impulse that keeps a length [m] through a drift [s], and apply it [N s].

        Raises `ZeroDivisionError` if there is none: the ends meet, or Newton's method does not
        converge.
        """
        ax, ay, au, av, bx, by, bu, bv = self._pair.read()
        # differences first: far from the origin, sums of positions round more
        x = bx - ax - self._origin[0] - self._fixed[0]
        y = by - ay - self._origin[1] - self._fixed[1]
        far = hypot(x, y)
        inverse_a, inverse_b = self._inverse
        a_x, a_y = inverse_a * x / far, inverse_a * y / far
        b_x, b_y = inverse_b * x / far, inverse_b * y / far
        u, v, reply_x, reply_y = bu - au, bv - av, a_x + b_x, a_y + b_y
        impulse = guess
        for _ in range(MAX_ITERATIONS):
            to_x = x + drift * (u - impulse * reply_x)
            to_y = y + drift * (v - impulse * reply_y)
            reach = hypot(to_x, to_y)
            impulse += (reach - length) * reach / (drift * (to_x * reply_x + to_y * reply_y))
            if abs(reach - length) <= QUADRATIC:
                self._pair.set_velocity(
                    au + impulse * a_x, av + impulse * a_y, bu - impulse * b_x, bv - impulse * b_y
                )
                return impulse
        raise ZeroDivisionError


class Bead:
    """Keeps a bead on its wire.

    The equation is that of `ExactJoints`, for a bead at z with the normal n of its wire at the
    step,

        d(z + h (v − λ n / m)) = 0,

    where d is the signed distance from the wire. It is one of those in `are_apart`. `inverse` is
    the inverse mass of the bead [1/kg]. Points of the wire are relative to the origin [m].
    """

    def __init__(
        self, equation: WireEquation, batch: Batch, inverse: float, origin: complex
    ) -> None:
        self._wire, self._inverse, self._origin = equation, inverse, origin
        self._pair = batch.pair(equation.body, None)

    def solve(self, length: float, guess: float, drift: float) -> float:
        """Find the impulse that keeps the bead on its wire through a drift [s], and apply it [N s].

        The length is the distance from the wire to keep [m]. Raises `ZeroDivisionError` if there is
        no impulse: Newton's method does not converge, or its solution would add energy;
        `JointFailure` if the wire ends, or bends too sharply for a step.
        """
        x, y, u, v, *plane = self._pair.read()
        position, motion = complex(x, y) - self._origin, complex(u, v)
        reply = self._wire.near(position)[1] * self._inverse
        back = reply.conjugate()
        impulse = guess
        for _ in range(MAX_ITERATIONS):
            distance, normal = self._wire.near(position + drift * (motion - impulse * reply))
            impulse += (distance - length) / (drift * (back * normal).real)
            if abs(distance - length) <= QUADRATIC:
                break
        else:
            raise ZeroDivisionError
        velocity = motion - impulse * reply
        if abs(velocity) ** 2 > GROWS * abs(motion) ** 2 + (QUADRATIC / drift) ** 2:
            raise ZeroDivisionError
        self._pair.set_velocity(velocity.real, velocity.imag, plane[2], plane[3])
        return impulse


class SeparateJoint(Protocol):
    """A joint that is solved by itself."""

    def solve(self, length: float, guess: float, drift: float) -> float:
        """Find the impulse that keeps a length [m] through a drift [s], and apply it [N s].

        Raises `ZeroDivisionError` if there is none.
        """


def alone(
    equations: Sequence[Condition], batch: Batch, inverse: Array, origin: complex
) -> list[SeparateJoint]:
    """Return a joint for each equation, to be solved by itself; none if some are coupled.

    `inverse` are the inverse masses, (n + 1,), 0 of bodies that do not move, the plane last [1/kg].
    Points of the plane are relative to the origin [m].
    """
    found: list[SeparateJoint] = []
    if not are_apart(equations, inverse):
        return found
    for equation in equations:
        if isinstance(equation, WireEquation):
            found.append(Bead(equation, batch, float(inverse[equation.body]), origin))
        elif isinstance(equation, Row):
            found.append(Rod(equation, batch, inverse, origin))
    return found


def are_apart(equations: Sequence[Condition], inverse: Array) -> bool:
    """Return whether all are rods or wires through centres, and none share a moving body.

    `inverse` are the inverse masses, (n + 1,), 0 of bodies that do not move, the plane last [1/kg].
    """
    held: set[int] = set()
    for equation in equations:
        moving = _moving(equation, inverse)
        if moving is None or moving & held:
            return False
        held |= moving
    return True


def _moving(equation: Condition, inverse: Array) -> set[int] | None:
    """Return the moving bodies of a rod or wire; None if it cannot be solved by itself."""
    if isinstance(equation, WireEquation):
        return {equation.body} if inverse[equation.body] and not equation.point else None
    if not isinstance(equation, Row) or len(equation.reaches) != 1:
        return None
    ends = [end for end in equation.reaches[0] if end.body is not None]
    if equation.along or equation.pulls_only or any(end.point for end in ends):
        return None
    return {end.body for end in ends if end.body is not None and inverse[end.body]}
