"""Surfaces that let bodies pass from one side, and hold them from the other.

What counts is the side on which a body last was clear of the line. If that is the side to which the
line lets bodies pass, the body is held. Otherwise it passes without contact until it is clear
again, whatever its velocity does on the way. So a body that is half way through is never pushed
out, neither forwards nor back. The side is determined at the end of the step before the first
contact, at the point of the body that is closest to the line. A body that overlaps a line at the
start passes.

A fast body that should be held may have its centre behind the line at the next step. pymunk would
push it out on the wrong side, so it passes, too, like a body that tunnels through a wall in one
step. If that may happen, its impacts should be located.
"""

from cmath import nan, rect
from collections.abc import Collection, Mapping
from itertools import pairwise
from math import isfinite
from operator import itemgetter
from typing import NamedTuple

import pymunk

from sandbox.model.body import Body
from sandbox.model.excluded_pairs import excluded_pairs
from sandbox.model.expressions import Values
from sandbox.model.level import Level
from sandbox.model.shapes import Arc as ArcShape
from sandbox.model.shapes import Curve, Polyline, Segment
from sandbox.physics.contacts.shapes.corner_feelers import core_of
from sandbox.physics.contacts.shapes.hollow_shapes import line_of
from sandbox.physics.engine.arbiter_handle import PreSolveContact, address
from sandbox.physics.engine.pymunk_bodies import local_points
from sandbox.physics.geometry.arc_contacts import Arc, Placed, to_plane
from sandbox.physics.geometry.outline_distance import dot, without_feelers
from sandbox.physics.geometry.side_of_line import Curved, Line, Round, Straight, side

Pair = tuple[int, int]
"""The rows of a one-way surface and of a body that may touch it."""


class _Gate(NamedTuple):
    """A one-way surface, along the axes of its body."""

    line: Line
    half: float  # half its thickness [m]
    hand: int  # the side on which it holds bodies: 1 left, −1 right


class _Part(NamedTuple):
    """A convex part of a body, along its axes."""

    core: tuple[complex, ...]
    radius: float


class Gates:
    """The one-way surfaces of a scene; n bodies.

    `bodies` are those in pymunk, with all their shapes; `skin` is the thickness of the contact
    skin [m]. `pairs` are those of such a surface and a body that may touch it: their names, in
    order. `reversed` are the surfaces that are reversed compared with the start.
    """

    def __init__(
        self, level: Level, values: Values, bodies: Mapping[str, pymunk.Body], skin: float
    ) -> None:
        self.reversed: frozenset[str] = frozenset()
        self._bodies = list(bodies.values())
        names, never = list(bodies), excluded_pairs(level)
        self._gates = {
            row: _gate(level.bodies[name], row, values, skin)
            for row, name in enumerate(names)
            if level.bodies[name].one_way
        }
        solid = [name for name in names if not level.bodies[name].sensor]
        moving = {name for name in solid if level.bodies[name].type == "dynamic"}
        every = {(min(names[g], b), max(names[g], b)) for g in self._gates for b in solid}
        self.pairs = frozenset(
            (a, b) for a, b in every - never if a != b and (a in moving or b in moving)
        )
        self._names = names
        self._rows = {address(s): row for row, b in enumerate(self._bodies) for s in b.shapes}
        self._row_of = {body: row for row, body in enumerate(self._bodies)}
        self._parts = [_parts(level.bodies[n], bodies[n], values, skin) for n in names]
        self._held: dict[Pair, tuple[bool, int]] = {}  # whether held; step of last touch
        self._before: list[Placed] | None = None
        self._steps = 0

    def note(self) -> None:
        """Note the positions of the bodies at the end of a step."""
        self._before = [_placed(body) for body in self._bodies]
        self._steps += 1

    def forget(self) -> None:
        """Forget which bodies are held, after bodies were moved by hand."""
        self._held.clear()
        self._before = None

    def reverse(self, names: Collection[str]) -> None:
        """Reverse some surfaces; bodies that overlap one then pass."""
        self.reversed ^= frozenset(names)
        for row in [row for row in self._gates if self._names[row] in names]:
            self._gates[row] = self._gates[row]._replace(hand=-self._gates[row].hand)
            for pair in [pair for pair in self._held if pair[0] == row]:
                self._held[pair] = False, self._held[pair][1]

    def admit(self, arbiter: pymunk.Arbiter, *, accept: bool) -> bool:
        """Return whether a contact that pymunk has found is valid, and remove it if not.

        `accept` tells whether to accept a valid contact in pymunk, unless that was done elsewhere.
        """
        meeting = PreSolveContact(arbiter)
        one, other = (self._rows[shape] for shape in meeting.shapes)
        for pair, sign in (((one, other), 1), ((other, one), -1)):
            if (gate := self._gates.get(pair[0])) is None:
                continue
            is_held = self._touching(pair)
            if not (is_held and self._is_right(gate, pair[0], meeting, sign)):
                meeting.refuse()
                return False
        if accept:
            meeting.accept(first=False)
        return True

    def lets_pass(self, one: pymunk.Body, other: pymunk.Body) -> bool:
        """Return whether one of two bodies lets the other pass, by positions at the last step."""
        a, b = self._row_of[one], self._row_of[other]
        return any(not self._was_held(pair) for pair in ((a, b), (b, a)) if pair[0] in self._gates)

    def lets_pass_at(self, one: int, other: int, at: Placed, there: Placed) -> bool:
        """Return whether one of two bodies, by row, lets the other pass from given positions."""
        for pair, placements in (((one, other), (at, there)), ((other, one), (there, at))):
            if pair[0] in self._gates:
                seen = self._side(pair, *placements)
                if not (seen == self._gates[pair[0]].hand if seen else self._was_held(pair)):
                    return True
        return False

    def _touching(self, pair: Pair) -> bool:
        """Return whether a pair that touches in this step is held, and remember it."""
        is_held = self._was_held(pair)
        self._held[pair] = is_held, self._steps
        return is_held

    def _was_held(self, pair: Pair) -> bool:
        """Return whether a pair is held; if it touched in the step before, as it was then."""
        was_held, touched = self._held.get(pair, (False, -2))
        if touched >= self._steps - 1:
            return was_held
        before = self._before or [_placed(body) for body in self._bodies]
        return self._side(pair, before[pair[0]], before[pair[1]]) == self._gates[pair[0]].hand

    def _side(self, pair: Pair, at: Placed, there: Placed) -> int:
        """Return the side of a gate on which a body is; 0 if it overlaps it or is past its end."""
        gate = self._gates[pair[0]]
        offset, turn = (there[0] - at[0]) / at[1], there[1] / at[1]
        seen = [
            side(
                gate.line, [to_plane((offset, turn), corner) for corner in core], gate.half + radius
            )
            for core, radius in self._parts[pair[1]]
        ]
        return min(seen, key=itemgetter(1))[0] if all(hand for hand, _ in seen) else 0

    def _is_right(self, gate: _Gate, row: int, meeting: PreSolveContact, sign: int) -> bool:
        """Return whether a contact pushes the body to the side on which it is held."""
        at, rotation = _placed(self._bodies[row])
        left = gate.line.nearest((meeting.point - at) / rotation).left * rotation
        return gate.hand * sign * dot(meeting.normal, left) > 0


def _placed(body: pymunk.Body) -> Placed:
    rotation = rect(1, body.angle) if isfinite(body.angle) else complex(nan, nan)
    return complex(*body.position), rotation  # non-finite positions are reported after the step


def _gate(spec: Body, row: int, values: Values, skin: float) -> _Gate:
    shape = spec.shape
    hand = 1 if spec.one_way == "left" else -1
    line: Line
    if isinstance(shape, ArcShape | Curve):
        found = line_of(row, spec, values, skin)
        line = Round(found) if isinstance(found, Arc) else Curved(found)
    else:
        assert isinstance(shape, Segment | Polyline)
        line = Straight([complex(*point) for point in local_points(spec, values)])
    return _Gate(line, shape.thickness(values) / 2 + skin, hand)


def _parts(spec: Body, body: pymunk.Body, values: Values, skin: float) -> list[_Part]:
    """Return the convex parts of a body; curved lines become many short segments."""
    if isinstance(spec.shape, ArcShape | Curve):
        points = [complex(*point) for point in local_points(spec, values)]
        half = spec.shape.thickness(values) / 2 + skin
        return [_Part(piece, half) for piece in pairwise(points)]
    return [_Part(tuple(core_of(shape)), shape.radius) for shape in without_feelers(body.shapes)]
