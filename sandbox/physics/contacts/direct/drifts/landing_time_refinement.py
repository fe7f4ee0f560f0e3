"""The time of the first landing in a drift, and the part of the drift up to there."""

from collections.abc import Callable

from sandbox.physics.contacts.direct.drifts.first_contact_or_edge import (
    TOGETHER,
    FirstMeeting,
    MeetingFinder,
    PossibleMeetings,
)
from sandbox.physics.contacts.direct.drifts.subdrift_records import Subdrift
from sandbox.physics.geometry.root_finding import SecantMethod

REFINED = 6
"""The most refinements of a landing's time: the forces of joints depend on it."""

SOONER = 4
"""The most times that another pair of bodies turns out to be the first."""

Shortened = Callable[[Subdrift, float, Subdrift], Subdrift]
"""Solves a part for a shorter drift [s], given a similar part."""


def until_first(
    part: Subdrift, met: FirstMeeting, meetings: MeetingFinder, shortened: Shortened
) -> tuple[Subdrift, FirstMeeting]:
    """Return a part that ends with its first landing, and that landing.

    Forces differ in a shorter part, so another pair of bodies may land first in it, even one that
    does not land in the whole one: gaps that close in a part slow bodies down less in a shorter
    one.
    """
    shorter, met = _until(part, met, meetings, shortened)
    for _ in range(SOONER):
        ahead = meetings.ahead(shorter, lambda _: False)
        pairs = [pair for pair in ahead.pairs if pair not in met.pairs]
        corners = [one for one in ahead.corners if one.pair not in met.pairs]
        others = PossibleMeetings(pairs, corners, ())
        sooner = meetings.first(shorter, shorter.drift, others) if any(others) else None
        if sooner is None:
            break
        shorter, met = _until(part, sooner, meetings, shortened)
    return shorter, met


def _until(
    part: Subdrift, met: FirstMeeting, meetings: MeetingFinder, shortened: Shortened
) -> tuple[Subdrift, FirstMeeting]:
    """Return a part that ends with a landing, and that landing.

    The time of the landing depends on the length for which the part is solved. The secant method
    finds where the two are equal.
    """
    shorter, times = part, SecantMethod(part.drift, (part.drift, met.time))
    for _ in range(REFINED):
        shorter = shortened(part, met.time, shorter)
        again = meetings.first(shorter, part.drift, met.again)
        if again is None or abs(again.time - met.time) <= TOGETHER * part.drift:
            break
        met = again._replace(time=times.following(met.time, again.time))
    return shorter, met
