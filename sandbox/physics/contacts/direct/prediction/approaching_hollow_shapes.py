"""Pairs of an arc, hoop or curve and another body that do not touch, but might within a drift.

These are not convex, and may be met from inside. The exact contact at a later time tells which
point meets which side. Their distance is traced back along the drift to the time when it was 0.
Where an arc is met from outside, or at an end, both shapes are convex.
"""

from collections.abc import Iterator
from itertools import product
from math import acos, pi
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import pymunk

from sandbox.model.expressions import Array
from sandbox.physics.contacts.detection.time_of_impact import TOUCH, BodyMotion, Hit, Path, meet
from sandbox.physics.contacts.direct.prediction.convex_parts import TOUCHING, Pair
from sandbox.physics.contacts.direct.prediction.corner_contacts import LEAST
from sandbox.physics.contacts.shapes.arc_contact_correction import Hollows
from sandbox.physics.geometry.arc_contacts import Piece, Placed, Touch, to_plane
from sandbox.physics.geometry.contacts_at_moved_positions import (
    ContactGeometry,
    Trace,
    trace,
    trace_convex,
)
from sandbox.physics.geometry.curve_contacts import verdict
from sandbox.physics.geometry.outline_distance import FEELER, Outline, dot, outline_of
from sandbox.physics.geometry.root_finding import root
from sandbox.physics.joints.exact.constraint_interface import Coordinates
from sandbox.physics.state.joint_anchors import Complexes

if TYPE_CHECKING:
    from sandbox.physics.engine.space_arrays import Booleans

SAMPLES = 256
"""The points along an arc for a lower bound of its distance from other bodies."""

TINY = 1e-300
"""m², the least square of the length of a side."""

SLIM = 0.5
"""Between two looks at its contacts, a body may move by this share of its size."""

LOOKS = 2000
"""The most looks at the contacts of two bodies in a drift: enough for a ball of 2 cm at 1,200 m/s
and 60 Hz. What is faster still may pass through; if numbers have run away, no looks are enough."""


Poses = tuple[Placed, Placed]
"""The positions and rotations of two bodies."""


class HollowCorner(NamedTuple):
    """A point of a body that meets an arc or a curve.

    `own` is the body with the normal, 0 or 1: the hollow one, if it is met from inside or is a
    curve. `trace` is their contact.
    """

    pair: Pair
    own: int
    trace: Trace

    def spot(self, poses: Poses) -> ContactGeometry:
        """Return the contact with the bodies at some positions."""
        return self.trace(poses[self.own], poses[1 - self.own])


class _Line(NamedTuple):
    """Points along the middle of a hollow body.

    The points are along the axes of the body. `near` is the largest distance of its surface from
    the nearest of them, and `reach` is the largest distance of its surface from the centre of the
    body; for a whole circle, which looks the same as it turns, it is that of its centre [m].
    """

    points: Complexes
    near: float
    reach: float

    @classmethod
    def of(cls, piece: Piece) -> "_Line | None":
        """Return those of an arc or a curve; None for other pieces."""
        if side := piece.curve:
            knots, near = side.middle_line.knots, side.half + side.middle_line.spacing / 2
            return cls(knots, near, float(np.abs(knots).max()) + near)
        arc = piece.arc
        if arc is None or piece.outward:
            return None
        half = acos(arc.cosine) if arc.cosine >= -1 else pi
        directions = np.exp(1j * np.linspace(-half, half, SAMPLES + 1))
        thick = max(arc.outer - arc.radius, arc.radius - arc.inner)
        points = arc.center + arc.radius * arc.middle * directions
        reach = abs(arc.center) + (arc.outer if half < pi else 0.0)
        return cls(points, thick + arc.radius * half / SAMPLES, reach)


class _Shape(NamedTuple):
    """A shape.

    `piece` is its exact geometry, and `outline` is its outline if it can be met as a convex one;
    None for curves and feelers. `middle` and `size` are the centre and radius of a disc around it,
    along the axes of its body [m].
    """

    piece: Piece
    outline: Outline | None
    middle: complex
    size: float

    @classmethod
    def of(cls, shape: pymunk.Shape, piece: Piece) -> "_Shape":
        """Return a shape."""
        convex = piece.curve is None and shape.filter.categories != FEELER
        middle = sum(piece.core) / len(piece.core)
        around = piece.radius + (piece.curve.half if piece.curve else 0.0)
        size = max(abs(corner - middle) for corner in piece.core) + around
        return cls(piece, outline_of(shape, piece.body) if convex else None, middle, size)


class HollowPairs:
    """Finds where bodies meet arcs, curves, and hoops from inside within a drift; n bodies.

    `hollows` are the hollow bodies, None if there are none, and `count` is n. `pairs`, (n, n),
    tells which are pairs of a hollow body and another.
    """

    def __init__(self, hollows: Hollows | None, count: int) -> None:
        self.pairs: Booleans = np.zeros((count, count), dtype=bool)
        self._shapes: dict[int, list[_Shape]] = {}
        self._lines: dict[int, _Line] = {}
        if hollows is None:
            return
        for one, other in hollows.rows:
            self.pairs[one, other] = self.pairs[other, one] = True
        for shape, piece in hollows.known():
            self._shapes.setdefault(piece.body, []).append(_Shape.of(shape, piece))
            if line := _Line.of(piece):
                self._lines[piece.body] = line

    def reach(self, others: Array) -> Array:
        """Return the largest distances of points that turn with their bodies: (n,) [m].

        `others` are those of bodies that are not hollow.
        """
        reach = others.copy()
        for row, line in self._lines.items():
            reach[row] = line.reach
        return reach

    def gap(self, pair: Pair, pose: Coordinates) -> float:
        """Return a lower bound of the distance between two bodies [m]."""
        hollow, other = self._in_order(pair)
        line, rotation = self._lines[hollow], complex(pose.rotation[hollow])
        points = complex(pose.position[hollow]) + line.points * rotation
        points -= complex(pose.position[other])
        points /= complex(pose.rotation[other])
        pieces = [shape.piece for shape in self._shapes[other] if shape.piece.corner is None]
        return min(_distance(points, piece) for piece in pieces) - line.near

    def meet(self, path: Path, duration: float, pair: Pair, velocity_changes: Array) -> list[Hit]:
        """Return the impacts of two bodies on a path of some duration [s]; see `time_of_impact`.

        They are those of convex shapes, and the first ones from inside or with a curve.
        """
        hits = [*self._convex(path, duration, pair, velocity_changes)]
        for time in self._times(path, duration, pair):
            if traced := [*self._traced(path, time, pair)]:
                return hits + traced
        return hits

    def _in_order(self, pair: Pair) -> Pair:
        """Return the body of a pair that is met along its line, and the other: the longer first."""
        return max(pair, pair[::-1], key=lambda bodies: self._length(bodies[0]))

    def _length(self, body: int) -> float:
        """Return the distance by which the points of a body's line are apart; 0 without one [m]."""
        line = self._lines.get(body)
        return float(np.abs(line.points - line.points[0]).max()) if line else 0.0

    def _times(self, path: Path, duration: float, pair: Pair) -> Iterator[float]:
        """Yield the times at which to look for contacts: several where bodies are fast."""
        (position, _), (other_position, _) = _moved(path, pair, 0.0)
        (end, _), (ended, _) = _moved(path, pair, duration)
        relative_path = abs((ended - end) - (other_position - position))
        size = min(shape.size for shape in self._shapes[self._in_order(pair)[1]])
        looks = 1 + int(min(LOOKS - 1, relative_path / (SLIM * size)))
        return (duration * (look + 1) / looks for look in range(looks))

    def corners(self, pair: Pair, here: Coordinates, there: Coordinates) -> Iterator[HollowCorner]:
        """Yield the points of two bodies that are apart here, and in each other there."""
        placed_before, placed_after = placed(pair, here), placed(pair, there)
        for corner in (
            *self._outside(pair, placed_after),
            *(c for c, _ in self._contacts(pair, placed_after)),
        ):
            if corner.spot(placed_after).gap < -LEAST and corner.spot(placed_before).gap > 0:
                yield corner

    def touching(self, pair: Pair, now: Coordinates, soon: Coordinates) -> Iterator[HollowCorner]:
        """Yield the points of two bodies that touch here, and still do a little later."""
        start, later = placed(pair, now), placed(pair, soon)
        for corner in (*self._outside(pair, later), *(c for c, _ in self._contacts(pair, later))):
            if abs(corner.spot(start).gap) < TOUCHING:
                yield corner

    def _outside(self, pair: Pair, poses: Poses) -> Iterator[HollowCorner]:
        """Yield the possible contacts with the outside and the ends of arcs and curves."""
        for one, other in self._close(pair, poses):
            both = one.outline, other.outline
            if both[0] and both[1] and verdict(one.piece, other.piece, *poses) is True:
                yield HollowCorner(pair, 0, trace_convex(both[0], both[1]))

    def _convex(
        self, path: Path, duration: float, pair: Pair, velocity_changes: Array
    ) -> Iterator[Hit]:
        """Yield the impacts of convex shapes, which are apart at the start."""
        for one, other in product(self._shapes[pair[0]], self._shapes[pair[1]]):
            if one.outline and other.outline:
                hit = meet(path, one.outline, other.outline, 0.0, duration, velocity_changes)
                if hit and hit.time:
                    poses = _moved(path, pair, hit.time)
                    if verdict(one.piece, other.piece, *poses) is True:
                        yield hit

    def _traced(self, path: Path, duration: float, pair: Pair) -> Iterator[Hit]:
        """Yield the impacts that lead to contacts at a time [s]."""
        for corner, guest in self._contacts(pair, _moved(path, pair, duration)):
            time = _time(path, duration, corner)
            if time and self._touches(corner, guest, _moved(path, pair, time)):
                yield _hit(path, time, corner)

    def _contacts(self, pair: Pair, poses: Poses) -> Iterator[tuple[HollowCorner, Piece]]:
        """Yield the contacts of two bodies from inside or with a curve, each with its guest."""
        for shapes in self._close(pair, poses):
            pieces = shapes[0].piece, shapes[1].piece
            found = verdict(*pieces, *poses)
            if not isinstance(found, bool):
                own = pair.index(found.arc.body)
                hollow, guest = pieces[own], pieces[1 - own]
                traced = trace(found, hollow, guest, poses[own], poses[1 - own])
                yield HollowCorner(pair, own, traced), guest

    def _close(self, pair: Pair, poses: Poses) -> Iterator[tuple[_Shape, _Shape]]:
        """Yield the pairs of shapes of two bodies that may overlap."""
        first, second = (
            [(shape, to_plane(pose, shape.middle)) for shape in self._shapes[body]]
            for body, pose in zip(pair, poses, strict=True)
        )
        for (one, placed), (other, other_placed) in product(first, second):
            if abs(other_placed - placed) < one.size + other.size:
                yield one, other

    def _touches(self, corner: HollowCorner, guest: Piece, poses: Poses) -> bool:
        """Return whether a shape touches the hollow body of a contact.

        It may miss an arc, and meet a curve where another of its stretches begins.
        """
        own_pose, guest_pose = poses[corner.own], poses[1 - corner.own]
        shapes = self._shapes[corner.pair[corner.own]]
        found = (verdict(shape.piece, guest, own_pose, guest_pose) for shape in shapes)
        return any(isinstance(touch, Touch) for touch in found)


def placed(pair: Pair, pose: Coordinates) -> Poses:
    """Return the positions and rotations of two bodies."""
    one, other = ((complex(pose.position[body]), complex(pose.rotation[body])) for body in pair)
    return one, other


def _moved(path: Path, pair: Pair, time: float) -> Poses:
    """Return the positions and rotations of two bodies at a time."""
    one, other = (BodyMotion(path, body, time) for body in pair)
    return (one.position, one.rotation), (other.position, other.rotation)


def _time(path: Path, duration: float, corner: HollowCorner) -> float | None:
    """Return when bodies meet that touch at a time [s]; None if they do so from the start."""

    def above(t: float) -> float:
        return corner.spot(_moved(path, corner.pair, t)).gap - TOUCH

    time = root(above, duration)
    return time if 0 < time <= duration else None


def _hit(path: Path, time: float, corner: HollowCorner) -> Hit:
    """Return the impact of a hollow body and another at a time."""
    (a, b), (normal, tip, gap) = corner.pair, corner.spot(_moved(path, corner.pair, time))
    point, normal = (tip, -normal) if corner.own else (tip - normal * gap, normal)
    one, other = (BodyMotion(path, body, time).velocity_at(point) for body in (a, b))
    return Hit(time, (a, b), normal, (point,), dot(normal, other - one))


def _distance(points: Complexes, piece: Piece) -> float:
    """Return the least distance of points outside a shape from it [m]."""
    ends = np.array(piece.core)
    starts = np.roll(ends, 1)
    along, offset = ends - starts, points[:, None] - starts
    square = np.maximum((along * along.conj()).real, TINY)
    share = np.clip((offset * along.conj()).real / square, 0.0, 1.0)
    return float(np.abs(offset - share * along).min()) - piece.radius
