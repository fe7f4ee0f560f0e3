"""Wires are smooth and do not cross themselves, and beads start on them."""

from collections.abc import Iterator
from functools import partial

import numpy as np

from sandbox.model.bounds import Coordinate
from sandbox.model.conditions.condition import Condition
from sandbox.model.expressions import Array, Values
from sandbox.model.joints import Wire, bodies_of
from sandbox.model.level import Level, place
from sandbox.model.parts import names_in
from sandbox.model.wires import NEAR, PIECES, Points, along, is_closed, places

COARSE = 256
"""How many pieces a wire is cut into to look for crossings."""

SHARPEST = 0.1
"""rad, by which a smooth wire may turn from one of its pieces to the next."""

WORK = 3500
"""µs, about what it takes to look at a wire."""

PARALLEL = 1e-9
"""rad, between pieces that do not cross."""

ZOOMS = 6


def conditions(level: Level) -> Iterator[Condition]:
    """Yield what must hold of a level's wires."""
    for name, wire in level.joints.items():
        if isinstance(wire, Wire):
            beads = [level.bodies[body] for body in bodies_of(wire)]
            names = names_in((wire, *((b.position, b.angle) for b in beads))) - {"s"}
            yield Condition(("joints", name, "curve"), names, partial(_fault, wire, level), WORK)


def _fault(wire: Wire, level: Level, values: Values) -> str | None:
    first, last = (end(values) for end in wire.s)
    if not first < last:
        return f"'s' must run upwards, but it runs from {first:g} to {last:g}"
    points = along(wire, values)
    if not np.isfinite(points).all():
        lost = np.linspace(first, last, PIECES + 1)[~np.isfinite(points)][0]
        return f"the wire is nowhere finite at s = {lost:g}"
    if beyond := Coordinate.beyond(float(np.abs(points).max())):
        return f"the wire is {np.abs(points).max():g} m away from the origin, {beyond}"
    if rule := _shape_fault(points):
        return rule
    away = _distance(wire, place(wire.bead, level.bodies, values), values)
    if away > NEAR * max(1.0, float(np.abs(points).max())):
        return f"the bead must start on the wire, but it is {away:g} m away from it"
    return None


def _shape_fault(points: Points) -> str | None:
    pieces = np.diff(points)
    if not np.abs(pieces).min() > 0:
        return f"the wire does not move on with s at {_shown(points[np.abs(pieces).argmin()])}"
    corners = points[1:-1]
    if is_closed(points):
        pieces, corners = np.append(pieces, pieces[0]), points[1:]
    turns = np.abs(np.angle(pieces[1:] / pieces[:-1]))
    if turns.max() > SHARPEST:
        place = _shown(corners[turns.argmax()])
        return f"a wire needs its corners rounded, but this one is sharp at {place}"
    if (crossing := _crossing(points[:: PIECES // COARSE])) is not None:
        return f"a wire must not cross itself, but this one does near {_shown(crossing)}"
    return None


def _crossing(points: Points) -> complex | None:
    """Return where a polyline meets itself, None if it does not."""
    a, along_a = points[:-1, None], np.diff(points)[:, None]
    b, along_b = points[None, :-1], np.diff(points)[None, :]
    across = _cross(along_a, along_b)
    across[np.abs(across) < PARALLEL * np.abs(along_a * along_b)] = np.nan
    of_a, of_b = _cross(b - a, along_b) / across, _cross(b - a, along_a) / across
    meet = (of_a >= 0) & (of_a < 1) & (of_b >= 0) & (of_b < 1)
    pairs = np.argwhere(np.triu(meet, 2))
    last = len(points) - 2
    found = [i for i, k in pairs if not ((i, k) == (0, last) and is_closed(points))]
    return complex(points[found[0]]) if found else None


def _cross(a: Points, b: Points) -> Array:
    return a.real * b.imag - a.imag * b.real  # of real numbers: half the time


def _distance(wire: Wire, place: complex, values: Values) -> float:
    """Return how far a place is from a wire [m]; it looks closer and closer."""
    first, last = (end(values) for end in wire.s)
    low, high = first, last
    for zoom in range(ZOOMS):
        s = np.linspace(low, high, (64 if zoom else PIECES) + 1)
        away = np.abs(places(wire, values, s) - place)
        nearest = int(away.argmin())
        low, high = s[max(nearest - 1, 0)], s[min(nearest + 1, len(s) - 1)]
    return float(away.min())


def _shown(point: complex) -> str:
    return f"[{point.real:.3g}, {point.imag:.3g}]"
