"""Where arcs and hoops touch other shapes, exactly and from both sides.

To pymunk a circle is filled. An arc is a line of some thickness along a part of a circle, so what
touches it does so in one of three ways: from inside, with a corner or, if it is round, along the
line from the arc's centre through its own; from outside, as it would touch a disc; or at one of the
two ends, which are round. pymunk is right about the last two, once it is known which of them it is.
Points of the plane are complex numbers here.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import sqrt
from typing import NamedTuple

from sandbox.physics.geometry.distance import dot
from sandbox.physics.geometry.plane_curve import Side

Placed = tuple[complex, complex]
"""Where a body is, and how it is turned: x + iy [m], cos + i sin."""

KEPT = 5e-7
"""m, by how much what follows an arc overlaps it, so that it is found again: less than is taken
back. An overlap of less grows to that by and by:"""
SOON = 0.125
"""by such a share of what lacks in a step."""

Motion = tuple[complex, float]
"""How fast a body moves, and turns [m/s, rad/s]."""

THIN = 1e-4
"""The share of an arc's radius by which the middle of what touches it from outside may be within
it: what is as thin as a line is, by the overlap that is left alone."""


@dataclass(frozen=True, slots=True)
class Arc:
    """A line of some thickness along a part of a circle, or along all of it, as a hoop is.

    Attributes
    ----------
    body
        The body's index.
    center
        Of the circle, in the axes of the body [m].
    radius
        Of the circle, in the middle of the line [m].
    inner, outer
        How far its two sides are from the centre [m].
    middle
        The direction from the centre to the middle of the arc, in the axes of the body.
    cosine
        Of half the angle that it spans; below −1 if it goes all the way round.
    """

    body: int
    center: complex
    radius: float
    inner: float
    outer: float
    middle: complex
    cosine: float

    def spans(self, way: complex, turned: complex) -> bool:
        """Whether a way from the centre of the arc of a turned body leads to the arc."""
        return dot(way, self.middle * turned) >= self.cosine * abs(way)


@dataclass(frozen=True, slots=True)
class Piece:
    """One of pymunk's shapes, as arcs see it.

    Attributes
    ----------
    body
        The body's index.
    core
        What is thickened by the radius, in the axes of the body: one point of what is round [m].
    radius
        [m].
    arc
        Whose side it is, or whose end; None of other shapes.
    away
        Of an end: the direction in which the arc ends there; 0 of others.
    goes_on
        Of an end: the direction in which another line goes on from there; 0 if none does.
    corner
        Of a feeler, which only touches arcs from inside: the corner, or end, that does [m]; None of
        other shapes. The core is that of the whole.
    curve
        The stretch of a curve that it is; None of other shapes.
    """

    body: int
    core: tuple[complex, ...]
    radius: float
    arc: Arc | None = None
    away: complex = 0j
    goes_on: complex = 0j
    corner: complex | None = None
    curve: Side | None = None


class Touch(NamedTuple):
    """A corner, or something round, that is near the inner side of an arc, or either of a curve.

    Attributes
    ----------
    arc
        Whose side it is; of a curve, the circle that is closest to it there.
    body
        The index of the body that touches it.
    point
        The middle of what is round, or the corner, in the axes of that body [m].
    radius
        The radius by which that is thickened [m].
    depth
        By how much the two overlap; negative if they are apart [m].
    normal
        The unit vector from the arc to the other, so towards its centre.
    on_arc, on_other
        The points of contact on the surface of each, in the plane [m].
    sign
        1 from inside, −1 from outside; 0 where nothing is followed.
    """

    arc: Arc
    body: int
    point: complex
    radius: float
    depth: float
    normal: complex
    on_arc: complex
    on_other: complex
    sign: int = 1


class Way(NamedTuple):
    """How what touches an arc comes to it, and must leave it to follow it.

    Attributes
    ----------
    comes
        How fast it approaches [m/s].
    leaves
        How fast it must part, so that it overlaps no more after the next drift; negative where it
        may still come closer [m/s].
    along
        How fast it moves along the arc [m/s].
    """

    comes: float
    leaves: float
    along: float


Verdict = Touch | bool
"""How two shapes touch: as told; as pymunk has it; or not at all."""


def verdict(one: Piece, other: Piece, at: Placed, there: Placed) -> Verdict:
    """Return how two shapes touch that overlap according to pymunk.

    Parameters
    ----------
    one, other
        The shapes.
    at, there
        Where their bodies are.
    """
    if _is_side(one) and _is_side(other):
        return _sides(one, other, at, there)
    if _is_side(one):
        return _at_side(one, other, at, there)
    if _is_side(other):
        return _at_side(other, one, there, at)
    return _at_end(one, other, at, there) and _at_end(other, one, there, at)


def way_along(
    found: Touch,
    places: tuple[Placed, Placed],
    motions: tuple[Motion, Motion],
    drift: float,
    before: float | None,
) -> Way:
    """Return how something comes to an arc, and how it leaves it to follow it for a drift.

    A drift is straight, so what follows an arc is further out after it than before, by (v dt)² / 2r
    if it moves along it. It is not if it parts with v² dt / 2r, or comes with as much from outside:
    then the velocities before and after the kick are those along two chords, and their mean lies
    along the arc. How the kick will change the speed along the arc is taken from the last one.

    Parameters
    ----------
    found
        Who touches where.
    places, motions
        Of the bodies: of the arc's, and of the other.
    drift
        How long the next one lasts [s].
    before
        The speed along the arc a step ago [m/s]; None if it did not follow the arc then.
    """
    (at, there), (rates, moves) = places, motions
    way = put(there, found.point) - put(at, found.arc.center)
    center, point = at[1] * found.arc.center, there[1] * found.point
    velocity = (moves[0] + 1j * moves[1] * point) - (rates[0] + 1j * rates[1] * center)
    bends = (rates[1] ** 2 * center - moves[1] ** 2 * point) * (drift / 2)
    out, far = way / abs(way), abs(way)
    along = dot(velocity + bends, 1j * out)
    moved = min(abs(along if before is None else 2 * along - before) * drift, far)
    back = moved * moved / (far + sqrt(far * far - moved * moved))
    nearer = min(max(KEPT - found.depth, 0.0) * SOON, back)
    comes, apart = found.sign * dot(velocity, out), found.sign * (back / drift + dot(bends, out))
    return Way(comes, apart - nearer / drift, along)


def _is_side(piece: Piece) -> bool:
    return piece.arc is not None and not piece.away


def _at_side(side: Piece, other: Piece, at: Placed, there: Placed) -> Verdict:
    """Return how a shape that is no side of an arc touches one."""
    arc = side.arc
    assert arc is not None
    center = put(at, arc.center)
    if other.corner is None and len(other.core) > 1:
        return _is_outside(arc, other, center, at[1], there)
    point = other.core[0] if other.corner is None else other.corner
    way = put(there, point) - center
    if not way or not arc.spans(way, at[1]):
        return False
    if other.corner is None and abs(way) >= arc.radius:
        return not other.away or _ends_at(other, there, center)
    if other.corner is None and other.away:
        return False  # its feeler does
    if other.corner is not None:
        leans = dot(put(there, _mean(other.core)) - center, way) >= arc.radius * abs(way)
        if leans or _is_outside(arc, other, center, at[1], there):
            return False
    found = _inside(arc, center, other.body, point, other.radius, way)
    if found.depth <= 0 or (other.away and not _ends_at(other, there, center + 2 * way)):
        return False
    return found


def _inside(
    arc: Arc, center: complex, body: int, point: complex, radius: float, way: complex
) -> Touch:
    """Return how a thickened point at a distance from an arc's centre meets its inner side."""
    out = way / abs(way)
    on_arc, on_other = center + arc.inner * out, center + way + radius * out
    depth = abs(way) + radius - arc.inner
    return Touch(arc, body, point, radius, depth, -out, on_arc, on_other)


def _is_outside(arc: Arc, other: Piece, center: complex, turned: complex, there: Placed) -> bool:
    """Whether a shape with corners is at the outer side of an arc.

    It is nearest to the arc's centre with a point towards the arc, and lies beyond that.
    """
    core = [put(there, corner) for corner in other.core]
    way = nearest(core, center) - center
    if not way or not arc.spans(way, turned):
        return False
    beyond = dot(_mean(core) - center, way) / abs(way)
    return beyond > arc.radius * (1 - THIN)


def _sides(one: Piece, other: Piece, at: Placed, there: Placed) -> Verdict:
    """Return how two arcs touch with their sides: the one in the other, or each from outside."""
    wide, narrow = one.arc, other.arc
    assert wide is not None
    assert narrow is not None
    if wide.radius < narrow.radius:
        return _sides(other, one, there, at)
    center = put(at, wide.center)
    way = put(there, narrow.center) - center
    if abs(way) >= wide.radius:
        return wide.spans(way, at[1]) and narrow.spans(-way, there[1])
    if not way or not (wide.spans(way, at[1]) and narrow.spans(way, there[1])):
        return False
    found = _inside(wide, center, narrow.body, narrow.center, narrow.outer, way)
    return found if found.depth > 0 else False


def _at_end(end: Piece, other: Piece, at: Placed, there: Placed) -> bool:
    """Whether a shape may touch what may be the end of an arc.

    It may where it is nearest beyond the end: what is beside the arc touches its side. A line
    that goes on from there is touched in its place.
    """
    if not end.away:
        return True
    if len(other.core) > 1:
        core = [put(there, corner) for corner in other.core]
        return _ends_at(end, at, nearest(core, put(at, end.core[0])))
    point = put(there, other.core[0])
    if end.arc is None:
        return _ends_at(end, at, point)
    if end.arc.spans(point - put(at, end.arc.center), at[1]):
        return False
    return not end.goes_on or _ends_at(end, at, point)


def _ends_at(end: Piece, at: Placed, point: complex) -> bool:
    """Whether a point is seen from an arc's end where neither the arc is nor another line."""
    way = point - put(at, end.core[0])
    return dot(way, end.away * at[1]) >= 0 and dot(way, end.goes_on * at[1]) <= 0


def put(there: Placed, point: complex) -> complex:
    """Return where a point of a body is in the plane [m]."""
    return there[0] + there[1] * point


def _mean(core: Sequence[complex]) -> complex:
    return sum(core) / len(core)


def nearest(core: Sequence[complex], place: complex) -> complex:
    """Return the point of a convex core that is nearest to a place; the place, if it is within."""
    best, within = core[0], len(core) > 2
    if len(core) == 1:
        return best
    for i, b in enumerate(core):
        a = core[i - 1]
        along = b - a
        share = dot(place - a, along) / (dot(along, along) or 1.0)  # far away, ends are the same
        near = a + along * min(max(share, 0.0), 1.0)
        if abs(near - place) < abs(best - place):
            best = near
        within &= along.real * (place - a).imag - along.imag * (place - a).real > 0
    return place if within else best
