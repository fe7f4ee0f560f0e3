"""The time of impact of two outlines on parabolas, by conservative advancement.

A bound on the motion of the corners along the normal gives a time before which no corner can cross
the gap between two convex outlines. Time advances to that bound, the gap is computed again, and so
on until they touch: never too late, and with the convergence of Newton's method (B. V. Mirtich:
Impulse-based Dynamic Simulation, 1996; E. Catto: Continuous Collision, GDC 2013).
"""

from cmath import rect
from collections.abc import Sequence
from math import inf, sqrt
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.space_arrays import Booleans
from sandbox.physics.geometry.outline_distance import FLUSH, Gap, Outline, dot, gap

TOUCH = -1e-9
"""m, the gap at which shapes touch. It is the skin of flat shapes; bodies that come to rest must be
in contact whatever the rounding."""

CLOSE = 1e-12
"""m, the tolerance of that gap."""

FAR = 1e-15
"""The same far from the origin, as a share of the distance from it."""

NEAR = 1e-10
"""m, the additional gap at which shapes count as touching when all contacts are collected."""

TRIES = 200
"""The most advancements of two outlines in a step."""

ROUNDING = 1e-12
"""An approach counts as zero if it is slower than this share of the speeds of the two bodies, or of
their change in a step."""


class Hit(NamedTuple):
    """An impact of two bodies.

    `time` is since the previous step [s]. The unit normal points from the first body to the second;
    the contact points are in the plane, and `gap` is the distance of the bodies there [m].
    `parting` is the least separation rate at these points [m/s].
    """

    time: float
    bodies: tuple[int, int]
    normal: complex
    points: tuple[complex, ...]
    parting: float
    gap: float = TOUCH


class Path:
    """The motion of n bodies between two kicks, each on a parabola since its last impact.

    `pose` and `velocity`, (n, 3), are x, y and angle at the time of the last impact, and their
    rates [m, rad, m/s, rad/s]; `start`, (n,), is that time [s], and `acceleration`, (n, 3), holds
    from then on [m/s², rad/s²]. `struck`, (n,), tells which bodies had an impact.
    """

    def __init__(self, pose: Array, velocity: Array, acceleration: Array) -> None:
        self.pose, self.velocity = pose.copy(), velocity.copy()
        self.acceleration = acceleration.copy()
        self.start = np.zeros(len(pose))
        self.struck = np.zeros(len(pose), dtype=bool)

    def pose_at(self, t: float) -> Array:
        """Return the positions at a time: (n, 3)."""
        elapsed = (t - self.start)[:, None]
        velocity = self.velocity + self.acceleration * elapsed
        return self.pose + (self.velocity + velocity) * (elapsed / 2)

    def at(self, t: float) -> tuple[Array, Array]:
        """Return positions and velocities at a time: (n, 3) each."""
        elapsed = (t - self.start)[:, None]
        return self.pose_at(t), self.velocity + self.acceleration * elapsed

    def turn(self, t: float, jump: Array, struck: Booleans) -> None:
        """Add a jump to the velocities of the bodies that are struck at a time."""
        pose, velocity = self.at(t)
        self.pose[struck] = pose[struck]
        self.velocity[struck] = (velocity + jump)[struck]
        self.start[struck] = t
        self.struck |= struck


class BodyMotion:
    """The motion of a body at a time on its path, in complex numbers."""

    def __init__(self, path: Path, body: int, t: float) -> None:
        elapsed = t - float(path.start[body])
        x, y, angle = path.pose[body].tolist()
        vx, vy, start_angular_velocity = path.velocity[body].tolist()
        ax, ay, self.angular_acceleration = path.acceleration[body].tolist()
        self.acceleration = complex(ax, ay)
        self.velocity = complex(vx, vy) + self.acceleration * elapsed
        self.angular_velocity = start_angular_velocity + self.angular_acceleration * elapsed
        self.position = complex(x, y) + (complex(vx, vy) + self.velocity) * (elapsed / 2)
        self.rotation = rect(
            1, angle + (start_angular_velocity + self.angular_velocity) * (elapsed / 2)
        )

    @property
    def turns(self) -> bool:
        """Whether the body rotates."""
        return self.angular_velocity != 0 or self.angular_acceleration != 0

    def place(self, corners: Sequence[complex]) -> list[complex]:
        """Return the positions of points of the body in the plane."""
        return [self.position + self.rotation * corner for corner in corners]

    def velocity_at(self, point: complex) -> complex:
        """Return the velocity of the body at a point of the plane."""
        return self.velocity + 1j * self.angular_velocity * (point - self.position)

    def turning_bound(self, reach: float, dt: float) -> float:
        """Return a bound on the acceleration by rotation of points within a reach [m]."""
        fastest = abs(self.angular_velocity) + abs(self.angular_acceleration) * dt
        return reach * (fastest * fastest + abs(self.angular_acceleration))


def meet(
    path: Path, one: Outline, other: Outline, start: float, until: float, velocity_changes: Array
) -> Hit | None:
    """Return the next impact of two shapes that approach each other; None if there is none.

    Shapes that touch at the start, with an approach velocity of at most its change in a step, rest
    on each other: they are left to pymunk.

    At a step pymunk finds all overlaps, even those smaller than `TOUCH`. So an impact of shapes
    that overlap at the end of a drift belongs to that drift, and comes at its end at the latest.
    Shapes that are still apart there are left to the next drift.

    The times to search are from `start` to `until` [s]. `velocity_changes`, (2, n, 3), are the
    changes of velocity by gravity and laws alone in a step, and by all forces in the rest of it
    [m/s, rad/s].
    """
    t, at_end = start, False
    changes_of_pair = [
        [complex(*change) for change in velocity_changes[:, o.body, :2].tolist()]
        for o in (one, other)
    ]
    for _ in range(TRIES):
        first, second = BodyMotion(path, one.body, t), BodyMotion(path, other.body, t)
        cores = first.place(one.corners), second.place(other.corners)
        found = gap(*cores, one.radius + other.radius)
        if found.distance <= (_rounding(first, second) if at_end else _touch(first, second)):
            if _passes(one, cores, found.normal) or _passes(other, cores[::-1], -found.normal):
                return None
            hit = _hit(t, (one, other), (first, second), found)
            speeds = first.velocity, second.velocity
            rests = t == start or at_end
            allowed = _allowed(found.normal, speeds, changes_of_pair, rests=rests)
            if hit.parting < -allowed:
                return hit
            if hit.parting <= allowed:
                return None
        if at_end:
            return None
        t += _clear(found.normal, (first, second), cores, (one, other), until - t)
        if t > until:
            t, at_end = until, True
    return None


def _allowed(
    normal: complex,
    speeds: Sequence[complex],
    velocity_changes: Sequence[list[complex]],
    *,
    rests: bool,
) -> float:
    """Return the approach velocity that counts as zero, or with which bodies may still rest [m/s].

    `velocity_changes` are the changes of velocity of each body, as `velocity_changes` of `meet`.
    """
    allowed = ROUNDING * max(
        abs(rate) for rate in (*speeds, velocity_changes[0][0], velocity_changes[1][0])
    )
    if rests:
        allowed += max(abs(dot(normal, b - a)) for a, b in zip(*velocity_changes, strict=True))
    return allowed


def touching(path: Path, one: Outline, other: Outline, t: float) -> Hit | None:
    """Return the contact of two shapes at a time, separating or not; None without a contact."""
    first, second = BodyMotion(path, one.body, t), BodyMotion(path, other.body, t)
    cores = first.place(one.corners), second.place(other.corners)
    found = gap(*cores, one.radius + other.radius)
    if found.distance > _touch(first, second) + NEAR:
        return None
    if _passes(one, cores, found.normal) or _passes(other, cores[::-1], -found.normal):
        return None
    return _hit(t, (one, other), (first, second), found)


def nearest(path: Path, one: Outline, other: Outline, t: float) -> Hit:
    """Return the places where two shapes are nearest at a time."""
    first, second = BodyMotion(path, one.body, t), BodyMotion(path, other.body, t)
    found = gap(first.place(one.corners), second.place(other.corners), one.radius + other.radius)
    return _hit(t, (one, other), (first, second), found)._replace(gap=found.distance)


def _touch(first: BodyMotion, second: BodyMotion) -> float:
    """Return the gap at which bodies touch [m]."""
    return TOUCH + max(CLOSE, _rounding(first, second))


def _rounding(first: BodyMotion, second: BodyMotion) -> float:
    """Return the rounding error of the gap between bodies [m]."""
    return FAR * max(abs(first.position), abs(second.position))


def _hit(
    t: float, outlines: tuple[Outline, Outline], bodies: tuple[BodyMotion, BodyMotion], found: Gap
) -> Hit:
    """Return the hit of two touching shapes."""
    (one, other), (first, second) = outlines, bodies
    n = found.normal
    points = tuple(p + n * one.radius for p in found.points)
    parting = min(dot(n, second.velocity_at(p) - first.velocity_at(p)) for p in points)
    return Hit(t, (one.body, other.body), n, points, parting)


def _clear(
    normal: complex,
    bodies: tuple[BodyMotion, BodyMotion],
    cores: tuple[Sequence[complex], ...],
    outlines: tuple[Outline, Outline],
    time_left: float,
) -> float:
    """Return a time during which two outlines certainly stay apart, within the time left [s].

    Each of up to three normals gives a bound, and the longest counts: a fixed normal, and one that
    rotates with either body. Along a fixed normal alone, a rotating side soon seems to cross a
    corner from which it only separates.
    """
    first, second = bodies
    one, other = outlines
    radii = one.radius + other.radius
    acceleration_bound = first.turning_bound(one.extent, time_left) + second.turning_bound(
        other.extent, time_left
    )
    relative_acceleration = (
        dot(normal, second.acceleration - first.acceleration) - acceleration_bound
    )
    moving_corners = [(q, second.velocity_at(q)) for q in cores[1]]
    fixed_normal_time = min(
        _crossing(
            dot(normal, q - p) - radii,
            dot(normal, other_velocity - velocity),
            relative_acceleration,
        )
        for p, velocity in ((p, first.velocity_at(p)) for p in cores[0])
        for q, other_velocity in moving_corners
    )
    times = [fixed_normal_time]
    if first.turns and len(cores[0]) > 1:
        times.append(_turning(normal, first, second, cores, other.extent, radii, time_left))
    if second.turns and len(cores[1]) > 1:
        times.append(_turning(-normal, second, first, cores[::-1], one.extent, radii, time_left))
    return max(times)


def _turning(
    normal: complex,
    first: BodyMotion,
    other: BodyMotion,
    cores: tuple[Sequence[complex], ...],
    reach: float,
    radii: float,
    time_left: float,
) -> float:
    """Return how long the corners of `other` stay clear of `first`, along a normal of `first` [s].

    The normal rotates with the first body, at ω, so the heights of its own corners are constant.
    For the other's corners, at z from its centre, the acceleration differs from that in the plane
    by at most 2 ω dz/dt + (dω/dt + ω²) z.
    """
    speed_bound = abs(first.angular_velocity) + abs(first.angular_acceleration) * time_left
    acceleration = abs(other.acceleration - first.acceleration) + other.turning_bound(
        reach, time_left
    )
    top = max(dot(normal, corner) for corner in cores[0]) + radii
    times = []
    for corner in cores[1]:
        arm, relative_velocity = corner - first.position, other.velocity_at(corner) - first.velocity
        fastest = abs(relative_velocity) + acceleration * time_left
        farthest = abs(arm) + fastest * time_left
        acceleration_along = (
            -acceleration
            - 2 * speed_bound * fastest
            - (abs(first.angular_acceleration) + speed_bound * speed_bound) * farthest
        )
        rate = dot(normal, relative_velocity - 1j * first.angular_velocity * arm)
        times.append(_crossing(dot(normal, corner) - top, rate, acceleration_along))
    return min(times)


def _crossing(height: float, rate: float, acceleration: float) -> float:
    """Return when height + rate t + curve t² / 2 falls, or falls back, to `TOUCH`."""
    above = max(height - TOUCH, 0.0)
    square = rate * rate - 2 * acceleration * above
    if square < 0:
        return inf
    if rate > 0:
        return (-rate - sqrt(square)) / acceleration if acceleration < 0 else inf
    falls = sqrt(square) - rate
    return 2 * above / falls if falls > 0 else inf


def _passes(line: Outline, cores: tuple[Sequence[complex], ...], normal: complex) -> bool:
    """Return whether a disc touches the end of a line on the side where the next line joins.

    The contact there is with the next line, so that no ball trips over the joint, as in pymunk.
    """
    if not any(line.continuations) or len(cores[1]) > 1:
        return False
    (a, b), center = cores[0], cores[1][0]
    ahead = (b - a) / (line.corners[1] - line.corners[0])  # the rotation of the line
    for end, continuation in zip((a, b), line.continuations, strict=True):
        reached = abs(abs(center - end) - abs(dot(normal, center - end))) <= FLUSH
        if continuation and reached and dot(-normal, continuation * ahead) < 0:
            return True
    return False
