"""What meets first in a drift, or passes the end of its support, and when."""

from collections.abc import Sequence
from functools import cache, partial
from math import inf
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.convex_parts import Pair
from sandbox.physics.contacts.direct.drift_parts import Part
from sandbox.physics.contacts.direct.kick_system import Kick
from sandbox.physics.contacts.direct.passing_contacts import Passing
from sandbox.physics.contacts.direct.speculative_contacts import (
    AnyCorner,
    SpeculativeContacts,
)
from sandbox.physics.contacts.time_of_impact import TOUCH, Hit, Path
from sandbox.physics.engine.batch import Contacts
from sandbox.physics.geometry.roots import root
from sandbox.physics.joints.exact.constraints import Coordinates, order

SOON = 1e-6
"""The share of a drift at its start for which no kick is solved, and at its end in which no landing
is located: that waits for the next drift."""

BEYOND = 0.01
"""The share of the rest of a drift after which it is seen what carries on a body that passes the
end of a side: at the end itself, lines that continue each other leave it to each other."""

TOGETHER = 1e-9
"""The share of a drift within which landings coincide, and the tolerance of their time."""


BESIDE = 1e-3
"""m, the largest distance of a contact that carries on what passes the end of a curve."""


class Ahead(NamedTuple):
    """What may meet, or pass the end of its support, in a drift.

    Attributes
    ----------
    pairs
        The pairs of bodies that do not touch, and may land.
    corners
        The corners that may land on a side of a body which theirs already touches.
    passing
        The contacts that may pass the end of a side.
    """

    pairs: Sequence[Pair]
    corners: Sequence[AnyCorner]
    passing: Sequence[Passing]


class Met(NamedTuple):
    """The first landing of a drift, or the first contacts that pass the end of a side.

    Attributes
    ----------
    time
        The time after the start of the drift [s].
    hits
        The impacts of bodies that did not touch before.
    corners
        The corners that land on a side of a body which theirs already touches.
    passing
        The contacts that pass the end of a side, if nothing lands.
    coming
        All pairs of bodies that meet in the drift, these and those that follow.
    """

    time: float
    hits: Sequence[Hit]
    corners: Sequence[AnyCorner]
    passing: Sequence[Passing]
    coming: Sequence[Pair]

    @property
    def again(self) -> Ahead:
        """The same, to be found in another drift."""
        return Ahead(sorted({hit.bodies for hit in self.hits}), self.corners, self.passing)

    @property
    def pairs(self) -> list[Pair]:
        """The pairs of bodies that take part."""
        others = (*(one.pair for one in self.corners), *(one.bodies for one in self.passing))
        return [*self.again.pairs, *others]


class Meetings:
    """Finds what meets first in a drift; N bodies with the plane.

    Parameters
    ----------
    speculative
        Knows the bodies.
    laws
        (3 N,), the accelerations by gravity and force laws [m/s², rad/s²].
    """

    def __init__(self, speculative: SpeculativeContacts, laws: Array) -> None:
        self._speculative, self._laws = speculative, laws
        self._order = order(len(laws) // 3 - 1)

    def ahead(self, part: Part, carried: Sequence[Passing]) -> Ahead:
        """Return what may meet in a part of a drift; contacts that are carried on do not count."""
        look, kick, way = self._speculative, part.kick, part.drift * part.moved
        known = {(one.bodies, one.foot) for one in carried}
        passing = look.ends.passing(kick, way, part.forces)
        return Ahead(
            look.approaching.near(kick.contacts, kick.place, way),
            look.corners(kick, part.moved),
            [one for one in passing if (one.bodies, one.foot) not in known],
        )

    def first(self, part: Part, longest: float, ahead: Ahead) -> Met | None:
        """Return what meets first on the parabolas of a part within a time `longest` [s]."""
        total, (pairs, corners, passing) = self._laws + part.pulls, ahead
        begun, place = part.moved - total * (part.drift / 2), part.kick.place.values

        @cache  # all look at the beginning and at the end
        def at(t: float) -> Coordinates:
            return Coordinates(place + t * (begun + total * (t / 2)))

        def height(corner: AnyCorner, t: float) -> float:
            return self._speculative.height(corner, at(t)) - TOUCH

        def left(one: Passing, t: float) -> float:
            return one.left(at(t))

        path = Path(place[self._order], begun[self._order], total[self._order])
        hits = self._speculative.approaching.meet(path, longest, pairs) if pairs else []
        falls = [root(partial(height, corner), longest) for corner in corners]
        passes = [root(partial(left, one), longest) for one in passing]
        first = min((*(hit.time for hit in hits), *falls, *passes), default=inf)
        if first > longest * (1 - SOON):
            return None
        coming = sorted({hit.bodies for hit in hits})
        last = first + TOGETHER * longest
        hits = [hit for hit in hits if hit.time <= last]
        down = [corner for corner, time in zip(corners, falls, strict=True) if time <= last]
        gone = [one for one, time in zip(passing, passes, strict=True) if time <= last]
        return Met(first, hits, down, [] if hits or down else gone, coming)

    def beside(self, ended: Part, begun: Array, met: Met, pairs: Sequence[Pair]) -> Contacts:
        """Return the contacts with bodies beside the ends of sides that others pass.

        These carry them on. What approaches faster than laws in the rest of the drift explain is
        left to land.

        Parameters
        ----------
        ended
            The part of the drift up to there, with the kick there.
        begun
            (3 N,), the velocities there [m/s, rad/s].
        met
            What passes.
        pairs
            The pairs of bodies to consider, which did not touch before.
        """
        look, place = self._speculative, ended.kick.place
        guests = {one.bodies[1] for one in met.passing}
        some = [pair for pair in pairs if guests & {*pair}]
        path = Path(*(rates[self._order] for rates in (place.values, begun, self._laws)))
        left = ended.left - ended.drift
        corners, hits = look.approaching.touching(path, BEYOND * left, some)
        gives = left * np.abs(path.acceleration[:, :2]).max()
        rests = [hit for hit in hits if hit.parting >= -gives]
        return look.contacts(corners, place, ended.kick.joints.origin, rests)


def goes_on(kick: Kick, passing: Sequence[Passing], beside: Contacts) -> bool:
    """Return whether a curve goes on as another body, or another body as a curve, where it ends.

    At its very end a curve counts as a disc. So a drift is not cut there: what passes stays on its
    side, as if that went on, until the step ends.
    """
    curves = kick.layout.touching.figures.courses
    if any(body in curves for body in beside.bodies.ravel().tolist()):
        return True
    ends = [one for one in passing if one.bodies[0] in curves]
    return bool(ends and len(beside.bodies)) or any(_joins(kick, one) for one in ends)


def _joins(kick: Kick, passing: Passing) -> bool:
    """Return whether the body that passes an end already touches another one there."""
    own, guest = passing.bodies
    foot = kick.place.plane[own] + passing.foot * kick.place.turned[own] + kick.joints.origin
    points = np.ascontiguousarray(kick.contacts.points[:, 0]).view(complex)[:, 0]
    near = np.abs(points - foot) < BESIDE
    touches = (kick.contacts.bodies == guest).any(axis=1)
    return bool((near & touches & (kick.contacts.bodies != own).all(axis=1)).any())
