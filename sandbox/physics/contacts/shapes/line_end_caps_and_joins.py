"""The ends of arcs and curves: rounded, or joined to another static line.

If the end of a static arc or curve meets that of another static line of the same thickness, the two
are neighbours, as the segments of a polyline are: no ball trips over the joint.
"""

from cmath import rect
from collections.abc import Iterator, Mapping, Sequence
from itertools import chain, groupby
from math import floor
from operator import itemgetter
from typing import NamedTuple

import pymunk

from sandbox.model.expressions import Values
from sandbox.model.shapes import Arc as ArcShape
from sandbox.model.shapes import Polyline, Segment
from sandbox.physics.contacts.shapes.corner_feelers import (
    FELT,
    ShapedBody,
    disc_like,
    half_of,
    make_feeler,
)
from sandbox.physics.geometry.arc_contacts import Arc, Piece
from sandbox.physics.geometry.outline_distance import dot
from sandbox.physics.geometry.plane_curve import MiddleLine

MET = 1e-6
"""m, the largest distance between the ends of lines that continue each other."""

TANGENT = 1e-6
"""1 - cos of the largest angle between lines that join without a corner."""


class _End(NamedTuple):
    """An end of a line, an arc or a curve."""

    position: complex  # in the plane
    outward: complex  # the unit vector in which it would continue
    half: float  # half its thickness
    made: ShapedBody
    first: bool  # whether it is the first end


def make_ends(
    made: Mapping[str, ShapedBody],
    lines: Mapping[str, Arc | MiddleLine],
    values: Values,
    skin: float,
) -> Iterator[tuple[pymunk.Shape, Piece]]:
    """Yield the round ends of arcs and curves, with feelers, unless another line joins there."""
    straight = [end for body in made.values() for end in _line_ends(body, values, skin)]
    rounds = [
        (end, line)
        for name, line in lines.items()
        for end in _round_ends(made[name], line, values, skin)
    ]
    curved = [end for end, _ in rounds]
    every, curves = _EndGrid([*straight, *curved]), _EndGrid(curved)
    for _, own in groupby(straight, key=lambda end: end.made.row):
        _join(list(own), curves)
    for end, line in rounds:
        continuation = next((-other.outward for other in every.meeting(end)), 0j)
        if dot(continuation, end.outward) > 1 - TANGENT:
            continue
        rotation = complex(*end.made.body.rotation_vector)
        center = (end.position - complex(*end.made.body.position)) / rotation
        cap = disc_like(end.made.shapes[0], center, end.half)
        arc = line if isinstance(line, Arc) else None
        directions = end.outward / rotation, continuation / rotation
        yield cap, Piece(end.made.row, (center,), end.half, arc, *directions)
        if arc:
            feeler = make_feeler(cap, center, end.half + FELT * arc.radius)
            core = tuple(end.made.points[i] for i in (0, len(end.made.points) // 2, -1))
            yield feeler, Piece(end.made.row, core, end.half, arc, *directions, corner=center)


class _EndGrid:
    """A hash grid of the ends of lines, so that of thousands not all pairs are compared."""

    def __init__(self, ends: Sequence[_End]) -> None:
        self._cells: dict[tuple[int, int], list[tuple[int, _End]]] = {}
        for number, end in enumerate(ends):
            self._cells.setdefault(_cell(end.position), []).append((number, end))

    def meeting(self, end: _End) -> Iterator[_End]:
        """Yield the ends at which a line joins that of `end`, in their order."""
        x, y = _cell(end.position)
        around = ((x + i, y + k) for i in (-1, 0, 1) for k in (-1, 0, 1))
        near = chain.from_iterable(self._cells.get(cell, ()) for cell in around)
        return (other for _, other in sorted(near, key=itemgetter(0)) if _meets(end, other))


def _cell(position: complex) -> tuple[int, int]:
    return floor(position.real / MET), floor(position.imag / MET)


def _meets(end: _End, other: _End) -> bool:
    """Return whether two static lines join at these ends."""
    still = end.made.spec.type == other.made.spec.type == "static"
    near = abs(end.position - other.position) <= MET and abs(end.half - other.half) <= MET
    return still and near and other is not end


def _round_ends(
    body: ShapedBody, line: Arc | MiddleLine, values: Values, skin: float
) -> Iterator[_End]:
    """Yield the ends of an arc or curve; a closed one has none."""
    shape = body.spec.shape
    position, rotation = complex(*body.body.position), complex(*body.body.rotation_vector)
    if isinstance(line, MiddleLine):
        for foot in line.ends:
            at = position + rotation * foot.point
            tangent = rotation * foot.tangent
            first = foot.parameter == 0
            onwards = -tangent if first else tangent
            yield _End(at, onwards, half_of(body, values, skin), body, first)
    elif isinstance(shape, ArcShape) and line.cosine >= -1:
        for angle, sign in ((shape.start(values), -1j), (shape.end(values), 1j)):
            out = rect(1, angle) * rotation
            at = position + rotation * line.center + line.radius * out
            half = (line.outer - line.inner) / 2
            yield _End(at, sign * out, half, body, angle == shape.start(values))


def _line_ends(body: ShapedBody, values: Values, skin: float) -> Iterator[_End]:
    shape = body.spec.shape
    if not isinstance(shape, Segment | Polyline) or body.spec.type != "static":
        return
    position, rotation = complex(*body.body.position), complex(*body.body.rotation_vector)
    half = half_of(body, values, skin)
    for index, neighbour in ((0, 1), (-1, -2)):
        at, before = (position + rotation * body.points[i] for i in (index, neighbour))
        yield _End(at, (at - before) / abs(at - before), half, body, index == 0)


def _join(ends: Sequence[_End], arcs: _EndGrid) -> None:
    """Give the end segments of a line the directions of the arcs and curves that join there."""
    line = ends[0].made
    points, rotation = line.points, complex(*line.body.rotation_vector)
    corners = [points[0], *points, points[-1]]
    joined = False
    for end in ends:
        for arc in arcs.meeting(end):
            joined, beyond = True, -arc.outward / rotation
            corners[0 if end.first else -1] += beyond
    for index, shape in enumerate(line.shapes if joined else ()):
        assert isinstance(shape, pymunk.Segment)
        before, after = corners[index], corners[index + 3]
        shape.set_neighbors((before.real, before.imag), (after.real, after.imag))
