"""Tables of the equations of exact joints, and their Jacobian."""

from collections.abc import Callable, Sequence
from copy import copy
from math import isfinite
from typing import cast

import numpy as np
from numpy.typing import NDArray

from sandbox.model.expressions import Array
from sandbox.model.translatable_message import Message
from sandbox.physics.engine.space_arrays import Booleans
from sandbox.physics.joints.exact.angle_equations import AngleEquation
from sandbox.physics.joints.exact.constraint_interface import (
    Condition,
    Coordinates,
    Equation,
    Rows,
    angles,
    translations,
)
from sandbox.physics.joints.exact.distance_equations import Reaches, Row
from sandbox.physics.state.simulation_errors import JointFailure


class Equations:
    """The m equations of all exact joints of a scene of n bodies.

    Sums of lengths, the rows, come first and are evaluated together; the others one by one.
    `inverse_moment` are the inverse moments of inertia, (n + 1,), the plane last; 0 of those that
    do not turn [1/(kg m²)].
    """

    def __init__(
        self, rows: Sequence[Row], others: Sequence[Equation], inverse_moment: Array
    ) -> None:
        equations: tuple[Condition, ...] = (*rows, *others)
        self.rows, self.others = rows, others
        self.names = [equation.joint for equation in equations]
        """The joint of each equation."""
        turns = [isinstance(equation, AngleEquation) for equation in equations]
        self.senses = [e.sense if isinstance(e, AngleEquation) else 1 for e in equations]
        """The sense in which an angle's equation turns its second body if it pushes, else 1."""
        self.pulling, self.turning = (_by_joint(equations, turns, way) for way in (False, True))
        """The equations of each joint that keep no angle, and those that keep one."""
        self.alike = np.arange(len(equations))
        """(m,), the first equation of the same joint; for an equation that keeps an angle, itself.
        A pin has two equations, one along each axis."""
        for held in self.pulling.values():
            self.alike[held] = held[:1]
        self.changing = [(i, e.changing) for i, e in enumerate(equations) if e.changing]
        """The equations that change with time, and their changes."""
        self.pulls_only = np.array([e.pulls_only for e in equations], dtype=bool)
        """(m,), the equations that can only pull."""
        shape = (len(equations), len(inverse_moment))
        self.reaches = Reaches(rows, shape, inverse_moment, turns=bool(others))
        """The segments whose lengths are added."""
        self._numbered = list(enumerate(others, len(rows)))

    @property
    def all(self) -> tuple[Condition, ...]:
        """All equations, in order."""
        return (*self.rows, *self.others)

    @property
    def changes(self) -> Booleans:
        """The equations whose lengths change with time: (m,)."""
        changes = np.zeros(len(self.names), dtype=bool)
        changes[[row for row, _ in self.changing]] = True
        return changes

    def bodies(self, pose: Coordinates) -> list[NDArray[np.intp]]:
        """Return the bodies of each equation; the plane is the last of all, or −1."""
        return [_bodies_of(equation, pose) for equation in self.all]

    def lengths(self, kept: Array, t: float) -> Array:
        """Return the values to keep at a time [s], from those without change: (m,) [m, rad]."""
        if not self.changing:
            return kept
        length = kept.copy()
        for i, changing in self.changing:
            length[i] += self._finite(i, changing.by, t)
        return length

    def rates(self, t: float) -> Array:
        """Return the rates of change of the values to keep at a time [s]: (m,) [m/s, rad/s]."""
        rates = np.zeros(len(self.names))
        for i, changing in self.changing:
            rates[i] = self._finite(i, changing.rate, t)
        return rates

    def _finite(self, row: int, value: Callable[[float], float], t: float) -> float:
        found = value(t)
        if isfinite(found):
            return found
        name = self.names[row]
        message = Message(
            "the constraint of '{name}' has no finite value at t = {t:.3g} s", name=name, t=t
        )
        raise JointFailure(name, message)

    def evaluate(self, pose: Coordinates) -> Rows:
        """Return the values at given positions, and their Jacobian."""
        return self._with_others(self.reaches.evaluate(pose), pose, self._numbered)

    def write_negative(self, pose: Coordinates, total: Array, jacobian: Array) -> None:
        """Write the negative of what `evaluate` returns: (m,) and (m, 3 N)."""
        if not self.others:
            self.reaches.write_negative(pose, total, jacobian)
            return
        rows = self.evaluate(pose)
        np.negative(rows.total, out=total)
        np.negative(rows.jacobian, out=jacobian)

    def evaluate_without_memory(self, pose: Coordinates) -> Rows:
        """Return the same as `evaluate`, but without an effect on the next evaluation."""
        others = [(row, copy(equation)) for row, equation in self._numbered]
        return self._with_others(self.reaches.evaluate(pose), pose, others)

    def _with_others(
        self, rows: Rows, pose: Coordinates, others: Sequence[tuple[int, Equation]]
    ) -> Rows:
        if not others:
            return rows
        in_plane, in_angle = translations(rows.jacobian), angles(rows.jacobian)
        for row, equation in others:
            rows.total[row], shares = equation.evaluate(pose)
            for body, plane, angle in shares:
                in_plane[row, body] += plane
                in_angle[row, body] += angle
        return rows


def _by_joint(
    equations: Sequence[Condition], turns: Sequence[bool], way: bool
) -> dict[str, list[int]]:
    """Return the equations of each joint that keep an angle, or those that do not."""
    found: dict[str, list[int]] = {equation.joint: [] for equation in equations}
    for row, (equation, turn) in enumerate(zip(equations, turns, strict=True)):
        if turn == way:
            found[equation.joint].append(row)
    return found


def _bodies_of(equation: Condition, pose: Coordinates) -> NDArray[np.intp]:
    """Return the bodies of an equation."""
    if isinstance(equation, Row):
        ends = [end.body for reach in equation.reaches for end in reach]
        return np.array([-1 if body is None else body for body in ends], dtype=np.intp)
    _, shares = copy(cast("Equation", equation)).evaluate(pose)
    return np.array([share.body for share in shares], dtype=np.intp)
