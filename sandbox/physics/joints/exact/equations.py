"""The equations of exact joints in tables, and their Jacobian."""

from collections.abc import Sequence
from copy import copy
from math import isfinite
from typing import cast

import numpy as np
from numpy.typing import NDArray

from sandbox.model.expressions import Array
from sandbox.model.message import Message
from sandbox.physics.engine.batch import Booleans
from sandbox.physics.joints.exact.angles import Turn
from sandbox.physics.joints.exact.constraints import (
    Condition,
    Coordinates,
    Equation,
    Rows,
    angles,
    planes,
)
from sandbox.physics.joints.exact.distances import Reaches, Row
from sandbox.physics.state.errors import JointFailure


class Equations:
    """The m equations of all exact joints of a scene of n bodies.

    Sums of lengths, the rows, come first and are looked at together; the others one by one.

    Parameters
    ----------
    rows, others
        The equations.
    inverse_moment
        (n + 1,), 0 of what does not turn, the plane last [1/(kg m²)].

    Attributes
    ----------
    names
        The joint that each is of.
    pulling, turning
        Of each joint those that keep no angle, and those that do.
    senses
        Which way each that keeps an angle turns its second body if it pushes.
    alike
        (m,), the first of the equations of its joint, or of those of them that keep an angle: each
        its own. What a pin keeps it keeps along two axes.
    changing
        Those that change with time, and how.
    pulls_only
        (m,), which can only pull.
    reaches
        The pieces whose lengths add up.
    """

    def __init__(
        self, rows: Sequence[Row], others: Sequence[Equation], inverse_moment: Array
    ) -> None:
        equations: tuple[Condition, ...] = (*rows, *others)
        self.rows, self.others = rows, others
        self.names = [equation.joint for equation in equations]
        turns = [isinstance(equation, Turn) for equation in equations]
        self.senses = [e.sense if isinstance(e, Turn) else 1 for e in equations]
        self.pulling, self.turning = (_by_joint(equations, turns, way) for way in (False, True))
        self.alike = np.arange(len(equations))
        for held in self.pulling.values():
            self.alike[held] = held[:1]
        self.changing = [(i, e.changing) for i, e in enumerate(equations) if e.changing]
        self.pulls_only = np.array([e.pulls_only for e in equations], dtype=bool)
        shape = (len(equations), len(inverse_moment))
        self.reaches = Reaches(rows, shape, inverse_moment, turns=bool(others))
        self._numbered = list(enumerate(others, len(rows)))

    @property
    def all(self) -> tuple[Condition, ...]:
        """All of them, in order."""
        return (*self.rows, *self.others)

    @property
    def changes(self) -> Booleans:
        """Which are of a length that changes with time: (m,)."""
        changes = np.zeros(len(self.names), dtype=bool)
        changes[[row for row, _ in self.changing]] = True
        return changes

    def bodies(self, place: Coordinates) -> list[NDArray[np.intp]]:
        """Return those that each equation is about; the plane is the last of all, or −1."""
        return [_bodies_of(equation, place) for equation in self.all]

    def lengths(self, kept: Array, t: float) -> Array:
        """Return what each keeps at a time [s], given what it keeps without it: (m,) [m, rad]."""
        if not self.changing:
            return kept
        length = kept.copy()
        for i, changing in self.changing:
            length[i] += changing(t)
            if not isfinite(length[i]):
                name = self.names[i]
                raise JointFailure(
                    name,
                    Message(
                        "what '{name}' keeps has no finite value at t = {t:.3g} s", name=name, t=t
                    ),
                )
        return length

    def look(self, place: Coordinates) -> Rows:
        """Return what they add up to somewhere, and their Jacobian there."""
        return self._with_others(self.reaches.look(place), place, self._numbered)

    def glance(self, place: Coordinates) -> Rows:
        """Return the same, and leave no trace: the next look is as if this had not been."""
        others = [(row, copy(equation)) for row, equation in self._numbered]
        return self._with_others(self.reaches.look(place), place, others)

    def _with_others(
        self, rows: Rows, place: Coordinates, others: Sequence[tuple[int, Equation]]
    ) -> Rows:
        if not others:
            return rows
        in_plane, in_angle = planes(rows.jacobian), angles(rows.jacobian)
        for row, equation in others:
            rows.total[row], shares = equation.look(place)
            for body, plane, angle in shares:
                in_plane[row, body] += plane
                in_angle[row, body] += angle
        return rows


def _by_joint(
    equations: Sequence[Condition], turns: Sequence[bool], way: bool
) -> dict[str, list[int]]:
    """Return for each joint which of its equations turn, or which do not."""
    found: dict[str, list[int]] = {equation.joint: [] for equation in equations}
    for row, (equation, turn) in enumerate(zip(equations, turns, strict=True)):
        if turn == way:
            found[equation.joint].append(row)
    return found


def _bodies_of(equation: Condition, place: Coordinates) -> NDArray[np.intp]:
    """Return which bodies an equation is about."""
    if isinstance(equation, Row):
        ends = [end.body for reach in equation.reaches for end in reach]
        return np.array([-1 if body is None else body for body in ends], dtype=np.intp)
    _, shares = copy(cast("Equation", equation)).look(place)
    return np.array([share.body for share in shares], dtype=np.intp)
