"""One-way surfaces that an event reverses: trapdoors, valves, and the way out of a loop."""

from typing import Any

import numpy as np
import pytest

from sandbox.editing.renaming import rename
from sandbox.model.errors import LevelError
from sandbox.model.level import Level
from sandbox.model.levels_with_changed_effects import vary
from sandbox.physics.run import build
from sandbox.physics.stepping.run_continuation import branch
from tests.physics.scenes import GRAVITY, disc, fixed, level

LINE = {"type": "segment", "start": [-3, 0], "end": [3, 0]}
R, MARBLE = 1.0, 0.08

Place = tuple[float, float]

THROWN: tuple[Place, Place] = ((0, -1), (0, 6))
"""Where a ball starts that is thrown up through the line, and how fast."""


def trapdoor(
    at: float, solver: str = "direct", position: Place = (0, 0.2), velocity: Place = (0, 0)
) -> Level:
    """Return a ball over a line that holds it, and is reversed at a time."""
    bodies = {
        "ball": {**disc(radius=0.2), "position": position, "velocity": velocity},
        "line": fixed(LINE, (0.0, 0.0), one_way="left"),
    }
    effects = {**GRAVITY, "contact": {"solver": solver}}
    events = {"open": {"at": at, "reverse": ["line"]}}
    return level(bodies, effects, events=events, stepping={"rate": 240})


@pytest.mark.parametrize("solver", ["direct", "iterative"])
def test_a_trapdoor_lets_fall_what_rests_on_it(solver: str) -> None:
    world = build(trapdoor(0.5, solver=solver))
    world.advance(120)
    assert world.snapshot.position[0, 1] == pytest.approx(0.2, abs=1e-6)
    world.advance(120)

    assert world.snapshot.position[0, 1] == pytest.approx(0.2 - 9.81 * 0.5**2 / 2, abs=2e-2)


def test_what_was_let_through_is_held_from_the_other_side_afterwards() -> None:
    """The line lets up and holds from above; reversed at 0.1 s it holds what comes from below."""
    before = build(trapdoor(5, "direct", *THROWN))
    after = build(trapdoor(0.1, "direct", *THROWN))
    before.advance(120)
    after.advance(120)

    assert before.snapshot.position[0, 1] > 0.5
    assert after.snapshot.position[0, 1] < -0.2


def test_what_is_half_way_through_goes_on_untouched() -> None:
    seen = build(trapdoor(0.17, "direct", *THROWN))
    free = build(trapdoor(9, "direct", *THROWN))
    seen.advance(48)
    free.advance(48)

    assert abs(free.snapshot.position[0, 1]) < 0.2
    assert seen.snapshot.position[0, 1] == free.snapshot.position[0, 1]


def test_a_branch_keeps_what_was_reversed() -> None:
    world = build(trapdoor(0.1, position=(0, 0.5)))
    world.advance(30)
    other = branch(world, world.values)
    world.advance(120)
    other.advance(120)

    assert world.snapshot.position[0, 1] < -0.5
    assert other.snapshot.position[0, 1] == pytest.approx(world.snapshot.position[0, 1], abs=1e-9)


def loop(events: dict[str, Any]) -> Level:
    """Return a marble on a level track with a loop: its left half lets in, its right half holds."""
    half = {"type": "arc", "radius": R}
    bodies = {
        "marble": {**disc(radius=MARBLE), "position": [-2, MARBLE], "velocity": [8, 0]},
        "track": fixed({"type": "segment", "start": [-4, 0], "end": [6, 0]}, (0.0, 0.0)),
        "right": fixed({**half, "start": "270*deg", "end": "450*deg"}, (0.0, R), one_way="left"),
        "left": fixed({**half, "start": "90*deg", "end": "270*deg"}, (0.0, R), one_way="left"),
    }
    return level(bodies, {**GRAVITY, "contact": {}}, events=events, stepping={"rate": 2000})


TOP = {"event": "crossing", "quantity": "marble.position.x", "value": 0, "direction": "down"}


def test_a_marble_goes_round_a_loop_once_and_leaves_it() -> None:
    """It leaves as fast as it came: nothing was lost on the way round."""
    world = build(loop({"over_the_top": {"at": TOP, "reverse": ["right"]}}))
    places = []
    for _ in range(17):
        world.advance(200)
        places.append(world.snapshot.position[0].tolist())

    x, y = places[-1]
    assert max(height for _, height in places) > R
    assert x > R + 0.5
    assert y == pytest.approx(MARBLE, abs=1e-4)
    assert np.hypot(*world.snapshot.velocity[0]) == pytest.approx(8, rel=1e-3)


@pytest.mark.sweep
def test_without_that_it_stays_in_the_loop() -> None:
    world = build(loop({"never": {"at": 60, "reverse": ["right"]}}))
    world.advance(4400)
    assert abs(world.snapshot.position[0, 0]) < R


def test_only_what_is_one_way_can_be_reversed() -> None:
    with pytest.raises(LevelError, match="'track' is not a one-way surface; set its 'one_way'"):
        loop({"over": {"at": 1, "reverse": ["track"]}})
    with pytest.raises(LevelError, match="unknown body 'rihgt'; did you mean 'right'"):
        loop({"over": {"at": 1, "reverse": ["rihgt"]}})


def test_without_contact_there_is_nothing_to_reverse() -> None:
    changed, _ = vary(loop({"over": {"at": 1, "reverse": ["right"]}}), ["contact"], {})
    assert not changed.events


def test_a_surface_that_is_reversed_may_be_called_otherwise() -> None:
    text = rename(trapdoor(1).text, ("bodies", "line"), "door")
    assert '"reverse": ["door"]' in text
