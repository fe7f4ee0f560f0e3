"""What touches what, as functions of where the bodies are.

A contact is a corner on a side, a disc on a side, or two round things on each other. For each there
is a gap V, which must not shrink, and a way S that its surfaces have slipped, both *of the places*:
kept through the next drift they hold to second order on curved paths, as the joints do (see
`exact.solver`). The velocities of the contact points, taken where the drift begins, would leave it
by h v² / 2R a step.

With A and B the points of the two bodies, d = B − A, and n from the first body to the second, in
the complex plane:

    on a side     V = Re(n̄ d)     S = Re((i n)̄ d) + a θ_a + b θ_b    n turns with the side's body
    round         V = s |d|        S = s |d| φ + a θ_a + b θ_b         φ is how far d has turned

A, B are centres of what is round, and s = −1 where one is inside the other. The angles count by the
radii that roll. Of curves see `curved`; a side touches one as the circle that is closest there.
"""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.anchor import Plane
from sandbox.physics.batch import Booleans, Contacts, Integers
from sandbox.physics.contacts.curved import Curved, follow_curves, on_curves, roll_on_curves
from sandbox.physics.course import Course
from sandbox.physics.exact.equations import Coordinates, Rows, angles, planes

PARALLEL = 1e-6
"""rad, by which a side and a contact may differ in direction and the contact be on that side."""


class Figure(NamedTuple):
    """What the outline of a body is to its contacts.

    Attributes
    ----------
    radius
        Of what is round, where it is touched from outside; 0 of what has sides [m].
    normals
        The unit normals of its sides, along its axes.
    rounding
        The radius of its corners, or ends [m].
    inner
        Of what is hollow, where it is touched from inside [m].
    center
        Of what is round, along its axes [m].
    ends
        Whether what is round is not so all the way.
    course
        Of what is a curve, or None.
    """

    radius: float
    normals: Plane
    rounding: float
    inner: float = 0.0
    center: complex = 0j
    ends: bool = False
    course: Course | None = None


class Figures:
    """The outlines of n bodies, as tables.

    Attributes
    ----------
    radius, rounding, inner, center
        (n,) each, as of a `Figure` [m].
    ends
        (n,), whether it is round, but not all the way.
    courses
        Of those that are curves, by their numbers.
    """

    def __init__(self, figures: list[Figure]) -> None:
        self.radius = np.array([figure.radius for figure in figures])
        self.rounding = np.array([figure.rounding for figure in figures])
        self.inner = np.array([figure.inner for figure in figures])
        self.center = np.array([figure.center for figure in figures])
        self.ends = np.array([figure.ends for figure in figures], dtype=bool)
        self.courses = {row: f.course for row, f in enumerate(figures) if f.course}
        most = max((len(figure.normals) for figure in figures), default=0)
        self._normals = np.full((len(figures), max(most, 1)), np.nan, dtype=complex)
        for row, figure in enumerate(figures):
            self._normals[row, : len(figure.normals)] = figure.normals

    def faces(self, body: Integers, direction: Plane) -> Booleans:
        """Return whether bodies have a side that faces there, along their own axes: (k,)."""
        off = np.abs(self._normals[body] - direction[:, None])
        return np.asarray((off < PARALLEL).any(axis=1))


class Touching(NamedTuple):
    """Which points of which bodies touch; k points, f of them stand for the friction of a contact.

    Attributes
    ----------
    a, b
        (k,), the bodies.
    pair, point
        (k,), the contact each belongs to, and which of its two points it is.
    rubs
        (f,), those with friction: the two points of a side share that of the first.
    """

    a: Integers
    b: Integers
    pair: Integers
    point: Integers
    rubs: Integers


@dataclass(frozen=True, slots=True)
class Features:
    """The points at which bodies touch, of N bodies with the plane.

    Attributes
    ----------
    touching
        Which.
    points
        A and B above, (k,) each, along their bodies' axes [m].
    normal
        (k,), n above, along the axes of the body whose side it is; of round things, in the plane.
    owns
        Whether it is the first body's, or the second's, (k,) each: 0 or 1.
    sign
        (k,), s above.
    rolls
        a and b above, (f,) each [m].
    apart
        (k,), d where the drift begins [m].
    curved
        The points on curves; their places among the first ones are those of the closest circles.
    """

    touching: Touching
    points: tuple[Plane, Plane]
    normal: Plane
    owns: tuple[Array, Array]
    sign: Array
    rolls: tuple[Array, Array]
    apart: Plane
    curved: tuple[Curved, ...] = ()

    def look(self, place: Coordinates) -> Rows:
        """Return the gaps and the ways slipped, and their gradients: (k + f) and (k + f, 3 N)."""
        a, b, rubs = self.touching.a, self.touching.b, self.touching.rubs
        where, turned = place.plane, np.exp(1j * place.angle)
        arm_a, arm_b = self.points[0] * turned[a], self.points[1] * turned[b]
        d = where[b] + arm_b - where[a] - arm_a
        (own_a, own_b), side = self.owns, self.owns[0] + self.owns[1]
        size = np.abs(d)
        round_ = side == 0
        along = self.normal * (own_a * turned[a] + own_b * turned[b])
        gap = (along.conj() * d).real
        off = (along.conj() * d).imag  # how far it has slipped along a side
        if round_.any():
            along = np.where(round_, self.sign * d / size, along)
            gap = np.where(round_, self.sign * size, gap)
            turn = np.angle(d / np.where(round_, self.apart, d))
            first = np.abs(self.apart)
            off = np.where(round_, self.sign * first * turn, off)
            across = 1j * along * np.where(round_, first / size, 1.0)
        else:
            across = 1j * along
        follow_curves(self.curved, (where, turned), (arm_a, arm_b), (gap, off, along, across))
        angle = place.angle
        roll_a, roll_b = self.rolls
        slip = off[rubs] + roll_a * angle[a[rubs]] + roll_b * angle[b[rubs]]
        turns = side * off, -side[rubs] * gap[rubs]
        way = np.concatenate((along, across[rubs]))
        rows = np.arange(len(way))
        gradient = np.zeros((len(way), len(place.values)))
        in_plane, in_angle = planes(gradient), angles(gradient)
        for body, arm, own, roll, sign in (
            (a, arm_a, own_a, roll_a, -1.0),
            (b, arm_b, own_b, roll_b, 1.0),
        ):
            bodies, arms = np.concatenate((body, body[rubs])), np.concatenate((arm, arm[rubs]))
            in_plane[rows, bodies] = sign * way
            extra = np.concatenate((own * turns[0], own[rubs] * turns[1] + roll))
            in_angle[rows, bodies] = sign * (way * arms.conj()).imag + extra
        return Rows(np.concatenate((gap, slip)), gradient)

    def moved(self, place: Coordinates) -> "Features":
        """Return the same where the drift begins elsewhere."""
        a, b = self.touching.a, self.touching.b
        where, turned = place.plane, np.exp(1j * place.angle)
        d = where[b] + self.points[1] * turned[b] - where[a] - self.points[0] * turned[a]
        return replace(self, apart=d)


def features(
    contacts: Contacts,
    touching: Touching,
    figures: Figures,
    place: Coordinates,
    moves: Booleans,
    origin: complex,
) -> Features:
    """Return what the contacts of a step are between.

    Parameters
    ----------
    contacts, touching
        Of the step.
    figures
        The outlines of the bodies.
    place
        Where they are.
    moves
        (n,), which of them are dynamic: of two sides that face each other, that of the other one
        counts.
    origin
        From where places are counted [m].
    """
    a, b, pair, point, rubs = touching
    n = contacts.direction.view(complex)[pair, 0]
    middle = np.ascontiguousarray(contacts.points).view(complex)[pair, point, 0] - origin
    half = n * (contacts.depths[pair, point] / 2)
    where, turned = place.plane, np.exp(1j * place.angle)
    round_a, center_a = _round(figures, a, place, n, middle)
    round_b, center_b = _round(figures, b, place, n, middle)
    faces_a = figures.faces(a, n * turned[a].conj())
    faces_b = figures.faces(b, -n * turned[b].conj())
    own_a = faces_a & ~(faces_b & moves[a] & ~moves[b])
    own_b = faces_b & ~own_a
    surfaces = middle + half, middle - half
    curved = tuple(on_curves(figures, (a, b), n, surfaces, (where, turned)))
    for one in curved:
        center_of, is_round = ((center_a, round_a), (center_b, round_b))[one.sign < 0]
        center_of[one.point] = where[one.curve] + turned[one.curve] * one.center
        is_round[one.point] = True
        (own_b if one.sign > 0 else own_a)[one.point] &= one.arched
    corner = ~(own_a | own_b)
    core_a = surfaces[0] - n * np.where(corner, figures.rounding[a], 0.0)
    core_b = surfaces[1] + n * np.where(corner, figures.rounding[b], 0.0)
    at_a, at_b = np.where(round_a, center_a, core_a), np.where(round_b, center_b, core_b)
    d = at_b - at_a
    within = corner & ((d.conj() * n).real < 0)
    inner_a, inner_b = within & (figures.inner[a] > 0), within & (figures.inner[b] > 0)
    inner_b &= ~inner_a | (figures.inner[b] > figures.inner[a])
    inner_a &= ~inner_b
    turns = np.where(own_a, turned[a], np.where(own_b, turned[b], 1.0))
    rolls = _rolls(
        _radii(figures, a, round_a, corner, inner_a)[rubs],
        _radii(figures, b, round_b, corner, inner_b)[rubs],
        own_a[rubs],
        corner[rubs],
        (inner_a[rubs], inner_b[rubs]),
    )
    roll_on_curves(curved, ~corner, rubs, figures, rolls)
    return Features(
        touching=touching,
        points=((at_a - where[a]) * turned[a].conj(), (at_b - where[b]) * turned[b].conj()),
        normal=n * turns.conj(),
        owns=(own_a.astype(float), own_b.astype(float)),
        sign=np.where(within, -1.0, 1.0),
        rolls=rolls,
        apart=d,
        curved=tuple(one for one in curved if corner[one.point]),
    )


def _round(
    figures: Figures, body: Integers, place: Coordinates, n: Plane, middle: Plane
) -> tuple[Booleans, Plane]:
    """Return whether bodies are round where they touch, (k,), and where their centres are, (k,)."""
    center = place.plane[body] + figures.center[body] * np.exp(1j * place.angle[body])
    is_round: Booleans = figures.radius[body] > 0
    if figures.ends[body].any():
        out = middle - center
        is_end = np.abs((n.conj() * out).imag) > PARALLEL * np.abs(out)
        is_round = is_round & ~(figures.ends[body] & is_end)
    return is_round, center


def _radii(
    figures: Figures, body: Integers, is_round: Booleans, corner: Booleans, within: Booleans
) -> Array:
    """Return the radii with which bodies roll where they touch: (k,) [m]."""
    round_ = np.where(within, figures.inner[body], figures.radius[body])
    return np.where(is_round, round_, np.where(corner, figures.rounding[body], 0.0))


def _rolls(
    ra: Array,
    rb: Array,
    first: Booleans,
    corner: Booleans,
    within: tuple[Booleans, Booleans],
) -> tuple[Array, Array]:
    """Return by which radii the angles of the two bodies count in the slip: (f,) each.

    Parameters
    ----------
    ra, rb
        (f,), their radii; 0 of what has sides [m].
    first
        (f,), whether the side is the first body's.
    corner
        (f,), whether there is no side.
    within
        Whether the first is touched from inside, and whether the second is, (f,) each.
    """
    a = np.where(corner, np.where(within[0], ra, -ra), np.where(first, rb, -ra))
    b = np.where(corner, np.where(within[1], rb, -rb), np.where(first, -rb, ra))
    return a, b
