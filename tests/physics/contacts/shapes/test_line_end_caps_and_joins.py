"""Ends of lines find those that they meet, without a look at all others."""

import pytest

from sandbox.physics.contacts.shapes import line_end_caps_and_joins
from sandbox.physics.run import build
from tests.physics.scenes import GRAVITY, disc, fixed, level


def test_the_work_grows_with_the_lines_and_not_with_their_square(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Each of 60 arcs begins where the one before ends, as on a garland."""
    looked: list[bool] = []
    meets = line_end_caps_and_joins._meets

    def watched(end: line_end_caps_and_joins._End, other: line_end_caps_and_joins._End) -> bool:
        looked.append(meets(end, other))
        return looked[-1]

    monkeypatch.setattr(line_end_caps_and_joins, "_meets", watched)
    arc = {"type": "arc", "radius": 1, "start": "pi", "end": "2*pi"}
    arcs = {f"arc{i}": fixed(arc, (2 * i, 0)) for i in range(60)}
    build(level({**arcs, "ball": disc((0, 0), radius=0.1)}, {**GRAVITY, "contact": {}}))

    assert sum(looked) == 2 * 59, "each joint is seen from both sides"
    assert len(looked) < 10 * 60
