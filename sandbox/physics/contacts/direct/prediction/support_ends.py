"""Contacts that pass the end of a side within a drift: bodies that leave their support.

A contact between a side and a disc or a corner ends where that reaches the end of the side. From
there on the end of the side touches instead: a disc turns about it, or flies off, and a corner is
past it, so that the other body's side touches. The forces jump. So the drift is cut there; see
`drifts_with_landings`. Likewise a disc that turns about a corner comes onto the next side.

Two sides that lie on each other touch as long as they overlap.
"""

from collections.abc import Iterator, Sequence
from itertools import permutations
from math import inf
from typing import TYPE_CHECKING

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.complementarity.redundant_systems import max_abs
from sandbox.physics.contacts.direct.prediction.convex_parts import ConvexParts
from sandbox.physics.contacts.direct.prediction.side_end_geometry import (
    EndCrossing,
    Line,
    PointsOnSides,
)
from sandbox.physics.contacts.direct.prediction.straight_side_tables import NEAR, Sides
from sandbox.physics.contacts.direct.rows.contact_outlines import SHARP
from sandbox.physics.contacts.direct.rows.kick_system import Kick
from sandbox.physics.contacts.direct.rows.row_layout import Surfaces
from sandbox.physics.contacts.shapes.arc_contact_correction import Hollows
from sandbox.physics.engine.space_arrays import Booleans, Contacts
from sandbox.physics.geometry.outline_distance import dot
from sandbox.physics.joints.exact.constraint_interface import Coordinates, angles, translations
from sandbox.physics.state.joint_anchors import Complexes

if TYPE_CHECKING:
    from sandbox.physics.contacts.direct.rows.contact_points import ContactPoints

LEAST = 1e-8
"""m, the least distance past the end of a side that counts."""

MOST = 6
"""The largest motion of a point along a side, as a multiple of the largest coordinate change."""


class SupportEnds:
    """Finds the contacts that pass the ends of sides in a drift; n bodies.

    `shapes` are the parts of the bodies, and `surfaces` has their contact properties; `hollows` are
    the arcs and curves, None if there are none. `reach`, (n,), are the largest distances of points
    that turn with their bodies [m].
    """

    def __init__(
        self, shapes: ConvexParts, surfaces: Surfaces, hollows: Hollows | None, reach: Array
    ) -> None:
        pieces = [piece for _, piece in hollows.known()] if hollows else []
        lines = {piece.body: Line.of(piece) for piece in pieces if piece.arc or piece.curve}
        self._lines = {body: line for body, line in lines.items() if line}
        self._sides, self._lands = Sides(shapes.parts), surfaces.lands
        self._ends: Booleans = self._sides.any.copy()  # which bodies have sides, or are such lines
        self._ends[[*self._lines]] = True
        figures = surfaces.figures
        self._radius = np.where(figures.radius > 0, figures.radius, figures.rounding)
        self._sharp: Booleans = (figures.radius == 0) & (figures.rounding <= SHARP)
        thickest = max((part.rounding for own in shapes.parts for part in own), default=0.0)
        arms = np.where(np.isfinite(reach), reach, 0.0) + np.where(self._ends, thickest, 0.0)
        self._weights = np.concatenate((np.ones(2 * len(arms) + 2), arms, (0.0,)))
        self._touching: ContactPoints | None = None  # the points at the last search
        self._tips: Complexes | None = None  # those opposite to sides, if they may change
        self._last_positions = self._weights  # the positions then
        self._clearance = 0.0  # how far all points were from the ends of sides [m]

    def passing(self, kick: Kick, displacement: Array, forces: Array) -> list[EndCrossing]:
        """Return the contacts that pass the end of a side within a drift.

        Only those that bear a force, or that would overlap at its end beside the corner.
        `displacement`, (3 N,), are the displacements in the drift [m, rad], and `forces`, (r,), are
        those of the kick's rows [N].
        """
        if self._is_far(kick, displacement):
            return []
        ahead = MOST * max_abs(displacement * self._weights)
        if ahead < LEAST:
            return []
        end, bears = Coordinates(kick.pose.values + displacement), forces[kick.layout.gaps] > 0
        return [
            one
            for one in self._all(kick, ahead)
            if self._lands[one.bodies]
            and one.distance_left(end) < -LEAST
            and (bears[one.gap] or _comes_down(kick, one, end))
        ]

    def _is_far(self, kick: Kick, displacement: Array) -> bool:
        """Return whether all points certainly stay clear of the ends of sides in a drift."""
        touching = kick.layout.touching
        if touching is not self._touching:
            return False
        change = (kick.pose.values + displacement - self._last_positions) * self._weights
        if MOST * max_abs(change) >= self._clearance:
            (a, b), shift, turns = touching.bodies, translations(change), np.abs(angles(change))
            path_length = np.abs(shift[a] - shift[b]) + turns[a] + turns[b]
            if path_length.max(initial=0.0) >= self._clearance:
                return False
        if self._tips is None or max_abs(angles(change)) < NEAR:
            return True
        return bool(np.abs(_tips(kick) - self._tips).max() < NEAR)

    def after(
        self, kick: Kick, passing: Sequence[EndCrossing], motion: Array
    ) -> tuple[Contacts, Booleans]:
        """Return the contacts that follow, and which bodies touch there with an end: (2, c).

        The bodies of the kick are where the contacts, `passing`, pass; `motion`, (3 N,), are the
        velocities there [m/s, rad/s].
        """
        contacts, rows, feet, ends = kick.contacts, [], [], []
        direction = contacts.direction.view(complex)[:, 0].copy()
        for one in {one.contact: one for one in passing}.values():
            foot = complex(
                kick.pose.position[one.bodies[0]] + one.foot * kick.pose.rotation[one.bodies[0]]
            )
            own = int(contacts.bodies[one.contact, 0] != one.bodies[0])
            at_end = (one.leaves, one.leaves and one.extra_distance is not None)
            if one.leaves and self._sharp[list(one.bodies)].all():
                normal, at_end = self._entered(kick, one, foot, motion), (True, False)
                if not normal:
                    continue
                direction[one.contact] = normal if own else -normal
            rows.append(one.contact)
            feet.append(foot + kick.joints.origin)
            ends.append(at_end[::-1] if own else at_end)
        found = Contacts._make(field[rows] for field in contacts)
        points = found.points.copy()
        points[:, 0] = np.array(feet, dtype=complex).view(float).reshape(-1, 2)
        found = found._replace(
            direction=direction[rows].view(float).reshape(-1, 2),
            touches=np.ones(len(rows), dtype=np.intp),
            points=points,
        )
        return found, np.array(ends, dtype=bool).reshape(-1, 2).T

    def _entered(self, kick: Kick, one: EndCrossing, foot: complex, motion: Array) -> complex:
        """Return the normal of the side of the other body that the end of a side comes onto.

        0 if it moves away from all its sides.
        """
        position, rotation = kick.pose.position, kick.pose.rotation
        velocity, spin = translations(motion), angles(motion)
        owner, other = (
            velocity[body] + 1j * spin[body] * (foot - position[body]) for body in one.bodies
        )
        body = one.bodies[1]
        relative_path = (owner - other) / rotation[body]
        sides = self._sides.at(body, complex((foot - position[body]) / rotation[body]))
        speeds = [
            (dot(1j * direction * normal, relative_path), normal) for normal, _, direction in sides
        ]
        fastest, normal = max(speeds, key=lambda found: found[0], default=(0.0, 0j))
        return complex(normal * rotation[body]) if fastest > 0 else 0j

    def _all(self, kick: Kick, ahead: float) -> Iterator[EndCrossing]:
        """Yield the contacts that may pass an end in a drift, given a bound of their path [m]."""
        touching = kick.layout.touching
        self._touching, self._last_positions, self._clearance = touching, kick.pose.values, inf
        corners = np.count_nonzero(self._sides.any[touching.bodies].all(axis=0))
        self._tips = _tips(kick) if corners else None
        if not len(touching.pair):
            return
        yield from self._leaving(kick, ahead)
        on = {(one.point, one.curve) for one in kick.features.curved}
        for one, tip in self._without_side(kick):
            yield from self._coming(kick, ahead, one, tip)
            line = self._lines.get(one.bodies[0])
            if line and ((one.gap, one.bodies[0]) in on or line.has_center(tip)):
                yield from self._line_exits(kick, ahead, one, line)

    def _leaving(self, kick: Kick, ahead: float) -> Iterator[EndCrossing]:
        """Yield the contacts that may leave a side in a drift; see `_all`."""
        lying, sides = PointsOnSides.at(kick, self._sides), self._sides
        for direction, ends, until in ((-1, sides.begin, lying.begin), (1, sides.end, lying.end)):
            left = lying.distance_left(direction)
            self._note(float(left.min()))
            for gap in np.flatnonzero((left > -NEAR) & (left < ahead)).tolist():
                own, number = int(lying.side[gap]), int(lying.number[gap])
                if not (lying.flat[gap] or self._is_tip(int(lying.other[gap]), lying.point[gap])):
                    continue
                normal, end = complex(sides.normal[own, number]), float(ends[own, number])
                yield EndCrossing(
                    int(kick.layout.touching.pair[gap]),
                    gap,
                    (own, int(lying.other[gap])),
                    complex(sides.height[own, number], end) * normal,
                    1j * direction * normal,
                    complex(lying.point[gap]),
                    leaves=True,
                    extra_distance=direction * (float(until[gap]) - end)
                    if lying.flat[gap]
                    else None,
                )

    def _is_tip(self, body: int, point: complex) -> bool:
        """Return whether a body touches there with a corner, an end, or as a round one.

        Else the point is on a side of it, across an end of the other body's side.
        """
        return not self._sides.any[body] or any(self._sides.at(body, complex(point)))

    def _without_side(self, kick: Kick) -> Iterator[tuple[EndCrossing, complex]]:
        """Yield the contacts without a straight side, twice: as if each of the bodies had it.

        The end that they pass is still to be set. Also the point of that body, along its axes [m].
        """
        touching, points = kick.layout.touching, kick.features.points
        on = kick.features.is_owner[:, : len(touching.pair)].any(axis=0)
        for gap in np.flatnonzero(~on & self._ends[touching.bodies].any(axis=0)).tolist():
            bodies, tips = touching.bodies[:, gap].tolist(), points[:, gap].tolist()
            for (own, tip), (other, point) in permutations(zip(bodies, tips, strict=True)):
                pair = int(touching.pair[gap])
                yield EndCrossing(pair, gap, (own, other), 0j, 0j, point, leaves=False), tip

    def _coming(
        self, kick: Kick, ahead: float, passing: EndCrossing, tip: complex
    ) -> Iterator[EndCrossing]:
        """Yield a contact of a corner for each side that it may come onto; see `_all`."""
        for normal, foot, direction in self._sides.at(passing.bodies[0], tip):
            one = passing._replace(foot=foot, direction=1j * direction * normal)
            left = one.distance_left(kick.pose)
            self._note(left)
            if -NEAR < left < ahead and dot(one.point_on_side(kick.pose) - foot, normal) > 0:
                yield one

    def _line_exits(
        self, kick: Kick, ahead: float, passing: EndCrossing, line: Line
    ) -> Iterator[EndCrossing]:
        """Yield a contact for each end of an arc or a curve at which it may leave; see `_all`."""
        for end, direction in line.ends:
            one = passing._replace(foot=end, direction=direction, leaves=True)
            left, offset = one.distance_left(kick.pose), one.point_on_side(kick.pose) - end
            self._note(abs(left))
            out = 1j * direction if dot(offset, 1j * direction) > 0 else -1j * direction
            bend = dot(offset, out) - line.half - self._radius[one.bodies[1]]
            if abs(bend) - NEAR < left < ahead:  # it is not on another stretch
                yield one._replace(foot=end + out * line.half)

    def _note(self, left: float) -> None:
        """Note how far a point is from passing [m]."""
        self._clearance = max(0.0, min(self._clearance, left))


def _comes_down(kick: Kick, one: EndCrossing, end: Coordinates) -> bool:
    """Return whether a disc that turns about a corner overlaps the next side at some positions."""
    if one.leaves:
        return False
    depth = float(kick.contacts.depths.take(kick.layout.touching.number)[one.gap])
    reach = abs(kick.features.offset[one.gap]) + depth
    return abs(dot(one.point_on_side(end) - one.foot, 1j * one.direction)) < reach


def _tips(kick: Kick) -> Complexes:
    """Return the contact points of the bodies opposite to sides, along their axes: (k,) [m]."""
    touching, features = kick.layout.touching, kick.features
    count = len(touching.pair)
    first, second = features.points[:, :count]
    return np.where(features.side[:count] == touching.bodies[0], second, first)
