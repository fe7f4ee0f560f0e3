"""The order of located impacts, and the limit to their number."""

from collections.abc import Callable, Sequence

import numpy as np

from sandbox.model.translatable_message import Message
from sandbox.physics.contacts.detection.time_of_impact import Hit
from sandbox.physics.contacts.impacts.endless_impacts_error import OFTEN, EndlessImpacts
from sandbox.physics.contacts.impacts.pile_impacts import EQUAL, GENTLE, MANY
from sandbox.physics.engine.space_arrays import Booleans

MOST = 500
"""The most impacts of a body in a step, which take 0.2 s to compute."""

MOST_TOGETHER = 2000
"""The most impacts of all bodies in a step, which take 1 to 2 s to compute."""

INSTANT = 1e-9
"""Impacts within this share of a step are simultaneous."""

CRAMPED = Message(
    "{body} would have more than {most} impacts in one step: it is too fast for its room; give"
    " it more, or increase the 'rate'"
)

CROWDED = Message(
    "bodies would have more than {most:,} impacts in one step, {body} among them; increase the"
    " 'rate', or reduce their 'restitution'"
)

Restitution = Callable[[Hit], float]


class ImpactOrder:
    """Chooses the impacts that come next; n bodies.

    `restitution` returns the coefficient of a hit; `moving`, (n,), are the bodies that can move,
    and `dt` is the time step [s].
    """

    def __init__(self, restitution: Restitution, moving: Booleans, dt: float) -> None:
        self._restitution, self._moving, self._instant = restitution, moving, INSTANT * dt

    def next(self, hits: Sequence[Hit]) -> list[list[Hit]]:
        """Return the next hits: the fastest of the earliest ones, in groups.

        Equally fast hits with the same e come with it; hits that share bodies form a group, and are
        solved together.
        """
        first = min(hit.time for hit in hits)
        now = [hit for hit in hits if hit.time <= first + self._instant]
        fastest = min(now, key=lambda hit: hit.parting)
        equal = [hit for hit in now if hit.parting <= (1 - EQUAL) * fastest.parting]
        e, time = self._restitution(fastest), fastest.time
        left = [hit._replace(time=time) for hit in equal if self._restitution(hit) == e]
        groups = []
        while left:
            groups.append(self.linked(left[:1], left))
            left = [hit for hit in left if hit not in groups[-1]]
        return groups

    def linked(self, group: list[Hit], others: list[Hit]) -> list[Hit]:
        """Return the hits among others whose impulses reach the bodies of a group."""
        reached, count = np.zeros_like(self._moving), 0
        while len(group) > count:
            count = len(group)
            reached[[body for hit in group for body in hit.bodies]] = True
            reached &= self._moving
            group = [hit for hit in others if reached[[*hit.bodies]].any()]
        return group


class Tally:
    """Counts the impacts of a drift; n bodies. For the parameters see `ImpactOrder`."""

    def __init__(self, restitution: Restitution, moving: Booleans, dt: float) -> None:
        self._restitution, self._moving, self._instant = restitution, moving, INSTANT * dt
        self._all, self._now = np.zeros((2, len(moving)), dtype=int)
        self._began, self._together = np.zeros(len(moving)), 0

    def count(self, hits: Sequence[Hit]) -> bool:
        """Count impacts, and return whether a body has had many at one time.

        Raises `EndlessImpacts` if a body has more than `MOST` impacts, or all of them have more
        than `MOST_TOGETHER`.
        """
        time = hits[0].time
        bodies = [body for hit in hits for body in hit.bodies if self._moving[body]]
        for body in bodies:
            if time > self._began[body] + self._instant:
                self._began[body], self._now[body] = time, 0
            self._all[body] += 1
            self._now[body] += 1
            if self._all[body] > MOST:
                raise EndlessImpacts(body, CRAMPED if self._now[body] < MANY else OFTEN, most=MOST)
        self._together += len(hits)
        if self._together > MOST_TOGETHER:
            raise EndlessImpacts(int(self._all.argmax()), CROWDED, most=MOST_TOGETHER)
        return bool(self._now[bodies].max() > MANY)

    def gentle(self, around: Sequence[Hit]) -> bool:
        """Return whether so many impacts leave almost no approach velocity; see `GENTLE`."""
        had = max(self._now[body] for hit in around for body in hit.bodies)
        return bool(max(map(self._restitution, around)) ** had < GENTLE)
