"""What meets first in a drift, or passes the end of its support, and when."""

from collections.abc import Callable, Sequence
from functools import partial
from itertools import pairwise
from math import inf
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.detection.time_of_impact import TOUCH, Hit, Path
from sandbox.physics.contacts.direct.drifts.subdrift_records import Subdrift
from sandbox.physics.contacts.direct.drifts.tripping_at_flush_edges import carries_on
from sandbox.physics.contacts.direct.prediction.convex_parts import Pair
from sandbox.physics.contacts.direct.prediction.side_end_geometry import EndCrossing
from sandbox.physics.contacts.direct.prediction.speculative_contacts import (
    AnyCorner,
    SpeculativeContacts,
    new_to,
)
from sandbox.physics.engine.space_arrays import Contacts
from sandbox.physics.geometry.root_finding import root
from sandbox.physics.joints.exact.constraint_interface import Coordinates, coordinate_indices

SOON = 1e-6
"""No kick is solved for a first part shorter than this share of the drift. A landing within this
share of the drift's end is left to the next drift."""

BEYOND = 0.01
"""What supports a body after it passes the end of a side is looked up this share of the rest of the
drift later. At the end itself, each of two lines that continue each other would leave it to the
other."""

TOGETHER = 1e-9
"""Landings within this share of a drift coincide; it is also the tolerance of their time."""


class PossibleMeetings(NamedTuple):
    """What may meet, or pass the end of its support, in a drift.

    `pairs` are those of bodies that do not touch, and may land; `corners` may land on a side of a
    body that their own body already touches. `passing` are the contacts that may pass the end of a
    side.
    """

    pairs: Sequence[Pair]
    corners: Sequence[AnyCorner]
    passing: Sequence[EndCrossing]


class FirstMeeting(NamedTuple):
    """The first landing of a drift, or the first contacts that pass the end of a side.

    `time` is since the start of the drift [s]. `hits` are the impacts of bodies that did not touch
    before; `corners` are those that land on a body which their own body already touches elsewhere;
    `passing` are the contacts that pass the end of a side, if nothing lands. `impact_pairs` are all
    pairs that would collide in the whole drift, not only the first; `corner_pairs` are those of
    which a corner lands in it. `time_count` is at how many different times pairs collide.
    """

    time: float
    hits: Sequence[Hit]
    corners: Sequence[AnyCorner]
    passing: Sequence[EndCrossing]
    impact_pairs: Sequence[Pair]
    corner_pairs: Sequence[Pair]
    time_count: int

    @property
    def again(self) -> PossibleMeetings:
        """The same, to be found in another drift."""
        return PossibleMeetings(
            sorted({hit.bodies for hit in self.hits}), self.corners, self.passing
        )

    @property
    def pairs(self) -> list[Pair]:
        """The pairs of bodies that take part."""
        others = (*(one.pair for one in self.corners), *(one.bodies for one in self.passing))
        return [*self.again.pairs, *others]


class MeetingFinder:
    """Finds what meets first in a drift; N bodies with the plane.

    `speculative` knows the bodies; `laws`, (3 N,), are the accelerations by gravity and force
    laws [m/s², rad/s²].
    """

    def __init__(self, speculative: SpeculativeContacts, laws: Array) -> None:
        self._speculative, self._laws = speculative, laws
        self._indices = coordinate_indices(len(laws) // 3 - 1)

    def ahead(self, part: Subdrift, calm: Callable[[Pair], bool]) -> PossibleMeetings:
        """Return what may meet in a part of a drift, but for pairs that are `calm`."""
        speculative, kick, displacement = self._speculative, part.kick, part.drift * part.velocity
        pairs = speculative.approaching.near(kick.contacts, kick.pose, displacement)
        return PossibleMeetings(
            [pair for pair in pairs if not calm(pair)],
            [one for one in speculative.corners(kick, part.velocity) if not calm(one.pair)],
            [
                one
                for one in speculative.ends.passing(kick, displacement, part.forces)
                if not calm(one.bodies)
            ],
        )

    def first(self, part: Subdrift, longest: float, ahead: PossibleMeetings) -> FirstMeeting | None:
        """Return what meets first on the parabolas of a part within a time `longest` [s]."""
        total, (pairs, corners, passing) = self._laws + part.constraint_acceleration, ahead
        velocity, pose = part.velocity - total * (part.drift / 2), part.kick.pose.values

        def at(t: float) -> Coordinates:
            return Coordinates(pose + t * (velocity + total * (t / 2)))

        def height(corner: AnyCorner, t: float) -> float:
            return self._speculative.height(corner, at(t)) - TOUCH

        def left(one: EndCrossing, t: float) -> float:
            return one.distance_left(at(t))

        path = Path(pose[self._indices], velocity[self._indices], total[self._indices])
        near = self._speculative.approaching
        hits = near.meet(path, longest, pairs) if pairs else []
        hits = [hit for hit in hits if not carries_on(part, path, hit, near.outlines)]
        falls = [root(partial(height, corner), longest) for corner in corners]
        passes = [root(partial(left, one), longest) for one in passing]
        first = min((*(hit.time for hit in hits), *falls, *passes), default=inf)
        if first > longest * (1 - SOON):
            return None
        last = first + TOGETHER * longest
        falling = [one.pair for one, time in zip(corners, falls, strict=True) if time < longest]
        coming = sorted({hit.bodies for hit in hits})
        times = moments([hit.time for hit in hits], TOGETHER * longest)
        hits = [hit for hit in hits if hit.time <= last]
        down = [corner for corner, time in zip(corners, falls, strict=True) if time <= last]
        passed = [one for one, time in zip(passing, passes, strict=True) if time <= last]
        passed = [] if hits or down else passed
        return FirstMeeting(first, hits, down, passed, coming, falling, times)

    def beside(
        self, ended: Subdrift, velocity: Array, met: FirstMeeting, pairs: Sequence[Pair]
    ) -> Contacts:
        """Return the contacts that support bodies from where they slide past the end of a side.

        What approaches faster than force laws could cause in the rest of the drift is left to land.

        `ended` is the part of the drift up to there, with the kick there, `velocity`, (3 N,), are
        the velocities there [m/s, rad/s], and `met` is what passes. `pairs` are the bodies to
        consider.
        """
        speculative, pose = self._speculative, ended.kick.pose
        guests = {one.bodies[1] for one in met.passing}
        some = [pair for pair in pairs if guests & {*pair}]
        path = Path(*(rates[self._indices] for rates in (pose.values, velocity, self._laws)))
        left = ended.time_left - ended.drift
        corners, hits = speculative.approaching.touching(path, BEYOND * left, some)
        gives = left * np.abs(path.acceleration[:, :2]).max()
        rests = [hit for hit in hits if hit.parting >= -gives]
        return speculative.contacts(corners, pose, ended.kick.joints.origin, rests)

    def overlapping(self, ended: Subdrift, pairs: Sequence[Pair]) -> Contacts:
        """Return the contacts of bodies that already overlap where a part of a drift ends.

        They met shortly before the part ends, and more slowly than forces could cause in the rest
        of the drift: nothing else would stop them. Faster ones are left to land. `pairs` are the
        bodies to consider; a part of one that the other already touches is found again, and left
        out.
        """
        speculative, pose, total = (
            self._speculative,
            ended.end,
            self._laws + ended.constraint_acceleration,
        )
        path = Path(*(rates[self._indices] for rates in (pose.values, ended.velocity, total)))
        corners, hits = speculative.approaching.touching(path, 0.0, pairs)
        gives = (ended.time_left - ended.drift) * np.abs(path.acceleration[:, :2]).max()
        rests = [hit for hit in hits if abs(hit.parting) <= gives]
        found = speculative.contacts(corners, pose, ended.kick.joints.origin, rests)
        if not len(found.bodies):
            return found
        is_new = new_to(ended.kick.contacts_at(pose), found)
        return Contacts._make(field[is_new] for field in found)


def moments(times: Sequence[float], spacing: float) -> int:
    """Return the number of distinct times, more than `spacing` from the one before [s]."""
    return bool(times) + sum(b - a > spacing for a, b in pairwise(sorted(times)))
