"""Rods and wires that share no moving body: each is solved by itself."""

from collections.abc import Sequence
from typing import Protocol

from sandbox.model.expressions import Array
from sandbox.physics.engine.batch import Batch
from sandbox.physics.joints.exact.bead_on_wire import WireEquation
from sandbox.physics.joints.exact.constraint_interface import Condition
from sandbox.physics.joints.exact.distances import Row
from sandbox.physics.joints.exact.separate_beads import Bead
from sandbox.physics.joints.exact.separate_rods import Rod


class Alone(Protocol):
    """A joint that is solved by itself."""

    def solve(self, length: float, guess: float, drift: float) -> float:
        """Find the impulse that keeps a length [m] through a drift [s], and apply it [N s].

        Raises `ZeroDivisionError` if there is none.
        """


def alone(
    equations: Sequence[Condition], batch: Batch, inverse: Array, origin: complex
) -> list[Alone]:
    """Return a joint for each equation, to be solved by itself; none if some are coupled.

    `inverse` are the inverse masses, (n + 1,), 0 of bodies that do not move, the plane last [1/kg].
    Points of the plane are relative to the origin [m].
    """
    found: list[Alone] = []
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
