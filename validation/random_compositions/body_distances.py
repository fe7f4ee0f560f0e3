"""The distances between bodies over a whole run at once, and the overlaps that are allowed.

The distance of bodies that overlap is negative. That of two convex polygons is the largest gap
along any direction, out of the normals of their sides and the direction between their nearest
corners. If they overlap, its negative is the shortest translation that separates them, which is
along the normal of a side.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, product

import numpy as np

from sandbox.model.contact_solver_choice import is_direct
from sandbox.model.expressions import Array
from sandbox.physics.engine.space_arrays import Booleans
from validation.random_compositions.independent_shape_properties import Part, is_dynamic, outline
from validation.random_compositions.recorded_run import RecordedRun
from validation.stability.scene_parts import Document

NEAR = 0.02
"""The distance between bounding boxes below which parts are examined [m]."""

TINY = 1e-12
"""The distance of two corners below which it has no direction [m]."""

SKIN = 1.1e-6
"""The overlap that is always allowed [m]: the engine leaves 1e-6 m, approached from above."""

SOON = 0.25
"""The time within which the overlap of a late impact must vanish [s]."""

SLOWLY = 0.2
"""The share of an overlap that a step removes if contacts are pymunk's and nothing bounces; with
bounces it removes none (docs/how-to/write-a-level.md, `correction`). The rest may remain after that
time."""


@dataclass(frozen=True, slots=True)
class Gap:
    """The distance between two convex parts over a run; T instants."""

    separation: Array
    """(T,), the distance, negative for overlaps; infinite if it is large [m]."""
    normal: Array
    """(T, 2), its direction, from the first part to the second."""


def placed(part: Part, position: Array, angle: Array) -> Array:
    """Return the corners of a body's part in the plane: (T, k, 2) [m].

    The position of the body is (T, 2) [m], its angle (T,) [rad].
    """
    c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
    x, y = part.corners.T
    return np.stack([c * x - s * y, s * x + c * y], axis=-1) + position[:, None]


def gap(a: Array, b: Array, radii: float = 0.0) -> Gap:
    """Return the distance between the convex hulls of corners, less the sum of their radii [m].

    The corners of each are (T, k, 2), counter-clockwise.
    """
    directions = np.concatenate([_across(a), -_across(b), _nearest(a, b)], axis=1)
    start = np.einsum("tkc,tdc->tdk", a, directions).max(axis=2)
    end = np.einsum("tkc,tdc->tdk", b, directions).min(axis=2)
    gaps = end - start
    best = gaps.argmax(axis=1)
    rows = np.arange(len(gaps))
    return Gap(gaps[rows, best] - radii, directions[rows, best])


def _across(corners: Array) -> Array:
    """Return the outward normals of the sides, (T, k, 2); both normals of a line."""
    if corners.shape[1] == 1:
        return np.zeros((len(corners), 0, 2))
    sides = np.roll(corners, -1, axis=1) - corners
    normals = np.stack([sides[..., 1], -sides[..., 0]], axis=-1)
    return normals / np.hypot(normals[..., 0], normals[..., 1])[..., None]


def _nearest(a: Array, b: Array) -> Array:
    """Return the direction between the nearest corners of the two."""
    ways = b[:, None] - a[:, :, None]
    lengths = np.hypot(ways[..., 0], ways[..., 1]).reshape(len(a), -1)
    nearest = lengths.argmin(axis=1)
    rows = np.arange(len(a))
    chosen, far = ways.reshape(len(a), -1, 2)[rows, nearest], lengths[rows, nearest]
    unit = chosen / np.where(far > TINY, far, np.inf)[:, None]
    return np.where((far > TINY)[:, None], unit, (0.0, 1.0))[:, None]


Placed = tuple[Array, float]
"""The corners of a part over a run, (T, k, 2), and its radius around them [m]."""


@dataclass(frozen=True, slots=True)
class Couple:
    """Two bodies that may touch."""

    names: tuple[str, str]
    separation: Array
    """(T,), the smallest distance between their parts [m]."""
    parts: tuple[Sequence[Placed], Sequence[Placed]]

    def entered(self, depth: float) -> Booleans:
        """Return when a corner of either first reaches a depth in the other: (T,)."""
        within = np.concatenate([_within(*both, depth) for both in product(*self.parts)], axis=1)
        before = np.zeros_like(within)
        before[1:] = within[:-1]
        return np.asarray((within & ~before).any(axis=1))


def _within(first: Placed, second: Placed, depth: float) -> Booleans:
    """Return which corners of two parts are at least that deep in the other part: (T, k)."""
    (a, own), (b, others) = first, second
    found = gap(a, b, own + others)
    over = np.einsum("tkc,tc->tk", a, found.normal)
    under = np.einsum("tkc,tc->tk", b, found.normal)
    deep = np.hstack((over - under.min(axis=1)[:, None], over.max(axis=1)[:, None] - under))
    return np.asarray((deep + own + others > depth) & (found.separation < -depth)[:, None])


def couples(document: Document, position: Array, angle: Array) -> Iterator[Couple]:
    """Yield the pairs of bodies that come near each other in a run and are not welded.

    The positions are (T, n, 2) [m], the angles (T, n) [rad].
    """
    bodies = document["bodies"]
    welded = solids(document)
    corners = {
        name: [(placed(p, position[:, i], angle[:, i]), p.radius) for p in outline(body)]
        for i, (name, body) in enumerate(bodies.items())
    }
    for a, b in combinations(bodies, 2):
        if not (is_dynamic(bodies[a]) or is_dynamic(bodies[b])) or welded[a] == welded[b]:
            continue
        parts = [_near(*first, *second) for first in corners[a] for second in corners[b]]
        separation = np.min(parts, axis=0)
        if np.isfinite(separation).any():
            yield Couple((a, b), separation, (corners[a], corners[b]))


def _near(a: Array, first: float, b: Array, second: float) -> Array:
    """Return the distance between two parts where their bounding boxes are near: (T,) [m]."""
    room = first + second + NEAR
    above = (a.min(axis=1) - b.max(axis=1)).max(axis=1) < room
    below = (b.min(axis=1) - a.max(axis=1)).max(axis=1) < room
    near = np.flatnonzero(above & below)
    found = np.full(len(a), np.inf)
    if near.size:
        found[near] = gap(a[near], b[near], first + second).separation
    return found


def solids(document: Document) -> dict[str, int]:
    """Return the number of the solid that each body belongs to; welded bodies share one."""
    solid = {name: number for number, name in enumerate(document["bodies"])}
    for joint in document.get("joints", {}).values():
        if joint["type"] != "weld":
            continue
        held = [name for end in joint["ends"] if (name := body_of(end)) is not None]
        if len(held) == 2:
            old, new = solid[held[1]], solid[held[0]]
            solid = {name: new if number == old else number for name, number in solid.items()}
    return solid


def body_of(end: object) -> str | None:
    """Return the body of a joint's end; None if that is the plane."""
    if isinstance(end, dict):
        return str(end["body"])
    return end if isinstance(end, str) else None


def overlapped(couple: Couple) -> float:
    """Return the sum of the greatest depths of two bodies' successive overlaps [m]."""
    depth = np.maximum(-couple.separation, 0.0)
    begins = np.flatnonzero((depth > 0) & (np.concatenate(([0.0], depth[:-1])) == 0))
    return float(np.maximum.reduceat(depth, begins).sum()) if begins.size else 0.0


def excess(recorded: RecordedRun, couple: Couple, extents: Array) -> float:
    """Return the overlap of two bodies beyond what a recent impact explains [m].

    `extents` are the reach of the bodies from their centres: (n,) [m].
    """
    depth = np.maximum(-couple.separation, 0.0)
    if not (depth > SKIN).any():
        return float(depth.max())
    ways = _ways(recorded, couple, extents)
    allowance = np.zeros(len(depth))
    step = np.arange(len(depth))
    share = np.where(step <= SOON * recorded.rate, 1.0, _left(recorded) ** step)
    for at in np.flatnonzero(couple.entered(SKIN)):
        allowance[at:] = np.maximum(allowance[at:], ways[at] * share[: len(depth) - at])
    return float((depth - allowance).max())


def _left(recorded: RecordedRun) -> float:
    """Return the share of an overlap that a step leaves; 0 if it must vanish soon."""
    if is_direct(recorded.level):
        return 0.0
    return 1.0 if recorded.level.effects.restitution else 1 - SLOWLY


def _ways(recorded: RecordedRun, couple: Couple, extents: Array) -> Array:
    """Return the greatest possible approach of two bodies in each step: (T,) [m]."""
    seen, names = recorded.states, list(recorded.scene.document["bodies"])
    a, b = (names.index(name) for name in couple.names)
    apart = np.diff(seen.position[:, a] - seen.position[:, b], axis=0)
    turn = sum(np.abs(np.diff(seen.angle[:, i])) * extents[i] for i in (a, b))
    return np.concatenate(([0.0], np.hypot(*apart.T) + turn))
