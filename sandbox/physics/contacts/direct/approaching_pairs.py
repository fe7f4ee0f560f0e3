"""Pairs of bodies that do not touch, but might within a drift.

The distance of a pair is computed again only when the two may have moved that far against each
other since the last time. So a falling body is looked at about ten times, and a body that stands
beside another only once.
"""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np
import pymunk

from sandbox.model.expressions import Array
from sandbox.physics.contacts.collision_filter import meets
from sandbox.physics.contacts.contact_queries import Query, pairs_of
from sandbox.physics.contacts.direct.convex_parts import Pair, Shapes
from sandbox.physics.contacts.direct.corner_contacts import LEAST
from sandbox.physics.contacts.direct.row_layout import Surfaces
from sandbox.physics.contacts.direct.separation import Separation
from sandbox.physics.contacts.time_of_impact import Hit, Path, meet
from sandbox.physics.engine.batch import Booleans, Contacts, Integers
from sandbox.physics.geometry.distance import Outline, outlines
from sandbox.physics.joints.exact.constraints import Coordinates, planes

MOST = 6
"""How many times as far as the coordinate that goes furthest two bodies may go together."""


class ApproachingPairs:
    """Knows how far bodies may move before they meet; n bodies.

    Parameters
    ----------
    query
        Knows the bodies, and which of them are let through others.
    shapes
        Theirs.
    surfaces
        How they touch, and which pairs to look at.
    moves
        (n,), which of them anything can move.
    """

    def __init__(
        self,
        query: Query,
        shapes: Shapes,
        surfaces: Surfaces,
        moves: Booleans,
    ) -> None:
        self._bodies, self._gates, self._shapes = query.bodies, query.gates, shapes
        known = np.isfinite(shapes.reach) & surfaces.figures.straight
        may = np.triu(surfaces.lands & known[:, None] & known, 1)
        may &= moves[:, None] | moves
        self._first, self._second = np.nonzero(may)
        self._outlines: dict[int, list[Outline]] = {}
        reach = np.where(known, shapes.reach, 0.0)
        self._weights = np.concatenate((np.ones(2 * len(reach) + 2), reach, (0.0,)))
        self._room = np.zeros(len(self._first))  # how far two are apart at the least [m]
        self._calm = 0.0  # how far any two may go before all are to be looked at [m]
        self._seen: Array | None = None  # where all were when all were looked at last
        self._touch: Integers | None = None  # who touched then
        self._ahead = b""  # how far they were to go
        self._found: list[Pair] = []  # what came of it

    def near(self, contacts: Contacts, place: Coordinates, way: Array) -> list[Pair]:
        """Return the pairs that do not touch, but might within the drift.

        Parameters
        ----------
        contacts
            Who touches.
        place
            Where bodies are.
        way
            (3 N,), how far they go in it [m, rad].
        """
        if not len(self._first):
            return []
        way = way * self._weights
        if self._seen is not None and contacts.bodies is self._touch:
            went = (place.values - self._seen) * self._weights
            if MOST * float((np.abs(went) + np.abs(way)).max()) < self._calm:
                return []
            if not np.count_nonzero(went) and self._ahead == way.tobytes():
                return self._found
        self._ahead, self._found = way.tobytes(), self._search(contacts, place, way)
        return self._found

    def meet(self, path: Path, lasts: float, pairs: Iterable[Pair]) -> list[Hit]:
        """Return where the bodies of pairs meet on a path that is so long [s]."""
        gives = np.stack((path.acceleration * lasts,) * 2)
        separation = Separation(self._shapes, path, lasts)
        found = (
            meet(path, self._outline(a)[first], self._outline(b)[second], 0.0, lasts, gives)
            for a, b in pairs
            for first, second in separation.unsure((a, b))
        )
        return [hit for hit in found if hit]

    def _outline(self, body: int) -> list[Outline]:
        """Return the outlines of a body's shapes, by the numbers of its parts."""
        if body not in self._outlines:
            own = outlines([self._bodies[body]])
            self._outlines[body] = [replace(outline, body=body) for outline in own]
        return self._outlines[body]

    def _search(self, contacts: Contacts, place: Coordinates, way: Array) -> list[Pair]:
        """Look at all pairs that may have come close."""
        first = self._seen is None
        if self._seen is not None:
            went = (place.values - self._seen) * self._weights
            self._room -= self._between(went)
        self._seen, self._touch = place.values, contacts.bodies
        ahead = self._between(way)
        touch, here = set(pairs_of(contacts)), self._shapes.at(place)
        room, found = self._room.copy(), []
        for row in np.flatnonzero(self._room < ahead).tolist():
            pair = int(self._first[row]), int(self._second[row])
            if pair in touch:
                self._room[row], room[row] = 0.0, np.inf  # it is looked at once they part
                continue
            gap = self._shapes.gap(pair, here)
            if (first or gap <= ahead[row]) and self._never_meet(pair):
                gap = np.inf
            self._room[row] = room[row] = gap
            if LEAST < ahead[row] >= gap and not self._is_let(pair, place):
                found.append(pair)
        self._calm = float(room.min())
        return found

    def _is_let(self, pair: Pair, place: Coordinates) -> bool:
        """Return whether one of two bodies lets the other through from where they are."""
        if self._gates is None:
            return False
        at, there = ((complex(place.plane[b]), complex(place.turned[b])) for b in pair)
        return self._gates.lets_at(*pair, at, there)

    def _between(self, way: Array) -> Array:
        """Return how much closer ways, (3 N,) [m], bring the bodies of each pair at most [m]."""
        count = len(way) // 3
        plane, turn = planes(way), np.abs(way[2 * count :])
        first, second = self._first, self._second
        return np.asarray(np.abs(plane[first] - plane[second]) + turn[first] + turn[second])

    def _never_meet(self, pair: Pair) -> bool:
        """Return whether two bodies go through each other, or are parts of one solid."""
        one, other = (self._bodies[body] for body in pair)
        return not meets(one, other) or _are_one(one, other)


def _are_one(one: pymunk.Body, other: pymunk.Body) -> bool:
    """Return whether two bodies are welded or stuck together, and do not touch each other."""
    group, same = ({shape.filter.group for shape in body.shapes} for body in (one, other))
    return bool(group & same - {0})
