"""Contacts on curves, as functions of the bodies' positions.

With P the middle of what is round, or a corner, F the foot of P on the curve, t and κ the tangent
and the curvature there, and d the distance from F to P, all along the axes of the curve's body:

    V = d    dV = n · dP    S = −h ∫ (1 − κ δ0) ds    dS = i n · dP (1 − κ δ0) / (1 − κ δ)

h is 1 where P is on the left of the curve and −1 on the right, n = h i t, and δ = h d. S is how far
P has gone along the line that is parallel to the curve through where it was.
"""

from cmath import phase
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.outlines import Figures
from sandbox.physics.engine.batch import Booleans, Integers
from sandbox.physics.geometry.distance import dot
from sandbox.physics.geometry.plane_curve import Course, Foot
from sandbox.physics.state.anchor import Plane

FLAT = 1e-4
"""1/m, the curvature of a curve below which a straight side touches it with its ends alone."""


class Followed(NamedTuple):
    """A contact on a curve, somewhere.

    Attributes
    ----------
    gap, slip
        V and S above [m].
    normal
        n, from the curve on, along the axes of its body.
    share
        (1 − κ δ0) / (1 − κ δ).
    """

    gap: float
    slip: float
    normal: complex
    share: float


@dataclass(frozen=True, slots=True)
class Curved:
    """A point that touches a curve.

    Attributes
    ----------
    point
        Which of the points that touch.
    curve, other
        The bodies.
    sign
        1 if the curve is the first of the two, else −1.
    course, foot
        Of the curve, and where on it the drift begins.
    hand
        h above.
    start
        δ0 above [m].
    radius
        Of what is round, or of the corner [m].
    """

    point: int
    curve: int
    other: int
    sign: int
    course: Course
    foot: Foot
    hand: int
    start: float
    radius: float

    def look(self, place: complex) -> Followed:
        """Return the contact where P is at a place, along the axes of the curve's body."""
        first, foot = self.foot, self.course.follow(place, self.foot.at)
        left = 1j * foot.tangent
        apart = dot(place - foot.point, left)
        turned = phase(foot.tangent / first.tangent)
        way = self.course.length(first.at, foot.at) - self.start * turned
        share = (1 - foot.bend * self.start) / (1 - foot.bend * apart)
        return Followed(self.hand * apart, -self.hand * way, self.hand * left, share)

    @property
    def center(self) -> complex:
        """The centre of the circle that is closest to the curve there, along its axes [m]."""
        return self.foot.point + 1j * self.foot.tangent / self.foot.bend

    @property
    def arched(self) -> bool:
        """Whether a straight side can touch the curve there beside its ends."""
        return self.hand * self.foot.bend < -FLAT


def on_curves(
    figures: Figures,
    bodies: Integers,
    normal: Plane,
    points: Plane,
    placed: tuple[Plane, Plane],
) -> Iterator[Curved]:
    """Yield the points that touch curves beside them; at an end a curve is a disc.

    Parameters
    ----------
    figures
        The outlines of the bodies.
    bodies
        The two of each point, (2, k).
    normal
        (k,), from the first to the second.
    points
        Where they touch, on the first and on the second, (2, k) [m].
    placed
        Where all bodies are, and how they are turned, (n,) each.
    """
    pairs = bodies.T.tolist() if figures.courses else ()
    for point, (a, b) in enumerate(pairs):
        for curve, other, sign in ((a, b, 1), (b, a, -1)):
            if course := figures.courses.get(curve):
                out = complex(normal[point]) * sign
                on_curve, place = (complex(side[point]) for side in points[::sign])
                if radius := figures.radius[other]:
                    place = complex(placed[0][other])
                else:
                    radius = figures.rounding[other]
                    place += out * radius
                where, turned = (complex(values[curve]) for values in placed)
                near, at = course.foot((on_curve - where) / turned), (place - where) / turned
                if near:
                    foot = course.follow(at, near.at)
                    left = 1j * foot.tangent
                    hand = 1 if dot(out / turned, left) >= 0 else -1
                    start = dot(at - foot.point, left)
                    yield Curved(point, curve, other, sign, course, foot, hand, start, radius)


def follow_curves(
    curved: Sequence[Curved],
    placed: tuple[Plane, Plane],
    arms: Plane,
    rows: tuple[Array, Array, Plane, Plane],
) -> None:
    """Put in what points on curves are.

    Parameters
    ----------
    curved
        The points.
    placed
        Where all bodies are, and how they are turned, (n,) each.
    arms
        From the two bodies of each point to where they touch, (2, k) [m].
    rows
        The gaps and slips, and how they change with d, (k,) each.
    """
    gap, slip, along, across = rows
    for one in curved:
        where, turned = placed[0], complex(placed[1][one.curve])
        own, other = arms[:: one.sign]
        way = complex(where[one.other] + other[one.point] - where[one.curve])
        found = one.look(way / turned)
        gap[one.point], slip[one.point] = found.gap, found.slip
        along[one.point] = one.sign * found.normal * turned
        across[one.point] = 1j * along[one.point] * found.share
        own[one.point] = way


def roll_on_curves(
    curved: Sequence[Curved], faces: Booleans, rubs: Integers, figures: Figures, rolls: Array
) -> None:
    """Put in by which radii the angles of bodies count in the slip on curves.

    Parameters
    ----------
    curved
        The points on curves.
    faces
        (k,), whether it is a straight side that touches there.
    rubs
        (f,), which points slips are of.
    figures
        The outlines of the bodies.
    rolls
        The radii of the first bodies and the second ones, (2, f) [m].
    """
    for one in curved:
        slip = rubs == one.point
        radius = one.radius
        if faces[one.point]:
            radius = -1 / abs(one.foot.bend) - figures.rounding[one.curve]
        own, other = rolls[:: one.sign]
        own[slip], other[slip] = radius, -radius
