"""Which bodies certainly stay apart through a drift, so that no time of impact need be computed.

A convex part is clear of another while its corners are in front of one of the other's sides.
Relative to that side, the acceleration of a corner is at most c. So within a time T its height
falls no further than c T² / 8 below the lower of the heights at both ends.
"""

from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.detection.time_of_impact import Path
from sandbox.physics.contacts.direct.prediction.convex_parts import ConvexPart, ConvexParts, Pair
from sandbox.physics.joints.exact.constraint_interface import Coordinates

CLEAR = 1e-7
"""m, the least distance of bodies that certainly are apart: contacts overlap by less."""


class _Motion(NamedTuple):
    """The bounds of a body's motion in a drift."""

    velocity: complex  # m/s, at its start
    acceleration: complex  # m/s²
    spin: float  # rad/s, the largest angular speed
    twist: float  # rad/s², the size of the angular acceleration
    reach: float  # m, the largest distance of corners from the centre of mass

    @property
    def bend(self) -> float:
        """A bound of the acceleration of its corners by rotation [m/s²]."""
        return self.reach * (self.spin * self.spin + self.twist)


class Separation:
    """Tells which bodies stay apart in a drift.

    `shapes` are the parts of the bodies, `path` is their motion, and `duration` is the length of
    the drift [s].
    """

    def __init__(self, shapes: ConvexParts, path: Path, duration: float) -> None:
        self._shapes, self._path, self._duration = shapes, path, duration
        self._start, self._end = (shapes.at(spread(path.pose_at(t))) for t in (0.0, duration))
        self._known: dict[int, _Motion] = {}

    def unsure(self, pair: Pair) -> list[Pair]:
        """Return the pairs of parts of two bodies, by index, that may meet."""
        one, other = map(self._motion, pair)
        resting = self._sag(abs(other.acceleration - one.acceleration) + one.bend + other.bend)
        falls = self._falls(pair, one, other), self._falls(pair, other, one), resting
        start, end = self._start, self._end
        return [
            parts
            for parts in self._shapes.near(pair, start, end, resting)
            if not _stay_apart(start.both(pair, parts), end.both(pair, parts), falls)
        ]

    def _motion(self, body: int) -> _Motion:
        if (motion := self._known.get(body)) is None:
            vx, vy, spin = self._path.velocity[body].tolist()
            ax, ay, twist = self._path.acceleration[body].tolist()
            fastest = abs(spin) + abs(twist) * self._duration
            reach = float(self._shapes.reach[body])
            motion = _Motion(complex(vx, vy), complex(ax, ay), fastest, abs(twist), reach)
            self._known[body] = motion
        return motion

    def _falls(self, pair: Pair, side: _Motion, corner: _Motion) -> float:
        """Return how far the height of a corner over a side may fall below that at both ends [m].

        For its acceleration relative to the side see `_turning` in `time_of_impact`.
        """
        position, duration = self._start.pose.position, self._duration
        acceleration = abs(corner.acceleration - side.acceleration) + corner.bend
        relative_speed = abs(corner.velocity - side.velocity) + corner.reach * corner.spin
        fastest = relative_speed + acceleration * duration
        farthest = (
            float(abs(position[pair[1]] - position[pair[0]])) + corner.reach + fastest * duration
        )
        turns = 2 * side.spin * fastest + (side.twist + side.spin * side.spin) * farthest
        return self._sag(acceleration + turns)

    def _sag(self, curve: float) -> float:
        """Return the largest deviation of a path from its chord, given its acceleration [m]."""
        return curve * self._duration * self._duration / 8 + CLEAR


def spread(pose: Array) -> Coordinates:
    """Return poses of bodies, (n, 3), as coordinates, with the plane."""
    values = np.zeros((len(pose) + 1, 3))
    values[:-1] = pose
    return Coordinates(np.concatenate((values[:, :2].ravel(), values[:, 2])))


Both = tuple[ConvexPart, ConvexPart]
"""A part of each of two bodies."""


def _stay_apart(start: Both, end: Both, falls: tuple[float, float, float]) -> bool:
    """Return whether two parts that are near certainly stay apart between two placements.

    `falls` bounds how far heights over sides of the first and of the second part, and distances
    along a fixed direction, may fall in between [m].
    """
    for own in (0, 1):
        if start[own].normals:
            high, side = start[own].shows(start[1 - own])
            if high > falls[own] and end[own].lowest(end[1 - own], side) > falls[own]:
                return True
    offset = min([q - p for p in start[0].corners for q in start[1].corners], key=abs)
    return bool(offset) and all(
        _apart(both, offset / abs(offset)) > falls[2] for both in (start, end)
    )


def _apart(both: Both, normal: complex) -> float:
    """Return the separation of two parts along a normal, from the first to the second [m]."""
    along = normal.conjugate()
    (top, bottom) = ([(corner * along).real for corner in part.corners] for part in both)
    return min(bottom) - max(top) - both[0].rounding - both[1].rounding
