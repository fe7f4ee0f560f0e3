"""A computation beyond the limits of time or memory is stopped with a message."""

import json
from collections.abc import Iterator
from functools import partial
from itertools import accumulate

import pytest

from sandbox.model.loading import parse
from sandbox.model.many_body_level_generator import crowd
from sandbox.physics import run
from sandbox.physics.measuring import recording
from sandbox.physics.run import build, simulate
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.stepping import time_limit
from sandbox.physics.stepping.time_limit import TimeLimit
from sandbox.physics.stepping.world import World
from tests.physics.scenes import GRAVITY, disc, floor, level

FALL = level({"ball": disc((0, 0))}, GRAVITY)


def clock(*steps: float) -> Iterator[float]:
    """Yield the readings of a clock before and after each of some steps of a given length [s]."""
    for before, after in zip((0, *accumulate(steps)), accumulate(steps), strict=False):
        yield from (before, after)


def test_a_run_whose_steps_take_minutes_is_stopped(monkeypatch: pytest.MonkeyPatch) -> None:
    times = clock(200, 0.01, 100, 100)  # the first was held up by the machine
    monkeypatch.setattr(time_limit, "perf_counter", lambda: next(times))

    with pytest.raises(SimulationError, match=r"a step takes 100 s; at most 30 s are"):
        simulate(FALL)


def test_a_recording_without_room_is_refused_before_it_begins(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(recording, "LARGEST", 8 * 3 * 100)  # 100 instants of two quantities

    assert len(simulate(FALL, duration=1.5, record=["ball.position.y", "t"]).t) == 91
    with pytest.raises(SimulationError, match=r"at t = 0 s: 121 instants .* at most 100"):
        simulate(FALL, duration=2, record=["ball.position.y", "t"])


def test_a_recording_that_nobody_ends_is_stopped(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(recording, "LARGEST", 8 * 3 * 100)

    with pytest.raises(SimulationError, match="101 instants"):
        simulate(FALL, record=["ball.position.y", "t"], until=lambda _world: False)


def test_of_many_bodies_fewer_states_are_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of 10,000 bodies 1,000 were, which took more than a gigabyte."""
    monkeypatch.setattr(recording, "STATES", 3)
    kept = recording.Recorder(build(FALL), ["t"])
    assert kept.trace.t.tolist() == [0]
    assert simulate(FALL, duration=0.1).t.size == 7


def crowded() -> World:
    """Return a world whose steps directly solve the contacts of discs on each other."""
    pile = crowd("pile", 5)
    effects = {**pile["effects"], "contact": {"solver": "direct"}}
    world = build(parse(json.dumps({**pile, "effects": effects})))
    world.advance(12)
    return world


def test_a_single_step_is_broken_off_where_it_computes_for_too_long() -> None:
    world, hasty = crowded(), TimeLimit(1e-5)

    with (
        hasty.within_steps(),
        pytest.raises(SimulationError, match=r"a step takes 0 s; at most 1e-05"),
    ):
        hasty.advance(world)

    with pytest.raises(SimulationError, match="a step takes"):
        world.advance()  # it has ended within the step


def test_a_single_step_that_was_held_up_is_not_broken_off(monkeypatch: pytest.MonkeyPatch) -> None:
    """Wall time passes while a machine sleeps; processor time does not."""
    world, hasty = crowded(), TimeLimit(1e-5)
    monkeypatch.setattr(time_limit, "thread_time", lambda: 0.0)

    with hasty.within_steps():
        hasty.advance(world)


def test_the_start_of_a_run_is_broken_off_where_it_computes_for_too_long(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """150 elastic boxes that fly into each other took a minute to be built."""
    monkeypatch.setattr(run, "TimeLimit", partial(TimeLimit, 0.0))
    bodies = {"floor": floor(), "one": disc((0, 0.5)), "other": disc((0, 1.5))}

    with pytest.raises(SimulationError, match=r"at t = 0 s: a step takes .* at most 0 s are"):
        build(level(bodies, {**GRAVITY, "contact": {"solver": "direct"}}))
