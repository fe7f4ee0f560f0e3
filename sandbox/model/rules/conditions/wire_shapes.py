"""Wires and curves are smooth and do not cross themselves, and beads start on wires."""

from collections.abc import Iterator
from functools import partial

import numpy as np
from numpy.typing import NDArray

from sandbox.model.expressions import Array, Values
from sandbox.model.joint_ends_at_start import end_position
from sandbox.model.joints import Wire, bodies_of
from sandbox.model.level import Level
from sandbox.model.level_parts import names_in
from sandbox.model.number_bounds import Coordinate
from sandbox.model.rules.conditions.condition import Condition
from sandbox.model.shapes import Curve
from sandbox.model.translatable_message import Message, word
from sandbox.model.wire_points import NEAR, PIECES, Points, along, is_closed, points_at

COARSE = 256
"""The number of pieces of a wire or curve that are tested for crossings."""

SHARPEST = 0.1
"""The largest angle between successive pieces of a smooth curve [rad]."""

ROUGH = 1e-8
"""The largest deviation of a curve from its interpolation, as a share of its size."""

TIGHT = 1e-3
"""The least radius of curvature of a curve, as a share of its size."""

WORK = 3500
"""The work of checking a wire or curve, about [µs]."""

PARALLEL = 1e-9
"""The angle below which pieces count as parallel [rad]."""

ZOOMS = 6

_MIDDLE = np.array([3.0, -25.0, 150.0, 150.0, -25.0, 3.0]) / 256
"""The weights of the quintic through six points, half-way between the third and the fourth,"""

_FIRST = np.array([63.0, 315.0, -210.0, 126.0, -45.0, 7.0]) / 256
"""and half-way between the first and the second."""


def conditions(level: Level) -> Iterator[Condition]:
    """Yield the conditions on a level's wires and curves."""
    for name, wire in level.joints.items():
        if isinstance(wire, Wire):
            beads = [level.bodies[body] for body in bodies_of(wire)]
            names = names_in((wire, *((b.position, b.angle) for b in beads))) - {"s"}
            yield Condition(
                ("joints", name, "curve"), names, partial(_wire_fault, wire, level), WORK
            )
    for name, body in level.bodies.items():
        if isinstance(body.shape, Curve):
            path, names = ("bodies", name, "shape", "curve"), names_in(body.shape) - {"s"}
            yield Condition(path, names, partial(_curve_fault, body.shape), WORK)


def _wire_fault(wire: Wire, level: Level, values: Values) -> Message | None:
    points, rule = _looked_at(wire, values)
    if rule:
        return rule
    away = _distance(wire, end_position(wire.bead, level.bodies, values), values)
    if away > NEAR * max(1.0, float(np.abs(points).max())):
        return Message(
            "the bead must start on the wire, but it is {away:g} m away from it", away=away
        )
    return None


def _curve_fault(curve: Curve, values: Values) -> Message | None:
    """Say why a curve cannot be touched: it must be smooth everywhere, and not too sharply bent."""
    points, rule = _looked_at(curve, values)
    if rule:
        return rule
    size = float(np.abs(points - points[0]).max())
    off = _roughness(curve, values, points)
    if not off.max() <= ROUGH * size:
        at = _shown(points[off.argmax()])
        return Message(
            "the curve is not smooth near {at}: its derivatives are not finite, or jump there",
            at=at,
        )
    ahead, back = points[2:] - points[1:-1], points[:-2] - points[1:-1]
    bends = 2 * np.abs(_cross(ahead, back)) / np.abs(ahead * back * (ahead - back))
    most = float(bends.max())
    least, at = 1 / max(most, NEAR / size), _shown(points[1:-1][bends.argmax()])
    half = curve.thickness(values) / 2
    if least < max(TIGHT * size, half):
        bound = Message("half its thickness, {half:.3g} m", half=half)
        if least < TIGHT * size:
            bound = Message("{tight:g} of its size; end it before, or round it", tight=TIGHT)
        return Message(
            "the radius of curvature at {at} is {least:.3g} m, less than {bound}",
            at=at,
            least=least,
            bound=bound,
        )
    return None


def _roughness(curve: Curve, values: Values, points: Points) -> Array:
    """Return the distances of the pieces' midpoints from quintics through six points [m]."""
    first, last = (end(values) for end in curve.s)
    between = points_at(curve, values, np.linspace(first, last, 2 * PIECES + 1)[1::2])
    quintic = between.copy()
    near = [points[i : len(points) - 5 + i] for i in range(6)]
    quintic[2:-2] = np.tensordot(_MIDDLE, near, axes=1)
    quintic[[0, -1]] = _FIRST @ points[:6], _FIRST @ points[:-7:-1]
    return np.abs(quintic - between)


def _looked_at(wire: Wire | Curve, values: Values) -> tuple[Points, Message | None]:
    """Return the points of a wire or curve, and what is wrong with them; None if nothing is."""
    first, last = (end(values) for end in wire.s)
    points, what = along(wire, values), word(wire.type)
    if not first < last:
        rule = Message(
            "'s' must increase, but it goes from {first:g} to {last:g}", first=first, last=last
        )
        return points, rule
    if not np.isfinite(points).all():
        lost = np.linspace(first, last, PIECES + 1)[~np.isfinite(points)][0]
        return points, Message("the {what} has no finite point at s = {s:g}", what=what, s=lost)
    away = float(np.abs(points).max())
    if beyond := Coordinate.range_fault(away):
        rule = Message(
            "the {what} is {away:g} m away from the origin, {beyond}",
            what=what,
            away=away,
            beyond=beyond,
        )
        return points, rule
    return points, _shape_fault(points, what)


def _shape_fault(points: Points, what: Message) -> Message | None:
    pieces = np.diff(points)
    if not np.abs(pieces).min() > 0:
        return Message(
            "the {what} does not advance with s at {place}",
            what=what,
            place=_shown(points[np.abs(pieces).argmin()]),
        )
    corners = points[1:-1]
    if is_closed(points):
        pieces, corners = np.append(pieces, pieces[0]), points[1:]
    turns = np.abs(np.angle(pieces[1:] / pieces[:-1]))
    if turns.max() > SHARPEST:
        rule = Message(
            "the {what} must not have sharp corners, but has one at {place}",
            what=what,
            place=_shown(corners[turns.argmax()]),
        )
        if what == "wire":
            return rule
        return Message(
            "{rule}; or, if it is smooth there, it is too long for {pieces} pieces: divide it"
            " into several",
            rule=rule,
            pieces=PIECES,
        )
    if (crossing := _crossing(points[:: PIECES // COARSE])) is not None:
        return Message(
            "the {what} must not cross itself, but it does near {place}",
            what=what,
            place=_shown(crossing),
        )
    return None


def _crossing(points: Points) -> complex | None:
    """Return the point where a polyline crosses or touches itself; None if it does not."""
    i, k = np.nonzero(np.triu(_near(points.real) & _near(points.imag), 2))
    a, b, along = points[i], points[k], np.diff(points)
    along_a, along_b = along[i], along[k]
    across = _cross(along_a, along_b)
    across[np.abs(across) < PARALLEL * np.abs(along_a * along_b)] = np.nan
    of_a, of_b = _cross(b - a, along_b) / across, _cross(b - a, along_a) / across
    meet = (of_a >= 0) & (of_a < 1) & (of_b >= 0) & (of_b < 1)
    if is_closed(points):
        meet &= (i > 0) | (k < len(points) - 2)
    return complex(points[i[meet][0]]) if meet.any() else None


def _near(ends: Array) -> NDArray[np.bool_]:
    """Return which pieces overlap along an axis: (n, n)."""
    low, high = np.minimum(ends[:-1], ends[1:]), np.maximum(ends[:-1], ends[1:])
    over: NDArray[np.bool_] = low[:, None] <= high
    return over & over.T


def _cross(a: Points, b: Points) -> Array:
    return a.real * b.imag - a.imag * b.real  # with real numbers, in half the time


def _distance(wire: Wire, point: complex, values: Values) -> float:
    """Return the distance of a point from a wire [m], by successive refinement."""
    first, last = (end(values) for end in wire.s)
    low, high = first, last
    for zoom in range(ZOOMS):
        s = np.linspace(low, high, (64 if zoom else PIECES) + 1)
        away = np.abs(points_at(wire, values, s) - point)
        nearest = int(away.argmin())
        low, high = s[max(nearest - 1, 0)], s[min(nearest + 1, len(s) - 1)]
    return float(away.min())


def _shown(point: complex) -> str:
    return f"[{point.real:.3g}, {point.imag:.3g}]"
