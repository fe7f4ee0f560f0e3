"""When the first landing of a drift is, which depends on the length of the part up to it."""

from collections.abc import Mapping
from typing import Any

import pytest

from sandbox.physics.contacts.detection.time_of_impact import Hit
from sandbox.physics.contacts.direct.drifts.first_contact_or_edge import (
    FirstMeeting,
    PossibleMeetings,
    moments,
)
from sandbox.physics.contacts.direct.drifts.landing_time_refinement import until_first

FIRST, SECOND = (0, 1), (2, 3)


class Part:
    """A part of a drift of one second."""

    def __init__(self, drift: float) -> None:
        self.drift = drift


class Meetings:
    """Pairs that meet at a time a, later by b times the part that is missing [s]."""

    def __init__(self, pairs: Mapping[tuple[int, int], tuple[float, float]]) -> None:
        self.pairs = pairs

    def ahead(self, _part: Part, _calm: object) -> PossibleMeetings:
        return PossibleMeetings([*self.pairs], (), ())

    def first(self, part: Part, longest: float, ahead: PossibleMeetings) -> FirstMeeting | None:
        times = {
            pair: at + later * (1 - part.drift)
            for pair, (at, later) in self.pairs.items()
            if pair in ahead.pairs
        }
        soon = {pair: time for pair, time in times.items() if time < longest}
        if not soon:
            return None
        pair = min(soon, key=lambda pair: soon[pair])
        hits = [Hit(soon[pair], pair, 1j, (0j,), -1.0)]
        return FirstMeeting(soon[pair], hits, [], [], sorted(soon), [], len(soon))


@pytest.mark.parametrize("later", [0.0, 0.1, 0.5, 0.9])
def test_the_pair_that_meets_first_in_the_shorter_part_is_found(later: float) -> None:
    """The first pair of the whole drift may meet after the other: then that comes first."""
    meetings: Any = Meetings({FIRST: (0.2, later), SECOND: (0.3, 0.0)})
    whole: Any = Part(1.0)
    met = meetings.first(whole, 1.0, PossibleMeetings([FIRST, SECOND], (), ()))

    shorter, found = until_first(whole, met, meetings, lambda _, drift, __: Part(drift))  # type: ignore[arg-type,return-value]

    alone = (0.2 + later) / (1 + later)
    assert found.pairs == [FIRST if alone < 0.3 else SECOND]
    assert shorter.drift == found.time == pytest.approx(min(alone, 0.3))


@pytest.mark.parametrize(
    ("times", "apart", "count"),
    [([], 1e-9, 0), ([0.0, 0.0], 0.0, 1), ([0.3, 0.1, 0.1 + 1e-12], 1e-9, 2)],
)
def test_landings_at_one_time_count_once(times: list[float], apart: float, count: int) -> None:
    """Also in a drift of no length, before an event at its start."""
    assert moments(times, apart) == count
