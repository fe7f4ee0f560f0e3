"""Contacts on curves, as functions of the bodies' positions.

With P the centre of a disc, or a corner, F the foot of the perpendicular from P to the curve, t and
κ the tangent and the curvature there, and d the distance from F to P, all along the axes of the
curve's body:

    V = d    dV = n · dP    S = −h ∫ (1 − κ δ0) ds    dS = i n · dP (1 − κ δ0) / (1 − κ δ)

h is 1 where P is on the left of the curve and −1 on the right, n = h i t, and δ = h d. S is the
distance of P along the curve that is parallel through its first position.
"""

from cmath import phase
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.rows.contact_outlines import Figures
from sandbox.physics.engine.space_arrays import Booleans, Integers
from sandbox.physics.geometry.outline_distance import dot
from sandbox.physics.geometry.plane_curve import CurvePoint, MiddleLine
from sandbox.physics.state.joint_anchors import Complexes

ACROSS = 1e-7
"""m, how far beyond its end a curve still counts as touched from the side, and not at its end."""

FLAT = 1e-4
"""1/m, the curvature below which a straight side touches a curve only with its ends."""


class FollowedContact(NamedTuple):
    """A contact on a curve, at some position.

    `gap` and `slip` are V and S above [m], and `normal` is n, from the curve to P, along the axes
    of the curve's body. `fraction` is (1 − κ δ0) / (1 − κ δ).
    """

    gap: float
    slip: float
    normal: complex
    fraction: float


@dataclass(frozen=True, slots=True)
class CurveContact:
    """A contact point on a curve.

    `point` is the index of the contact point. `curve` and `other` are the bodies; `sign` is 1 if
    the curve is the first of the two, else −1. `middle_line` is the shape of the curve, and `foot`
    is F at the beginning of the drift; `hand` is h above, and `start` is δ0 [m]. `radius` is that
    of the disc, or of the corner [m].
    """

    point: int
    curve: int
    other: int
    sign: int
    middle_line: MiddleLine
    foot: CurvePoint
    hand: int
    start: float
    radius: float

    def evaluate(self, position: complex) -> FollowedContact:
        """Return the contact with P at a place, along the axes of the curve's body."""
        first, foot = self.foot, self.middle_line.foot_point_near(position, self.foot.parameter)
        left = 1j * foot.tangent
        apart = dot(position - foot.point, left)
        rotation = phase(foot.tangent / first.tangent)
        offset = self.middle_line.length(first.parameter, foot.parameter) - self.start * rotation
        fraction = (1 - foot.curvature * self.start) / (1 - foot.curvature * apart)
        return FollowedContact(self.hand * apart, -self.hand * offset, self.hand * left, fraction)

    @property
    def center(self) -> complex:
        """The centre of the osculating circle, along the axes of the curve's body [m]."""
        return self.foot.point + 1j * self.foot.tangent / self.foot.curvature

    @property
    def arched(self) -> bool:
        """Whether a straight side can touch the curve there, and not only with its ends."""
        return self.hand * self.foot.curvature < -FLAT


def on_curves(
    figures: Figures,
    bodies: Integers,
    normal: Complexes,
    points: Complexes,
    placed: tuple[Complexes, Complexes],
) -> Iterator[CurveContact]:
    """Yield the contact points on curves, but for their ends, which count as discs.

    `bodies`, (2, k), are the two bodies of each point, `normal`, (k,), is from the first to the
    second, and `points`, (2, k), are those on the first and on the second [m]. `placed` has the
    positions of all bodies, and their rotations as unit complex numbers, (n,) each.
    """
    pairs = bodies.T.tolist() if figures.middle_lines else ()
    for point, (a, b) in enumerate(pairs):
        for curve, other, sign in ((a, b, 1), (b, a, -1)):
            if middle_line := figures.middle_lines.get(curve):
                out = complex(normal[point]) * sign
                on_curve, position = (complex(side[point]) for side in points[::sign])
                if radius := figures.radius[other]:
                    position = complex(placed[0][other])
                else:
                    radius = figures.rounding[other]
                    position += out * radius
                where, rotation = (complex(values[curve]) for values in placed)
                touched, at = (on_curve - where) / rotation, (position - where) / rotation
                near = middle_line.foot_point(touched) or _end(
                    middle_line, touched, figures.rounding[curve]
                )
                if near:
                    foot = middle_line.foot_point_near(at, near.parameter)
                    left = 1j * foot.tangent
                    hand = 1 if dot(out / rotation, left) >= 0 else -1
                    start = dot(at - foot.point, left)
                    yield CurveContact(
                        point, curve, other, sign, middle_line, foot, hand, start, radius
                    )


def _end(middle_line: MiddleLine, point: complex, half: float) -> CurvePoint | None:
    """Return the end of a curve, half as thick, that a point is across; None if it is beyond."""
    for end in middle_line.ends:
        offset = point - end.point
        if abs(dot(offset, end.tangent)) < ACROSS and abs(offset) < half + ACROSS:
            return end
    return None


def follow_curves(
    curved: Sequence[CurveContact],
    placed: tuple[Complexes, Complexes],
    arms: Complexes,
    rows: tuple[Array, Array, Complexes, Complexes],
) -> None:
    """Set the rows of contact points on curves.

    For `placed` see `on_curves`. `arms`, (2, k), are the lever arms from the two bodies of each
    point to it [m]; `rows` are the gaps and slips, and their derivatives by d, (k,) each.
    """
    gap, slip, along, across = rows
    for one in curved:
        where, rotation = placed[0], complex(placed[1][one.curve])
        own, other = arms[:: one.sign]
        way = complex(where[one.other] + other[one.point] - where[one.curve])
        found = one.evaluate(way / rotation)
        gap[one.point], slip[one.point] = found.gap, found.slip
        along[one.point] = one.sign * found.normal * rotation
        across[one.point] = 1j * along[one.point] * found.fraction
        own[one.point] = way


def roll_on_curves(
    curved: Sequence[CurveContact],
    faces: Booleans,
    friction_points: Integers,
    figures: Figures,
    rolls: Array,
) -> None:
    """Set the radii by which the angles of bodies count in the slip on curves.

    `faces`, (k,), tells whether a straight side touches there, and `friction_points`, (f,), are the
    points with friction. `rolls`, (2, f), are the radii of the first bodies and the second ones
    [m].
    """
    for one in curved:
        slip = friction_points == one.point
        radius = one.radius
        if faces[one.point]:
            radius = -1 / abs(one.foot.curvature) - figures.rounding[one.curve]
        own, other = rolls[:: one.sign]
        own[slip], other[slip] = radius, -radius
