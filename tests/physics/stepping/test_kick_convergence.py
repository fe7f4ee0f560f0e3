"""Repeated kicks: where contacts are solved directly, a few repetitions are enough."""

import numpy as np
import pytest

from sandbox.model.level import Level
from sandbox.physics.contacts.direct.solver import DirectSolver
from sandbox.physics.run import build
from tests.physics.scenes import GRAVITY, G, box, floor, level
from validation.case import textbook


def sunken() -> Level:
    """A box that overlaps the floor by a millimetre."""
    bodies = {"box": box((0, 0.499), size=(1, 1), friction=0.5), "floor": floor(friction=0.5)}
    contact = {"solver": "direct", "overlaps": True}
    effects = {**GRAVITY, "contact": contact, "friction": {}, "rotation": {}}
    return level(bodies, effects, stepping={"rate": 240})


def test_an_overlap_is_corrected_once_however_often_its_kick_is_repeated() -> None:
    """Each repetition took half of what was left, so kicks at events went on for long."""
    world = build(sunken())
    world.advance(2)
    direct = world.scene.direct
    assert direct
    heights = []
    for _ in range(4):
        direct.begin(np.array([[0, -G, 0], [0, 0, 0]]), start=True)
        direct.solve(world.t + world.dt)
        heights.append(world.scene.batch.state()[0, 1])

    assert heights[0] > 0.49949  # m: the second half of the overlap is being corrected
    assert np.ptp(heights) == 0


def test_what_is_solved_directly_is_not_kicked_on_for_rounding(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """At the start of two capstans only rounding changed from the second kick to the 20th."""
    solved = []
    solve = DirectSolver.solve

    def counted(direct: DirectSolver, until: float) -> None:
        solved.append(until)
        solve(direct, until)

    monkeypatch.setattr(DirectSolver, "solve", counted)
    build(textbook("hard/two-capstans"))

    assert 1 < len(solved) <= 6
