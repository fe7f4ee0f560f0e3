"""What touches what, as functions of where the bodies are.

A contact is a corner on a side, a disc on a side, or two round things on each other. For each there
is a gap V, which must not shrink, and a way S that its surfaces have slipped, both *of the places*:
kept through the next drift they hold to second order on curved paths, as the joints do (see
`shake`). The velocities of the contact points, taken where the drift begins, would leave it
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
from sandbox.physics.contacts.direct.curved import Curved, follow_curves, on_curves, roll_on_curves
from sandbox.physics.contacts.direct.outlines import Figures, Outlines
from sandbox.physics.engine.batch import Booleans, Contacts, Integers
from sandbox.physics.joints.exact.constraints import Coordinates, Rows, angles, planes
from sandbox.physics.state.anchor import Plane


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
    figures
        The outlines of all bodies.
    outlines
        Of the first bodies, and of the second.
    all_a, all_b
        (k + f,), the bodies of the gaps, then those of the friction.
    yields
        (k,), whether the first body moves and the second does not: of two sides that face each
        other, that of the second counts.
    """

    a: Integers
    b: Integers
    pair: Integers
    point: Integers
    rubs: Integers
    figures: Figures
    outlines: tuple[Outlines, Outlines]
    all_a: Integers
    all_b: Integers
    yields: Booleans


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
        turned = np.exp(1j * place.angle)
        turned_a, turned_b = turned[a], turned[b]
        arms = self.points[0] * turned_a, self.points[1] * turned_b
        d = place.plane[b] + arms[1] - place.plane[a] - arms[0]
        own_a, own_b = self.owns
        along = self.normal * (own_a * turned_a + own_b * turned_b)
        across, beside = 1j * along, along.conj() * d
        gap, off = beside.real, beside.imag  # how far it has slipped along a side
        side = own_a + own_b
        if not side.all():
            along, across, gap, off = self._of_round(d, side == 0, along, gap, off)
        follow_curves(self.curved, (place.plane, turned), arms, (gap, off, along, across))
        angle = place.angle
        roll_a, roll_b = self.rolls
        slip = off[rubs] + roll_a * angle[a[rubs]] + roll_b * angle[b[rubs]]
        turns = np.concatenate((side * off, -side[rubs] * gap[rubs]))
        way = np.concatenate((along, across[rubs]))
        rows, none = np.arange(len(way)), np.zeros(len(gap))
        gradient = np.zeros((len(way), len(place.values)))
        in_plane, in_angle = planes(gradient), angles(gradient)
        for bodies, arm, own, roll, sign in (
            (self.touching.all_a, arms[0], own_a, roll_a, -1.0),
            (self.touching.all_b, arms[1], own_b, roll_b, 1.0),
        ):
            arm_, own_ = np.concatenate((arm, arm[rubs])), np.concatenate((own, own[rubs]))
            in_plane[rows, bodies] = sign * way
            extra = own_ * turns + np.concatenate((none, roll))
            in_angle[rows, bodies] = sign * (way * arm_.conj()).imag + extra
        return Rows(np.concatenate((gap, slip)), gradient)

    def _of_round(
        self, d: Plane, is_round: Booleans, along: Plane, gap: Array, off: Array
    ) -> tuple[Plane, Plane, Array, Array]:
        """Return which way lies along a gap, and across, its size, and how far it has slipped.

        The same as on a side, where nothing is round: (k,) each.
        """
        size, first = np.abs(d), np.abs(self.apart)
        along = np.where(is_round, self.sign * d / size, along)
        gap = np.where(is_round, self.sign * size, gap)
        turn = np.angle(d / np.where(is_round, self.apart, d))
        off = np.where(is_round, self.sign * first * turn, off)
        return along, 1j * along * np.where(is_round, first / size, 1.0), gap, off

    def moved(self, place: Coordinates) -> "Features":
        """Return the same where the drift begins elsewhere."""
        a, b = self.touching.a, self.touching.b
        where, turned = place.plane, np.exp(1j * place.angle)
        d = where[b] + self.points[1] * turned[b] - where[a] - self.points[0] * turned[a]
        return replace(self, apart=d)


def features(
    contacts: Contacts, touching: Touching, place: Coordinates, origin: complex
) -> Features:
    """Return what the contacts of a step are between.

    Parameters
    ----------
    contacts, touching
        Of the step.
    place
        Where the bodies are.
    origin
        From where places are counted [m].
    """
    a, b, pair, point, rubs, figures, (first, second), _, _, yields = touching
    n = contacts.direction.view(complex)[pair, 0]
    middle = np.ascontiguousarray(contacts.points).view(complex)[pair, point, 0] - origin
    half = n * (contacts.depths[pair, point] / 2)
    turned = np.exp(1j * place.angle)
    where_a, where_b, turned_a, turned_b = place.plane[a], place.plane[b], turned[a], turned[b]
    round_a, center_a = first.round(place, n, middle)
    round_b, center_b = second.round(place, n, middle)
    faces_b = second.faces(-n * turned_b.conj())
    own_a = first.faces(n * turned_a.conj()) & ~(faces_b & yields)
    own_b = faces_b & ~own_a
    surfaces = middle + half, middle - half
    curved = tuple(on_curves(figures, (a, b), n, surfaces, (place.plane, turned)))
    for one in curved:
        center_of, is_round = ((center_a, round_a), (center_b, round_b))[one.sign < 0]
        center_of[one.point] = place.plane[one.curve] + turned[one.curve] * one.center
        is_round[one.point] = True
        (own_b if one.sign > 0 else own_a)[one.point] &= one.arched
    corner = ~(own_a | own_b)
    core_a = surfaces[0] - n * np.where(corner, first.rounding, 0.0)
    core_b = surfaces[1] + n * np.where(corner, second.rounding, 0.0)
    at_a, at_b = np.where(round_a, center_a, core_a), np.where(round_b, center_b, core_b)
    d = at_b - at_a
    within = corner & ((d.conj() * n).real < 0)
    inner_a, inner_b = within & (first.inner > 0), within & (second.inner > 0)
    inner_b &= ~inner_a | (second.inner > first.inner)
    inner_a &= ~inner_b
    turns = np.where(own_a, turned_a, np.where(own_b, turned_b, 1.0))
    rolls = _rolls(
        first.rolls(round_a, corner, inner_a)[rubs],
        second.rolls(round_b, corner, inner_b)[rubs],
        own_a[rubs],
        corner[rubs],
        (inner_a[rubs], inner_b[rubs]),
    )
    roll_on_curves(curved, ~corner, rubs, figures, rolls)
    return Features(
        touching=touching,
        points=((at_a - where_a) * turned_a.conj(), (at_b - where_b) * turned_b.conj()),
        normal=n * turns.conj(),
        owns=(own_a.astype(float), own_b.astype(float)),
        sign=np.where(within, -1.0, 1.0),
        rolls=rolls,
        apart=d,
        curved=tuple(one for one in curved if corner[one.point]),
    )


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
