"""Snapping points and bodies to where they were probably meant: a grid, an end, a surface.

A body that is moved near another is set exactly touching, with no gap and no overlap but rounding;
near a second one, touching that as well, as in the corner of a room.
"""

from cmath import phase
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from itertools import islice, product
from math import floor, log10
from typing import Literal, NamedTuple

from sandbox.editing.placement import Core, Placed, placed, xy
from sandbox.model.joint_ends import place
from sandbox.model.joints import body_of, ends_of
from sandbox.model.level import Level
from sandbox.model.shapes import XY, Arc, Box, Curve, Polygon, Polyline, Segment
from sandbox.physics.geometry.distance import Gap, gap

FINEST = 8
"""The least distance between grid lines [px]."""

EXACT, CLOSE = 1e-15, 1e-12
"""m, the gaps that count as none, and as none but for rounding; relative to scenes larger than a
metre."""

ACROSS = 0.05
"""The least sine of the angle between two sides in whose corner a body may lie."""

ROUNDS = 20
"""How often a body is moved by the remaining gap; most need one round."""

STRAIGHT = 1e-9
"""How far a side may be from upright or level, as a share; or how deep rounding may overlap [m]."""

Kind = Literal["grid", "corner", "center", "end", "contact", "line", "side"]

Target = tuple[complex, Kind, str]
"""A place that attracts points, the kind of place, and its body."""


class Snapped(NamedTuple):
    """Where a point is drawn to, or by how much a body."""

    point: XY
    """m; of a body the whole way that it is moved"""
    kind: Kind | None = None
    """To what; None if there is nothing near, and no grid."""
    bodies: tuple[str, ...] = ()
    """Whose corner or centre it is, or which are touched."""


def grid_step(pixel: float) -> float:
    """Return how far the lines of the grid are apart [m] where a pixel is so large [m].

    1, 2 or 5 times a power of ten, and not less than 8 pixels.
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
    """Return where a point is drawn to.

    The nearest corner, centre or end of a joint within reach; else the nearest side of a body, so
    that what is drawn from there touches it; else the nearest point of the grid.

    Parameters
    ----------
    level
        The level around it.
    point
        The position of the pointer [m].
    reach
        How far it may be drawn [m]: 10 pixels, say.
    step
        Of the grid [m]; 0 if there is none.
    besides
        Bodies that it is not drawn to: those that are being moved.
    in_line
        Whether it is rather drawn upright above or below the centres of bodies that move, or level
        with them, than to the lines of the grid.
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
    where: Mapping[str, Placed], at: complex, reach: float, step: float, besides: Collection[str]
) -> Snapped | None:
    """Return the nearest point of an outline, along the grid if it can be; None if none is near."""
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


def _in_line(where: Mapping[str, Placed], at: complex, reach: float, step: float) -> Snapped | None:
    """Return a place above, below or beside the centres of bodies that move; None if none is."""
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
    level: Level,
    names: Collection[str],
    way: XY,
    reach: float,
    step: float = 0.0,
) -> Snapped:
    """Return by how much bodies are moved so that they touch what they come near, exactly.

    Along a floor or a wall, and where they touch nothing, the first one's centre keeps to the grid.

    Parameters
    ----------
    level
        The level around them.
    names
        Those that are moved together.
    way
        By how much, as the hand has moved them [m].
    reach
        How near they have to come to be drawn to something [m], or how deep into it.
    step
        Of the grid [m]; 0 if there is none.
    """
    where = placed(level)
    moving, others = _pieces(where, names), _pieces(where, where.keys() - names)
    start, by = where[next(iter(names))].center, complex(*way)
    near = _near(moving, others, by, reach)
    if not near:
        if not step:
            return Snapped(way)
        return Snapped(xy(_on_grid(start + by, step) - start), "grid")
    first = near[0]
    across = (pair for pair in near[1:] if abs(_cross(pair.normal, first.normal)) > ACROSS)
    for second in islice(across, 1):
        exact = _exact([first, second], by)
        if exact is not None and abs(exact - by) <= 2 * reach:
            return Snapped(xy(exact), "contact", (first.other.body, second.other.body))
    exact = _exact([first], by)
    if exact is None:
        return Snapped(way)
    if step:
        exact = _along_grid(first, exact, start, step, moving, others)
    return Snapped(xy(exact), "contact", (first.other.body,))


def flat_turn(level: Level, name: str, reach: float) -> float:
    """Return by how much a body is to be turned so that a side of it lies flat [rad].

    On the side of the nearest body within reach; 0 if there is none, or it has no sides.
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
    """A piece that is moved, and one that it comes near."""

    one: _Piece
    other: _Piece
    distance: float
    normal: complex

    def gap(self, by: complex) -> Gap:
        """Return the gap between the two where the first is moved by that."""
        core = [point + by for point in self.one.core]
        return gap(core, self.other.core, self.one.radius + self.other.radius)


def _pieces(where: Mapping[str, Placed], names: Collection[str]) -> list[_Piece]:
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
    """Return what comes within reach of each other, the nearest first."""
    found = []
    for one, other in product(moving, others):
        if abs(one.center + by - other.center) <= one.reach + other.reach + reach:
            pair = _Pair(one, other, 0.0, 0j)
            between = pair.gap(by)
            if abs(between.distance) <= reach:
                found.append(_Pair(one, other, between.distance, between.normal))
    return sorted(found, key=lambda pair: abs(pair.distance))


def _exact(pairs: Sequence[_Pair], by: complex) -> complex | None:
    """Return a way that closes the gaps of one pair or two; None if Newton's method finds none."""
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
    """Return a way along an upright or level side that ends on the grid, if nothing is in it."""
    normal = pair.gap(by).normal
    upright, level = abs(normal.real) > 1 - STRAIGHT, abs(normal.imag) > 1 - STRAIGHT
    if not (upright or level):
        return by
    end = start + by
    grid = _on_grid(end, step)
    slid = (complex(end.real, grid.imag) if upright else complex(grid.real, end.imag)) - start
    slid = _exact([pair], slid) or by
    away = abs(slid - by) > step  # it has slid off the end of the side
    blocked = any(found.distance < -STRAIGHT for found in _near(moving, others, slid, step))
    return by if away or blocked else slid


def _targets(where: Mapping[str, Placed], besides: Collection[str]) -> Iterator[Target]:
    """Yield the centres of bodies, and the corners that they have."""
    for name, body in where.items():
        if name not in besides:
            yield body.center, "center", name
            if isinstance(body.body.shape, Box | Polygon | Segment | Polyline):
                yield from ((corner, "corner", name) for corner in body.corners)


def _ends(level: Level, where: Mapping[str, Placed]) -> Iterator[Target]:
    """Yield where joints hold on to the plane."""
    for joint in level.joints.values():
        for _, end in ends_of(joint):
            if body_of(end) is None:
                values = next(iter(where.values())).values
                yield place(end, level.bodies, values), "end", ""


def _on_grid(point: complex, step: float) -> complex:
    return complex(_line(point.real, step), _line(point.imag, step))


def _line(coordinate: float, step: float) -> float:
    return float(f"{round(coordinate / step) * step:.12g}")


def _cross(a: complex, b: complex) -> float:
    return (a.conjugate() * b).imag
