"""Pairs of bodies that do not touch, but might within a drift.

A body that touches one part of another, as one side of a kink, may meet the next part.

The distance of a pair is computed again only when the two may have moved that far relative to each
other since the last time: about ten times for a body that falls, once for one that stands beside
another.
"""

from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import pairwise, product

import numpy as np
import pymunk

from sandbox.model.expressions import Array
from sandbox.physics.contacts.detection.contact_queries import Query, pairs_of
from sandbox.physics.contacts.detection.time_of_impact import (
    BodyMotion,
    Hit,
    Path,
    meet,
    nearest,
    touching,
)
from sandbox.physics.contacts.direct.complementarity.redundant_systems import max_abs
from sandbox.physics.contacts.direct.prediction.approaching_hollow_shapes import (
    HollowCorner,
    HollowPairs,
)
from sandbox.physics.contacts.direct.prediction.convex_parts import ConvexParts, Pair, PlacedParts
from sandbox.physics.contacts.direct.prediction.corner_contacts import LEAST
from sandbox.physics.contacts.direct.prediction.separation_bound import (
    CLEAR,
    Separation,
    spread,
)
from sandbox.physics.contacts.direct.rows.contact_outlines import PARALLEL
from sandbox.physics.contacts.direct.rows.row_layout import Surfaces
from sandbox.physics.contacts.shapes.pair_exclusion import meets
from sandbox.physics.engine.space_arrays import Booleans, Contacts, Integers
from sandbox.physics.geometry.outline_distance import Outline, outlines
from sandbox.physics.joints.exact.constraint_interface import Coordinates, translations

MOST = 6
"""Two bodies move by at most this multiple of the largest coordinate change, one to the other."""


class ApproachingPairs:
    """Keeps lower bounds of the distances between bodies, to find those that may meet; n bodies.

    `query` knows the bodies, and which of them pass through others; `shapes` are their parts,
    `surfaces` has their contact properties, and `movable`, (n,), tells which are dynamic. `hollows`
    are the pairs of a hollow body and another; `beside`, (n, n), tells which pairs that
    touch may also meet at another place.
    """

    def __init__(
        self,
        query: Query,
        shapes: ConvexParts,
        surfaces: Surfaces,
        movable: Booleans,
        hollows: HollowPairs,
        beside: Booleans,
    ) -> None:
        self._bodies, self._gates, self._shapes = query.bodies, query.gates, shapes
        self._hollows = hollows
        reach, convex = self._hollows.reach(shapes.reach), surfaces.figures.convex
        is_finite = np.isfinite(reach)
        convex = is_finite & convex
        may = np.triu(surfaces.lands & (convex[:, None] & convex | self._hollows.pairs), 1)
        may &= movable[:, None] | movable
        self._first, self._second = np.nonzero(may)
        self._beside = beside[may]
        self._outlines: dict[int, list[Outline]] = {}
        self._hollow = surfaces.figures.inner > 0
        reach = np.where(is_finite, reach, 0.0)
        self._weights = np.concatenate((np.ones(2 * len(reach) + 2), reach, (0.0,)))
        self._room = np.zeros(len(self._first))  # lower bounds of their distances [m]
        self._calm = 0.0  # the least of these [m]
        self._seen: Array | None = None  # the positions at the last search
        self._touch: Integers | None = None  # the contacts then
        self._ahead = b""  # the displacements that were expected then
        self._found: list[Pair] = []  # its result
        self._collide: set[Pair] = set()  # those that are known to collide

    def forget(self) -> None:
        """Look at all pairs again: joints changed, and what was one solid may collide."""
        self._room[:], self._seen = 0.0, None
        self._collide.clear()

    def near(self, contacts: Contacts, pose: Coordinates, displacement: Array) -> list[Pair]:
        """Return the pairs that may meet in the drift: out of contact, or in contact elsewhere.

        `displacement`, (3 N,), are the displacements of the bodies in the drift [m, rad].
        """
        if not len(self._first):
            return []
        displacement = displacement * self._weights
        if self._seen is not None and contacts.bodies is self._touch:
            went = (pose.values - self._seen) * self._weights
            if MOST * max_abs(np.abs(went) + np.abs(displacement)) < self._calm:
                return []
            if not np.count_nonzero(went) and self._ahead == displacement.tobytes():
                return self._found
        self._ahead, self._found = (
            displacement.tobytes(),
            self._search(contacts, pose, displacement),
        )
        return self._found

    def meet(self, path: Path, duration: float, pairs: Iterable[Pair]) -> list[Hit]:
        """Return the impacts of pairs of bodies on a path of length `duration` [s]."""
        velocity_changes = np.stack((path.acceleration * duration,) * 2)
        hits = []
        for a, b in pairs:
            if self._hollows.pairs[a, b]:
                hits += self._hollows.meet(path, duration, (a, b), velocity_changes)
        for both in self._unsure(path, duration, pairs):
            if hit := meet(path, *both, 0.0, duration, velocity_changes):
                hits.append(hit)
        return hits

    def ahead(self, path: Path, duration: float, pairs: Iterable[Pair]) -> list[Hit]:
        """Return, for pairs of bodies that meet on a path, where they are nearest at its start.

        Hollow bodies are left out.
        """
        none = np.zeros((2, *path.velocity.shape))
        return [
            nearest(path, *both, 0.0)
            for both in self._unsure(path, duration, pairs)
            if meet(path, *both, 0.0, duration, none)
        ]

    def _unsure(
        self, path: Path, duration: float, pairs: Iterable[Pair]
    ) -> Iterator[tuple[Outline, Outline]]:
        """Yield the parts of pairs of bodies that may meet; hollow bodies are left out."""
        separation = Separation(self._shapes, path, duration)
        for a, b in pairs:
            if not self._hollows.pairs[a, b]:
                for first, second in separation.unsure((a, b)):
                    yield self.outlines(a)[first], self.outlines(b)[second]

    def touching(
        self, path: Path, soon: float, pairs: Iterable[Pair]
    ) -> tuple[list[HollowCorner], list[Hit]]:
        """Return the contacts of pairs of bodies at the start of a path.

        They are those that still exist `soon` after it [s]: at the start itself, rounding would
        decide at the ends of lines.
        """
        corners: list[HollowCorner] = []
        hits: list[Hit] = []
        now, later = spread(path.pose), spread(path.pose_at(soon))
        placed = self._shapes.at(later)
        for a, b in pairs:
            if self._hollows.pairs[a, b]:
                corners += self._hollows.touching((a, b), now, later)
                continue
            if self._shapes.gap((a, b), placed) > CLEAR:  # a small part of the work
                continue
            for one, other in product(self.outlines(a), self.outlines(b)):
                if touching(path, one, other, soon):
                    hits.append(_on_sides(nearest(path, one, other, 0.0), path, (one, other)))
        return corners, hits

    def outlines(self, body: int) -> list[Outline]:
        """Return the outlines of a body's shapes, in the order of its parts."""
        if body not in self._outlines:
            own = outlines([self._bodies[body]])
            self._outlines[body] = [replace(outline, body=body) for outline in own]
        return self._outlines[body]

    def _search(self, contacts: Contacts, pose: Coordinates, displacement: Array) -> list[Pair]:
        """Return the pairs that may meet, and update the bounds of those that have come close."""
        first = self._seen is None
        if self._seen is not None:
            went = (pose.values - self._seen) * self._weights
            self._room -= self._between(went)
        self._seen, self._touch = pose.values, contacts.bodies
        ahead = self._between(displacement)
        touch, parts = set(pairs_of(contacts)), self._shapes.at(pose)
        room, found = self._room.copy(), []
        for row in np.flatnonzero(self._room < ahead).tolist():
            pair = int(self._first[row]), int(self._second[row])
            if pair in touch:  # computed again in each search
                beside = self._beside[row]
                gap = self._shapes.gap(pair, parts, beside=True) if beside else np.inf
                self._room[row], room[row] = 0.0, gap
            else:
                gap = self._gap(pair, parts)
                near = first or gap <= ahead[row]
                if near and (self._never_meet(pair) or self._within(pair, gap)):
                    gap = np.inf
                self._room[row] = room[row] = gap
            if LEAST < ahead[row] >= gap and not self._is_let(pair, pose):
                found.append(pair)
        self._calm = float(room.min())
        return found

    def _gap(self, pair: Pair, parts: PlacedParts) -> float:
        """Return a lower bound of the distance between two bodies [m]."""
        if self._hollows.pairs[pair]:
            return self._hollows.gap(pair, parts.pose)
        return self._shapes.gap(pair, parts)

    def _is_let(self, pair: Pair, pose: Coordinates) -> bool:
        """Return whether one of two bodies lets the other pass through from this side."""
        if self._gates is None:
            return False
        placed, other_placed = (
            (complex(pose.position[b]), complex(pose.rotation[b])) for b in pair
        )
        return self._gates.lets_pass_at(*pair, placed, other_placed)

    def _between(self, displacement: Array) -> Array:
        """Return a bound of how much closer displacements, (3 N,) [m], bring each pair [m]."""
        count = len(displacement) // 3
        shift, turn = translations(displacement), np.abs(displacement[2 * count :])
        first, second = self._first, self._second
        return np.asarray(np.abs(shift[first] - shift[second]) + turn[first] + turn[second])

    def _within(self, pair: Pair, gap: float) -> bool:
        """Return whether one of two bodies is within the other, and never met from outside."""
        return bool(gap < 0 and not self._hollows.pairs[pair] and self._hollow[list(pair)].any())

    def _never_meet(self, pair: Pair) -> bool:
        """Return whether two bodies do not collide, or are parts of one solid."""
        if pair in self._collide:
            return False
        one, other = (self._bodies[body] for body in pair)
        if meets(one, other) and not _are_one(one, other):
            self._collide.add(pair)
            return False
        return True


def _on_sides(hit: Hit, path: Path, both: tuple[Outline, Outline]) -> Hit:
    """Return a hit with the normal of a side, if its own is close to that.

    Near sharp corners, which are a little round, the normal that was found is slightly off.
    """
    for outline, sign in zip(both, (1, -1), strict=True):
        corners = BodyMotion(path, outline.body, hit.time).place(outline.corners)
        for corner, following in pairwise((*corners, corners[0])):
            if following != corner:
                normal = sign * -1j * (following - corner) / abs(following - corner)
                if abs(normal - hit.normal) < PARALLEL:
                    return hit._replace(normal=normal)
    return hit


def _are_one(one: pymunk.Body, other: pymunk.Body) -> bool:
    """Return whether two bodies are welded or stuck together, so that they do not collide."""
    solids = _solids(one)
    return bool(solids and solids & _solids(other))


def _solids(body: pymunk.Body) -> set[int]:
    """Return the collision groups of a body's shapes, but for 0."""
    return {shape.filter.group for shape in body.shapes} - {0}
