"""The ends of arcs and curves: rounded, or joined to another static line.

If the end of a static arc or curve meets that of another static line of the same thickness, the two
are neighbours, as the segments of a polyline are: no ball trips over the joint.
"""

from cmath import rect
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import pymunk

from sandbox.model.expressions import Values
from sandbox.model.shapes import Arc as ArcShape
from sandbox.model.shapes import Polyline, Segment
from sandbox.physics.contacts.corner_feelers import FELT, Made, disc_like, half_of, make_feeler
from sandbox.physics.geometry.arcs import Arc, Piece
from sandbox.physics.geometry.distance import dot
from sandbox.physics.geometry.plane_curve import Course

MET = 1e-6
"""m, the largest distance between the ends of lines that continue each other."""

TANGENT = 1e-6
"""One less the cosine of the largest angle between lines that join without a corner."""


class _End(NamedTuple):
    """An end of a line, an arc or a curve."""

    place: complex  # in the plane
    onwards: complex  # the unit vector in which it would continue
    half: float  # half its thickness
    made: Made
    first: bool  # whether it is the first end


def make_ends(
    made: Mapping[str, Made], lines: Mapping[str, Arc | Course], values: Values, skin: float
) -> Iterator[tuple[pymunk.Shape, Piece]]:
    """Yield the round ends of arcs and curves, with feelers, unless another line joins there."""
    straight = [end for body in made.values() for end in _line_ends(body, values, skin)]
    rounds = [
        (end, line)
        for name, line in lines.items()
        for end in _round_ends(made[name], line, values, skin)
    ]
    ends = [*straight, *(end for end, _ in rounds)]
    for own in {end.made.row: end.made for end in straight}.values():
        _join(own, [end for end in straight if end.made is own], ends[len(straight) :])
    for end, line in rounds:
        onwards = next((-other.onwards for other in ends if _meets(end, other)), 0j)
        if dot(onwards, end.onwards) > 1 - TANGENT:
            continue
        turned = complex(*end.made.body.rotation_vector)
        center = (end.place - complex(*end.made.body.position)) / turned
        cap = disc_like(end.made.shapes[0], center, end.half)
        arc = line if isinstance(line, Arc) else None
        ways = end.onwards / turned, onwards / turned
        yield cap, Piece(end.made.row, (center,), end.half, arc, *ways)
        if arc:
            feeler = make_feeler(cap, center, end.half + FELT * arc.radius)
            core = tuple(end.made.points[i] for i in (0, len(end.made.points) // 2, -1))
            yield feeler, Piece(end.made.row, core, end.half, arc, *ways, corner=center)


def _meets(end: _End, other: _End) -> bool:
    """Return whether two static lines join at these ends."""
    still = end.made.spec.type == other.made.spec.type == "static"
    near = abs(end.place - other.place) <= MET and abs(end.half - other.half) <= MET
    return still and near and other is not end


def _round_ends(body: Made, line: Arc | Course, values: Values, skin: float) -> Iterator[_End]:
    """Yield the ends of an arc or curve; a closed one has none."""
    shape = body.spec.shape
    place, turned = complex(*body.body.position), complex(*body.body.rotation_vector)
    if isinstance(line, Course):
        for foot in line.ends:
            at, tangent, first = place + turned * foot.point, turned * foot.tangent, foot.at == 0
            onwards = -tangent if first else tangent
            yield _End(at, onwards, half_of(body, values, skin), body, first)
    elif isinstance(shape, ArcShape) and line.cosine >= -1:
        for angle, sign in ((shape.start(values), -1j), (shape.end(values), 1j)):
            out = rect(1, angle) * turned
            at = place + turned * line.center + line.radius * out
            half = (line.outer - line.inner) / 2
            yield _End(at, sign * out, half, body, angle == shape.start(values))


def _line_ends(body: Made, values: Values, skin: float) -> Iterator[_End]:
    shape = body.spec.shape
    if not isinstance(shape, Segment | Polyline) or body.spec.type != "static":
        return
    place, turned = complex(*body.body.position), complex(*body.body.rotation_vector)
    half = half_of(body, values, skin)
    for index, neighbour in ((0, 1), (-1, -2)):
        at, before = (place + turned * body.points[i] for i in (index, neighbour))
        yield _End(at, (at - before) / abs(at - before), half, body, index == 0)


def _join(line: Made, ends: Sequence[_End], arcs: Sequence[_End]) -> None:
    """Give the end segments of a line the directions of the arcs and curves that join there."""
    points, turned = line.points, complex(*line.body.rotation_vector)
    corners = [points[0], *points, points[-1]]
    joined = False
    for end in ends:
        for arc in (arc for arc in arcs if _meets(end, arc)):
            joined, beyond = True, -arc.onwards / turned
            corners[0 if end.first else -1] += beyond
    for index, shape in enumerate(line.shapes if joined else ()):
        assert isinstance(shape, pymunk.Segment)
        before, after = corners[index], corners[index + 3]
        shape.set_neighbors((before.real, before.imag), (after.real, after.imag))
