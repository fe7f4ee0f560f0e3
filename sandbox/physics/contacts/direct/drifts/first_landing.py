"""The time of the first landing in a drift, and the part of the drift up to there."""

from collections.abc import Callable

from sandbox.physics.contacts.direct.drifts.drift_parts import DriftPart
from sandbox.physics.contacts.direct.drifts.first_meeting import (
    TOGETHER,
    FirstMeeting,
    MeetingFinder,
    PossibleMeetings,
)
from sandbox.physics.geometry.root_finding import SecantMethod

REFINED = 6
"""The most refinements of a landing's time: the forces of joints depend on it."""

SOONER = 4
"""The most times that another pair of bodies turns out to be the first."""

Shortened = Callable[[DriftPart, float, DriftPart], DriftPart]
"""Solves a part for a shorter drift [s], given a similar part."""


def until_first(
    part: DriftPart, met: FirstMeeting, meetings: MeetingFinder, shortened: Shortened
) -> tuple[DriftPart, FirstMeeting]:
    """Return a part that ends with its first landing, and that landing.

    Forces differ in a shorter part. So the pair that comes first in the whole one may come later
    than another there.
    """
    coming = met.coming
    shorter, met = _until(part, met, meetings, shortened)
    for _ in range(SOONER):
        others = PossibleMeetings([pair for pair in coming if pair not in met.pairs], (), ())
        sooner = meetings.first(shorter, shorter.drift, others) if others.pairs else None
        if sooner is None:
            break
        shorter, met = _until(part, sooner, meetings, shortened)
    return shorter, met


def _until(
    part: DriftPart, met: FirstMeeting, meetings: MeetingFinder, shortened: Shortened
) -> tuple[DriftPart, FirstMeeting]:
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
