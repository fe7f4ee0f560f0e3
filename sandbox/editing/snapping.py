"""Snapping points and bodies to probable targets: a grid, an end, a surface.

A body that is moved close to another touches it exactly, with no gap or overlap beyond rounding; if
it is also close to a second, it touches both, as in the corner of a room.
"""

from cmath import phase
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from itertools import islice, product
from math import floor, log10
from typing import Literal, NamedTuple

from sandbox.editing.bodies_at_start import Core, PlacedBody, placed, xy
from sandbox.model.joint_ends_at_start import end_position
from sandbox.model.joints import body_of, ends_of
from sandbox.model.level import Level
from sandbox.model.shapes import XY, Arc, Box, Curve, Polygon, Polyline, Segment
from sandbox.physics.geometry.outline_distance import Gap, gap

FINEST = 8
"""The least distance between grid lines [px]."""

EXACT, CLOSE = 1e-15, 1e-12
"""m, the gap at which Newton's method stops, and the largest gap accepted after all iterations; the
latter is relative to the size of scenes larger than a metre."""

ACROSS = 0.05
"""The smallest sine of the angle between two sides that form a corner for a body."""

ROUNDS = 20
"""The largest number of iterations of Newton's method; most bodies need one."""

STRAIGHT = 1e-9
"""The tolerance within which a normal is vertical or horizontal; also that of overlaps [m]."""

Kind = Literal["grid", "corner", "center", "end", "contact", "line", "side"]

Target = tuple[complex, Kind, str]
"""A point that attracts others, its kind, and its body."""


class Snapped(NamedTuple):
    """The target of a snapped point, or the displacement of a snapped body."""

    point: XY
    """The point, or the total displacement of a body [m]."""
    kind: Kind | None = None
    """The kind of target; None if nothing is near, and there is no grid."""
    bodies: tuple[str, ...] = ()
    """The body of the corner or centre, or the bodies that are touched."""


def grid_step(pixel: float) -> float:
    """Return the distance of grid lines [m], given the size of a pixel [m].

    It is 1, 2 or 5 times a power of ten, and at least 8 pixels.
    """
    least = FINEST * pixel
    power = 10.0 ** floor(log10(least))
    factor = next(f for f in (1, 2, 5, 10) if f * power >= least * (1 - 1e-9))
    return float(f"{factor * power:.12g}")


def snap_point(
    level: Level,
    point: XY,
    reach: float,
    step: float = 0.0,
    besides: Collection[str] = (),
    *,
    in_line: bool = False,
) -> Snapped:
    """Return the point to which a point snaps [m].

    That is the nearest corner, centre or end of a joint within reach, such as 10 pixels; else the
    nearest side of a body, so that a shape drawn from there touches it; else the nearest point of a
    grid with some step, 0 without a grid. If `in_line`, the vertical and horizontal lines through
    the centres of dynamic bodies replace the grid. Nothing snaps to `besides`, which are being
    moved.
    """
    where, at = placed(level), complex(*point)
    targets = [*_targets(where, besides), *_ends(level, where)]
    near = [found for found in targets if abs(found[0] - at) <= reach]
    if near:
        target, kind, body = min(near, key=lambda found: abs(found[0] - at))
        return Snapped(xy(target), kind, (body,) if body else ())
    if in_line and (found := _in_line(where, at, reach, step)):
        return found
    if found := _on_side(where, at, reach, step, besides):
        return found
    if step:
        return Snapped(xy(_on_grid(at, step)), "grid")
    return Snapped(point)


def _on_side(
    where: Mapping[str, PlacedBody],
    at: complex,
    reach: float,
    step: float,
    besides: Collection[str],
) -> Snapped | None:
    """Return the nearest point of an outline, on a grid line if possible; None if none is near."""
    point = [_Piece("", (at,), 0.0, at, 0.0)]
    others = _pieces(where, where.keys() - set(besides))
    for pair in _near(point, others, 0j, reach)[:1]:
        by = _exact([pair], 0j)
        if by is not None:
            if step:
                by = _along_grid(pair, by, at, step, point, others)
            end = at + by
            plain = float(f"{end.real:.12g}"), float(f"{end.imag:.12g}")
            return Snapped(plain, "side", (pair.other.body,))
    return None


def _in_line(
    where: Mapping[str, PlacedBody], at: complex, reach: float, step: float
) -> Snapped | None:
    """Return a point in line with the centres of dynamic bodies; None if there is none."""
    centers = [one.center for one in where.values() if one.body.type == "dynamic"]
    x = _nearest((center.real for center in centers), at.real, reach)
    y = _nearest((center.imag for center in centers), at.imag, reach)
    if x is None and y is None:
        return None
    grid = _on_grid(at, step) if step else at
    return Snapped((grid.real if x is None else x, grid.imag if y is None else y), "line")


def _nearest(among: Iterable[float], to: float, reach: float) -> float | None:
    near = (one for one in among if abs(one - to) <= reach)
    return min(near, key=lambda one: abs(one - to), default=None)


def snap_body(
    level: Level, names: Collection[str], displacement: XY, reach: float, step: float = 0.0
) -> Snapped:
    """Return the displacement with which moved bodies touch what they come near, exactly [m].

    `displacement` is that by the hand. They snap over gaps and overlaps within reach.
    Along a floor or a wall, and where they touch nothing, the centre of the first snaps to a grid
    with some step, 0 without a grid.
    """
    where = placed(level)
    moving, others = _pieces(where, names), _pieces(where, where.keys() - names)
    start, by = where[next(iter(names))].center, complex(*displacement)
    near = _near(moving, others, by, reach)
    if not near:
        if not step:
            return Snapped(displacement)
        return Snapped(xy(_on_grid(start + by, step) - start), "grid")
    first = near[0]
    across = (pair for pair in near[1:] if abs(_cross(pair.normal, first.normal)) > ACROSS)
    for second in islice(across, 1):
        exact = _exact([first, second], by)
        if exact is not None and abs(exact - by) <= 2 * reach:
            return Snapped(xy(exact), "contact", (first.other.body, second.other.body))
    exact = _exact([first], by)
    if exact is None:
        return Snapped(displacement)
    if step:
        exact = _along_grid(first, exact, start, step, moving, others)
    return Snapped(xy(exact), "contact", (first.other.body,))


def flat_turn(level: Level, name: str, reach: float) -> float:
    """Return the rotation with which a side of a body lies flat on another body [rad].

    The other is the nearest within reach; 0 if there is none, or the body has no sides.
    """
    where = placed(level)
    body = where[name]
    near = _near(_pieces(where, [name]), _pieces(where, where.keys() - {name}), 0j, reach)
    if not near or not isinstance(body.body.shape, Box | Polygon):
        return 0.0
    core = near[0].one.core
    sides = (end - start for start, end in zip(core, (*core[1:], core[0]), strict=True))
    turns = (phase(near[0].normal / (-1j * side)) for side in sides)
    return min(turns, key=abs)


class _Piece(NamedTuple):
    """A convex piece of a body."""

    body: str
    core: Core
    radius: float
    center: complex
    reach: float


class _Pair(NamedTuple):
    """A moved piece, and one close to it."""

    one: _Piece
    other: _Piece
    distance: float
    normal: complex

    def gap(self, by: complex) -> Gap:
        """Return the gap between the two when the first is displaced."""
        core = [point + by for point in self.one.core]
        return gap(core, self.other.core, self.one.radius + self.other.radius)


def _pieces(where: Mapping[str, PlacedBody], names: Collection[str]) -> list[_Piece]:
    """Return the pieces of bodies that can be touched exactly."""
    return [
        _piece(name, core, where[name].radius)
        for name in names
        if not (where[name].body.sensor or isinstance(where[name].body.shape, Arc | Curve))
        for core in where[name].cores
    ]


def _piece(name: str, core: Core, radius: float) -> _Piece:
    center = sum(core) / len(core)
    return _Piece(name, core, radius, center, max(abs(p - center) for p in core) + radius)


def _near(
    moving: Sequence[_Piece], others: Sequence[_Piece], by: complex, reach: float
) -> list[_Pair]:
    """Return the pairs of pieces within reach of each other, the nearest first."""
    found = []
    for one, other in product(moving, others):
        if abs(one.center + by - other.center) <= one.reach + other.reach + reach:
            pair = _Pair(one, other, 0.0, 0j)
            between = pair.gap(by)
            if abs(between.distance) <= reach:
                found.append(_Pair(one, other, between.distance, between.normal))
    return sorted(found, key=lambda pair: abs(pair.distance))


def _exact(pairs: Sequence[_Pair], by: complex) -> complex | None:
    """Return the displacement that closes one or two gaps; None if Newton's method finds none."""
    for _ in range(ROUNDS):
        gaps = [pair.gap(by) for pair in pairs]
        if max(abs(found.distance) for found in gaps) <= EXACT:
            return by
        one, other = gaps[0], gaps[-1]
        turn = _cross(one.normal, other.normal)
        if len(gaps) == 1:
            by += one.normal * one.distance
        elif abs(turn) > ACROSS:
            by += 1j * (one.normal * other.distance - other.normal * one.distance) / turn
        else:
            return None
    size = max(1.0, *(abs(point) for pair in pairs for point in pair.other.core))
    return by if max(abs(pair.gap(by).distance) for pair in pairs) <= CLOSE * size else None


def _along_grid(
    pair: _Pair,
    by: complex,
    start: complex,
    step: float,
    moving: Sequence[_Piece],
    others: Sequence[_Piece],
) -> complex:
    """Return a displacement along a vertical or horizontal side to the grid, if it is free."""
    normal = pair.gap(by).normal
    upright, level = abs(normal.real) > 1 - STRAIGHT, abs(normal.imag) > 1 - STRAIGHT
    if not (upright or level):
        return by
    end = start + by
    grid = _on_grid(end, step)
    slid = (complex(end.real, grid.imag) if upright else complex(grid.real, end.imag)) - start
    slid = _exact([pair], slid) or by
    away = abs(slid - by) > step  # it slid off the end of the side
    blocked = any(found.distance < -STRAIGHT for found in _near(moving, others, slid, step))
    return by if away or blocked else slid


def _targets(where: Mapping[str, PlacedBody], besides: Collection[str]) -> Iterator[Target]:
    """Yield the centres of bodies, and the corners that they have."""
    for name, body in where.items():
        if name not in besides:
            yield body.center, "center", name
            if isinstance(body.body.shape, Box | Polygon | Segment | Polyline):
                yield from ((corner, "corner", name) for corner in body.corners)


def _ends(level: Level, where: Mapping[str, PlacedBody]) -> Iterator[Target]:
    """Yield the points at which joints hold on to the plane."""
    for joint in level.joints.values():
        for _, end in ends_of(joint):
            if body_of(end) is None:
                values = next(iter(where.values())).values
                yield end_position(end, level.bodies, values), "end", ""


def _on_grid(point: complex, step: float) -> complex:
    return complex(_line(point.real, step), _line(point.imag, step))


def _line(coordinate: float, step: float) -> float:
    return float(f"{round(coordinate / step) * step:.12g}")


def _cross(a: complex, b: complex) -> float:
    return (a.conjugate() * b).imag
