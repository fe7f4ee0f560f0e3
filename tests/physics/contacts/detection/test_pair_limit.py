"""More pairs than a step can carry are refused before any is made, and where they come together."""

import tracemalloc

import numpy as np
import pymunk
import pytest

from sandbox.physics.contacts.detection.pair_limit import (
    MOST_DIRECT,
    MOST_PAIRS,
    most_pairs,
    refuse_crowd,
)
from sandbox.physics.guarding import watchdog
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.stepping.world import World
from tests.physics.scenes import Pair, Spec, disc, level

OVERLAPS = {"contact": {"overlaps": True}}


def crowd(count: int, apart: Pair = (0, 0)) -> dict[str, Spec]:
    return {f"d{i}": disc((i * apart[0], i * apart[1])) for i in range(count)}


def advance(world: World, steps: int) -> None:
    for _ in range(steps):
        world.advance()


def meeting(places: np.ndarray, most: int) -> bool:
    """Return whether more squares of 1 m meet than that."""
    bodies = [pymunk.Body(1, 1) for _ in places]
    shapes: dict[str, list[pymunk.Shape]] = {}
    for i, (body, (x, y)) in enumerate(zip(bodies, places, strict=True)):
        body.position = float(x), float(y)
        shapes[str(i)] = [pymunk.Circle(body, 0.5)]
    try:
        refuse_crowd(shapes, most)
    except SimulationError:
        return True
    return False


@pytest.mark.parametrize("squeeze", [(1, 1), (0.1, 1), (1, 0.1)])
def test_pairs_are_counted_as_by_looking_at_each(squeeze: Pair) -> None:
    places = np.random.default_rng(1).uniform(0, 12, (150, 2)) * squeeze
    near = (np.abs(places[:, None] - places[None]) <= 1).all(axis=2)
    pairs = int(near.sum() - len(places)) // 2

    assert meeting(places, pairs - 1)
    assert not meeting(places, pairs)


@pytest.mark.sweep
def test_two_thousand_discs_in_one_place_are_refused_before_they_take_memory() -> None:
    """They took 30 s and 2.7 GB."""
    scene = level(crowd(2000), OVERLAPS)
    tracemalloc.start()
    try:
        with pytest.raises(SimulationError, match="more than 54,545 pairs of bodies are close"):
            build(scene)
        _, most = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()

    assert most < 100e6


def test_who_is_in_most_pairs_is_told_with_its_place() -> None:
    row = crowd(400, (0.002, 0))

    with pytest.raises(SimulationError, match=r"bodies\.(d\d+): more than .*; '\1' is in most"):
        build(level({**row, "far": disc((50, 0))}, OVERLAPS))


@pytest.mark.sweep
def test_a_row_of_twenty_thousand_is_no_crowd() -> None:
    places = np.stack((np.arange(20_000) * 1.1, np.zeros(20_000)), axis=1)

    assert not meeting(places, 0)


def test_what_stands_still_makes_no_pairs_with_itself() -> None:
    walls = {f"w{i}": {**disc(), "type": "static"} for i in range(400)}
    for wall in walls.values():
        del wall["mass"]

    build(level({**walls, "ball": disc((5, 0))}, OVERLAPS))


def test_more_sweeps_and_direct_solving_carry_fewer_pairs() -> None:
    assert most_pairs(1, direct=False) < MOST_PAIRS
    assert most_pairs(1000, direct=False) == MOST_PAIRS // 11
    assert most_pairs(10, direct=True) == MOST_DIRECT


def test_bodies_that_come_together_on_the_way_end_the_run(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(watchdog, "most_pairs", lambda *_, **__: 3)
    row = [disc((1.2 * i, 0), velocity=[-i, 0]) for i in range(5)]
    world = build(level({f"d{i}": body for i, body in enumerate(row)}, {"contact": {}}))

    with pytest.raises(SimulationError, match="more than 3 pairs of bodies are close"):
        advance(world, 200)
    assert not world.doubted
