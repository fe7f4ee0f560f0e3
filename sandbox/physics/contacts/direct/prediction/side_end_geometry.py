"""Contacts that pass the end of a side, and the geometry that finds them."""

from cmath import rect
from collections.abc import Sequence
from math import acos, inf
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.prediction.convex_parts import Pair
from sandbox.physics.contacts.direct.prediction.straight_side_tables import NEAR, Sides
from sandbox.physics.contacts.direct.rows.kick_system import Kick
from sandbox.physics.engine.space_arrays import Booleans, Integers
from sandbox.physics.geometry.arc_contacts import Piece
from sandbox.physics.geometry.outline_distance import dot
from sandbox.physics.joints.exact.constraint_interface import Coordinates
from sandbox.physics.state.joint_anchors import Complexes


class EndCrossing(NamedTuple):
    """A contact that leaves a side, an arc or a curve at its end, or comes onto a side there.

    `contact` and `gap` are the indices of the contact and of its point; `bodies` are the body with
    the side, and the other one. `foot` is the end of the side [m], and `direction` the direction in
    which the contact passes it, both along the axes of its body; `point` is the point of the other
    body that passes, along its axes [m]. `leaves` tells whether it leaves the side.
    `extra_distance` is how far beyond the end the point has to go, since a side of the other body
    lies on it [m]; None if none does.
    """

    contact: int
    gap: int
    bodies: Pair
    foot: complex
    direction: complex
    point: complex
    leaves: bool
    extra_distance: float | None = None

    def distance_left(self, pose: Coordinates) -> float:
        """Return how far it still has to go, with the bodies at some positions [m]."""
        return dot(self.foot - self.point_on_side(pose), self.direction) + (
            self.extra_distance or 0.0
        )

    def point_on_side(self, pose: Coordinates) -> complex:
        """Return the point that passes, along the axes of the body with the side [m]."""
        own, other = self.bodies
        offset = pose.position[other] + self.point * pose.rotation[other] - pose.position[own]
        return complex(offset / pose.rotation[own])


class PointsOnSides(NamedTuple):
    """The points of a kick, of which some are on sides; k of them.

    `side` and `other`, (k,), are the bodies with the sides, and the others; `number`, (k,), tells
    which of its sides it is, −1 if none. `point`, (k,), is the point of the other body, along its
    axes, and `along_side`, (k,), the position of that along the side; `begin` and `end`, (k,), are
    the positions there between which they touch [m]. `flat`, (k,), tells whether a side of the
    other body lies on it.
    """

    side: Integers
    other: Integers
    number: Integers
    point: Complexes
    along_side: Array
    begin: Array
    end: Array
    flat: Booleans

    @classmethod
    def at(cls, kick: Kick, sides: Sides) -> "PointsOnSides":
        """Return the points of a kick."""
        features, rotation, position = kick.features, kick.pose.rotation, kick.pose.position
        bodies, each = kick.layout.touching.bodies, np.arange(len(kick.layout.touching.pair))
        own = np.where(features.side[each] == bodies[0], 0, 1)
        side, other = bodies[own, each], bodies[1 - own, each]
        point = features.points[1 - own, each]
        out = features.normal[each] * (1 - 2 * own)
        on, _ = sides.facing(side, out, features.points[own, each])
        lies, along = sides.facing(other, -out * rotation[side] / rotation[other], point)
        offset = (position[other] + point * rotation[other] - position[side]) / rotation[side]
        seen = (offset * out.conj()).imag
        before = np.where(lies, along[:, None] - sides.begin[other], 0.0).max(axis=1)
        after = np.where(lies, sides.end[other] - along[:, None], 0.0).max(axis=1)
        begin, end = sides.begin[side] - before[:, None], sides.end[side] + after[:, None]
        within = np.where(on, np.minimum(seen[:, None] - begin, end - seen[:, None]), -inf)
        number = within.argmax(axis=1)
        begin, end = begin[each, number], end[each, number]
        owned = features.is_owner[:, each].any(axis=0)  # else an end touches, beside its side
        number[~(owned & on.any(axis=1))] = -1
        return cls(side, other, number, point, seen, begin, end, np.asarray(lies.any(axis=1)))

    def distance_left(self, way: int) -> Array:
        """Return how far each is from leaving its side in a direction, (k,); inf without one."""
        far = self.end - self.along_side if way > 0 else self.along_side - self.begin
        return np.where(self.number < 0, inf, far)


class Line(NamedTuple):
    """An arc or a curve with ends.

    `ends` are its two ends in the middle of its thickness, along the axes of its body [m], and the
    directions in which it would continue. `half` is half its thickness [m], and `center` the centre
    of an arc; None for a curve [m].
    """

    ends: Sequence[tuple[complex, complex]]
    half: float
    center: complex | None

    @classmethod
    def of(cls, piece: Piece) -> "Line | None":
        """Return an arc or a curve; None for other pieces, and for closed ones."""
        if piece.curve:
            feet = piece.curve.middle_line.ends
            ends = [(f.point, -f.tangent if f.parameter == 0 else f.tangent) for f in feet]
            return cls(ends, piece.curve.half, None) if ends else None
        arc = piece.arc
        if arc is None or arc.cosine < -1:
            return None
        outs = [(rect(1.0, sign * acos(arc.cosine)) * arc.middle, sign) for sign in (-1, 1)]
        ends = [(arc.center + arc.radius * out, sign * 1j * out) for out, sign in outs]
        return cls(ends, (arc.outer - arc.inner) / 2, arc.center)

    def has_center(self, point: complex) -> bool:
        """Return whether a point of contact stands for the whole arc, and not for its end."""
        return self.center is not None and abs(point - self.center) < NEAR
