"""Contacts that close within a drift: they are solved in the kick before it.

Two touching bodies rotate relative to each other, so another corner meets its partner within the
drift. Found only at the end of the drift, it would overlap deeply, and the correction would lift
the bodies. So each kick is followed to the end of its drift. Corners that would overlap there, and
do not yet, get a row of their own: the gap may close but no further. Then the kick is solved again
(Stewart and Trinkle 1996; Anitescu and Potra 1997). This removes the part of the approach that
exceeds the gap; the impact at the next step removes the rest. Neither adds energy.

That is for corners that come down gently. Those that strike, and bodies that do not touch yet, are
located within the drift (see `drifts_with_landings`).
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.detection.contact_queries import (
    Query,
    ShapeContact,
    contacts_of,
    pairs_of,
)
from sandbox.physics.contacts.detection.time_of_impact import Hit, Path
from sandbox.physics.contacts.direct.prediction.approaching_hollow_shapes import (
    HollowCorner,
    HollowPairs,
    placed,
)
from sandbox.physics.contacts.direct.prediction.approaching_pairs import ApproachingPairs
from sandbox.physics.contacts.direct.prediction.convex_parts import ConvexParts, Pair, PlacedParts
from sandbox.physics.contacts.direct.prediction.corner_contacts import (
    LEAST,
    CornerOnSide,
    on_side,
    within,
)
from sandbox.physics.contacts.direct.prediction.support_ends import SupportEnds
from sandbox.physics.contacts.direct.rows.contact_properties import SLOP
from sandbox.physics.contacts.direct.rows.kick_system import Kick
from sandbox.physics.contacts.direct.rows.row_layout import Surfaces
from sandbox.physics.engine.space_arrays import NO_CONTACTS, Booleans, Contacts
from sandbox.physics.joints.exact.constraint_interface import (
    Coordinates,
    angles,
    coordinate_indices,
    translations,
)

LOOKS = 30
"""How often, at most, a drift is followed to its end: in a rocking stack each time finds one more
box."""

WIDE = 1e-3
"""Both ends of a side touch if its two points are further apart than this share of the smaller
body."""

LITTLE = 0.1
"""A rebound may be left out if it keeps less than this share of the energy."""

ALIKE = 0.99
"""Contacts at one point count as the same from this cosine between their directions on."""

LOST = 1e-4
"""m, the greatest depth of a corner that pymunk may lose: in the corner of a bin, just behind the
end of a wall."""

_BOTH = np.array([[0], [1]])
"""The two points of contacts."""


class Corner(NamedTuple):
    """A corner of one body that meets a side of another, which it already touches elsewhere.

    `pair` and `parts` are the bodies, and a part of each. `own` is the body with the side, 0 or 1;
    `side` and `corner` are their indices.
    """

    pair: Pair
    parts: Pair
    own: int
    side: int
    corner: int


AnyCorner = Corner | HollowCorner
"""A corner that meets a side, an arc or a curve."""


class SpeculativeContacts:
    """Finds the corners that meet a side within a drift; n bodies.

    `query` knows the bodies, and which of them pass through others; `surfaces` has their contact
    properties, and `movable`, (n,), tells which are dynamic. `approaching` finds the pairs of
    bodies that do not touch, but might; `ends` finds the contacts that pass the ends of sides.
    `dull`, (n, n), tells which pairs lose nearly all their energy in an impact.
    """

    def __init__(self, query: Query, surfaces: Surfaces, movable: Booleans) -> None:
        self._bodies, self._shapes = query.bodies, ConvexParts(query.bodies)
        shapes, self._hollows = self._shapes, HollowPairs(query.hollows, len(movable))
        looks = shapes.sided[:, None] & shapes.sided | self._hollows.pairs
        self._looks = looks & ((surfaces.restitution == 0) | surfaces.lands)
        self._looks &= movable[:, None] | movable
        self.dull: Booleans = surfaces.restitution**2 < LITTLE
        self._any = bool(self._looks.any())
        several = ~(shapes.single[:, None] & shapes.single)
        self._slides = several | self._hollows.pairs  # where corners may meet without any rotation
        self._asked: tuple[Kick, float, Array] | None = None  # the last question
        self._found: list[AnyCorner] = []  # its answer
        beside = several & ~self._looks
        self.approaching = ApproachingPairs(query, shapes, surfaces, movable, self._hollows, beside)
        self.ends = SupportEnds(shapes, surfaces, query.hollows, self._hollows.reach(shapes.reach))

    def corners(self, kick: Kick, motion: Array) -> list[AnyCorner]:
        """Return the corners that come down within the drift after a kick and are new to it.

        The last answer is kept, as the same corners are needed to close a drift and to look for
        landings in it. `motion`, (3 N,), are the velocities after the kick [m/s, rad/s].
        """
        if not self._any:
            return []
        drift = kick.joints.drift
        if self._asked:
            last, last_duration, moved = self._asked
            if last is kick and last_duration == drift and np.array_equal(moved, motion):
                return self._found
        self._asked, self._found = (kick, drift, motion), self._search(kick, motion, drift)
        return self._found

    def _search(self, kick: Kick, motion: Array, drift: float) -> list[AnyCorner]:
        """Return the corners that come down within so long a drift [s]; see `corners`."""
        turning = self._turning(kick.contacts, motion * drift)
        if not turning:
            return []
        ended = Coordinates(kick.pose.values + drift * motion)
        start, end = self._shapes.at(kick.pose), self._shapes.at(ended)
        found = [one for pair in turning for one in self._down(pair, start, end)]
        if not found:
            return []
        new = new_to(kick.contacts, self.contacts(found, kick.pose, kick.joints.origin)).tolist()
        return [corner for corner, is_new in zip(found, new, strict=True) if is_new]

    def _down(self, pair: Pair, here: PlacedParts, there: PlacedParts) -> Iterator[AnyCorner]:
        """Yield the corners of two bodies that come down between two placements.

        A side that has landed flat touches with one corner only. The other one is then as deep, up
        to the overlap that is left alone.
        """
        if self._hollows.pairs[pair]:
            yield from self._hollows.corners(pair, here.pose, there.pose)
            return
        for parts in self._shapes.close(pair, there):
            for down in within(there.both(pair, parts)):
                gap, end = (on_side(at.both(pair, parts), *down).gap for at in (here, there))
                if gap > -LOST and gap > end + LEAST:
                    yield Corner(pair, parts, *down)

    def ahead(self, kick: Kick, motion: Array, some: Booleans) -> Contacts:
        """Return contacts of some bodies, (n,), that meet in the drift after a kick, at its start.

        `motion`, (3 N,), has the velocities in that drift [m/s, rad/s].
        """
        drift, indices = kick.joints.drift, coordinate_indices(len(kick.pose.values) // 3 - 1)
        near = self.approaching.near(kick.contacts, kick.pose, drift * motion)
        near = [pair for pair in near if some[[*pair]].any()]
        path = Path(kick.pose.values[indices], motion[indices], np.zeros(indices.shape))
        hits = self.approaching.ahead(path, drift, near)
        corners = [one for one in self.corners(kick, motion) if some[[*one.pair]].any()]
        start, end = kick.pose, Coordinates(kick.pose.values + drift * motion)
        for pair in near:
            if self._hollows.pairs[pair]:
                corners += self._hollows.corners(pair, start, end)
        return self.contacts(corners, kick.pose, kick.joints.origin, hits)

    def height(self, corner: AnyCorner, pose: Coordinates) -> float:
        """Return the distance of a corner from its side at given positions [m]."""
        return self._spot(corner, pose).gap

    def contacts(
        self,
        corners: Sequence[AnyCorner],
        pose: Coordinates,
        origin: complex,
        hits: Sequence[Hit] = (),
    ) -> Contacts:
        """Return the contacts of corners and of bodies that have met, at given positions."""
        found: dict[Pair, list[ShapeContact]] = {}
        for corner in corners:
            touched = self._touched(corner.pair, self._spot(corner, pose), origin)
            found.setdefault(corner.pair, []).append(touched)
        for _, pair, normal, points, _, gap in hits:
            both = [(point + origin, point + origin + normal * gap) for point in points]
            touched = ShapeContact(self._bodies[pair[1]], normal, both, -gap)
            found.setdefault(pair, []).append(touched)
        return contacts_of(found) if found else NO_CONTACTS

    def _spot(self, corner: AnyCorner, pose: Coordinates) -> CornerOnSide:
        if isinstance(corner, HollowCorner):
            return CornerOnSide(corner.own, *corner.spot(placed(corner.pair, pose)))
        pair, parts, own, side, number = corner
        return on_side(self._shapes.at(pose).both(pair, parts), own, side, number)

    def _turning(self, contacts: Contacts, displacement: Array) -> list[Pair]:
        """Return the touching pairs that move far enough for another corner to meet.

        Two straight sides only meet one if they rotate. `displacement`, (3 N,), are those of
        the bodies in the drift [m, rad].
        """
        a, b = contacts.bodies.T
        reach, single, turns = self._shapes.reach, self._shapes.single, angles(displacement)
        turn = np.abs(turns[a] - turns[b])
        far = turn * np.minimum(reach[a], reach[b]) > LEAST
        slides = self._slides[a, b]
        if np.count_nonzero(slides):
            shift = translations(displacement)
            far |= slides & (np.abs(shift[a] - shift[b]) + turn > LEAST)
        if not np.count_nonzero(far):
            return []
        # where sides of equal height meet at a small angle, both points are at the same end
        apart = np.abs(np.diff(contacts.points, axis=1)[:, 0]).max(axis=1)
        wide = apart > WIDE * np.minimum(reach[a], reach[b])
        whole = (contacts.touches == 2) & wide & single[a] & single[b]
        turns = (far & self._looks[a, b] & ~whole).tolist()
        pairs = pairs_of(contacts)
        return sorted({pair for pair, looks in zip(pairs, turns, strict=True) if looks})

    def _touched(self, pair: Pair, spot: CornerOnSide, origin: complex) -> ShapeContact:
        """Return the contact of a corner with a side."""
        own, normal, gap = spot.own, spot.normal, spot.gap
        tip, foot = spot.tip + origin, spot.tip + origin - normal * gap
        points = (tip, foot) if own else (foot, tip)
        return ShapeContact(self._bodies[pair[1]], -normal if own else normal, [points], -gap)


def new_to(known: Contacts, found: Contacts) -> Booleans:
    """Return which of the contacts that were found, k, are not among those known: (k,).

    A rounded corner that rotates ends a little deeper than its row allowed, and is not new. In the
    corner of a bin it meets the wall where it touches the floor; that is new.
    """
    spots, pairs = np.nonzero(known.touches > _BOTH)
    far = np.abs(found.points[:, None, 0] - known.points[pairs, spots]).max(axis=2)
    bodies = np.sort(known.bodies[pairs], axis=1)
    near = far < np.maximum(SLOP, found.depth)[:, None]
    same = (np.sort(found.bodies, axis=1)[:, None] == bodies).all(axis=2) & near
    same &= np.abs(found.direction @ known.direction[pairs].T) > ALIKE
    return np.asarray(~same.any(axis=1))
