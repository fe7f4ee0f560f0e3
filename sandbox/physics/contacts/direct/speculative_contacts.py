"""Contacts that close within a drift: they are solved in the kick before it.

Two bodies touch and turn against each other, so another corner meets its partner somewhere within
the drift. Found only at the end of the drift, it would already be deep inside, and to take that
overlap back would lift whatever stands there. So each kick is followed to the end of its drift.
Corners that would overlap there, and do not yet, get a row of their own: its gap may close but no
further. Then the kick is solved again (Stewart and Trinkle 1996; Anitescu and Potra 1997). This
takes away the part of the approach that is too much for the drift; the impact at the next step
takes the rest. Neither gives energy.

Bodies that do not touch yet, but meet within the drift, are found here, too (see
`landing_impacts`). What bounces is left to its impact.
"""

from collections.abc import Iterator, Sequence
from operator import attrgetter

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.contact_queries import Query, Touched, contacts_of, pairs_of
from sandbox.physics.contacts.direct.approaching_pairs import ApproachingPairs
from sandbox.physics.contacts.direct.convex_parts import Pair, Placed, Shapes
from sandbox.physics.contacts.direct.corner_contacts import (
    ALIKE,
    LEAST,
    Spot,
    corner_on,
    landing,
    within,
)
from sandbox.physics.contacts.direct.kick_system import Kick
from sandbox.physics.contacts.direct.row_layout import Surfaces
from sandbox.physics.engine.batch import Booleans, Contacts
from sandbox.physics.joints.exact.constraints import Coordinates, angles

LOOKS = 30
"""How often a drift is followed to its end at the most: in a stack that rocks each look finds one
more box."""


class SpeculativeContacts:
    """Finds which corners come down within a drift; n bodies.

    Parameters
    ----------
    query
        Knows the bodies, and which of them are let through others.
    surfaces
        How they touch.
    moves
        (n,), which of them anything can move.

    Attributes
    ----------
    approaching
        Knows which of those that do not touch might.
    """

    def __init__(self, query: Query, surfaces: Surfaces, moves: Booleans) -> None:
        self._bodies, self._shapes = query.bodies, Shapes(query.bodies)
        shapes = self._shapes
        self._looks = shapes.sided[:, None] & shapes.sided & (surfaces.restitution == 0)
        self._least = max(LEAST, surfaces.slop)
        self.approaching = ApproachingPairs(query, shapes, surfaces, moves)

    def look(self, kick: Kick, motion: Array, approaching: Sequence[Pair]) -> Contacts | None:
        """Return the contacts that close within the drift after a kick, at its start; None if none.

        Parameters
        ----------
        motion
            (3 N,), the velocities after the kick [m/s, rad/s].
        approaching
            The pairs that did not touch before it and might.
        """
        drift, known = kick.joints.drift, set(pairs_of(kick.contacts)) if approaching else ()
        turning = self._turning(kick.contacts, angles(motion) * drift)
        coming = [pair for pair in approaching if pair not in known]
        if not (turning or coming):
            return None
        here = self._shapes.at(kick.place)
        there = self._shapes.at(Coordinates(kick.place.values + drift * motion))
        found: dict[Pair, list[Touched]] = {}
        for pairs, meets in ((turning, self._meet), (coming, self._land)):
            for pair in pairs:
                if spots := list(meets(pair, here, there)):
                    found[pair] = [self._touched(pair, on, kick.joints.origin) for on in spots]
        return _new(contacts_of(found), kick) if found else None

    def _turning(self, contacts: Contacts, turns: Array) -> list[Pair]:
        """Return the pairs that turn against each other so far that another corner may meet.

        Parameters
        ----------
        turns
            (N,), how far bodies turn in the drift [rad].
        """
        a, b = contacts.bodies.T
        reach, single = self._shapes.reach, self._shapes.single
        way = np.abs(turns[a] - turns[b]) * np.minimum(reach[a], reach[b])
        far = way > LEAST
        if not np.count_nonzero(far):
            return []
        whole = (contacts.touches == 2) & single[a] & single[b]
        turns = (far & self._looks[a, b] & ~whole).tolist()
        pairs = pairs_of(contacts)
        return sorted({pair for pair, looks in zip(pairs, turns, strict=True) if looks})

    def _meet(self, pair: Pair, here: Placed, there: Placed) -> Iterator[Sequence[Spot]]:
        """Yield where a side of one that touches comes down, as it is where the drift starts."""
        for parts in self._shapes.close(pair, there):
            for found in within(there.both(pair, parts)):
                if spot := corner_on(here.both(pair, parts), *found):
                    yield [spot]

    def _land(self, pair: Pair, here: Placed, there: Placed) -> Iterator[Sequence[Spot]]:
        """Yield where two bodies meet that are apart, side by side, as it is where it starts."""
        for parts in self._shapes.close(pair, there):
            on_side: dict[tuple[int, complex], list[Spot]] = {}
            for spot in landing(here.both(pair, parts), there.both(pair, parts), self._least):
                on_side.setdefault((spot.own, spot.normal), []).append(spot)
            for spots in on_side.values():  # of what goes right through, the foremost corners
                yield sorted(spots, key=attrgetter("gap"))[:2]

    def _touched(self, pair: Pair, spots: Sequence[Spot], origin: complex) -> Touched:
        """Return what is to be of one or two spots on one side."""
        own, normal = spots[0].own, spots[0].normal
        points = []
        for spot in spots:
            tip, foot = spot.tip + origin, spot.tip + origin - normal * spot.gap
            points.append((tip, foot) if own else (foot, tip))
        depth = -min(spot.gap for spot in spots)
        return Touched(self._bodies[pair[1]], -normal if own else normal, points, depth)


def _new(found: Contacts, kick: Kick) -> Contacts | None:
    """Return what of it the kick does not know yet; None if it knows all.

    What is round and turns is a little deeper in the end than its point was to be.
    """
    known = kick.contacts.after(len(kick.contacts.bodies) - kick.closes)
    far = np.abs(found.points[:, None, 0] - known.points[:, 0]).max(axis=2)
    same = (found.bodies[:, None] == known.bodies).all(axis=2) & (far < ALIKE)
    new = ~same.any(axis=1)
    return Contacts._make(field[new] for field in found) if new.any() else None
