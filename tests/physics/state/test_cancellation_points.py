"""A long computation can be watched and cancelled, and watching does not change it."""

import json
from collections.abc import Callable

import numpy as np
import pytest

from sandbox.model.errors import SandboxError
from sandbox.model.level import Level
from sandbox.model.loading import parse
from sandbox.model.many_body_level_generator import crowd
from sandbox.model.translatable_message import Message
from sandbox.physics.run import build
from sandbox.physics.state.cancellation_points import cancellable, cancellation_point
from sandbox.physics.stepping.world import World


def pile(count: int, **contact: str) -> Level:
    """Return a level in which discs fall on each other, with the given way to solve contacts."""
    level = crowd("pile", count)
    return parse(json.dumps({**level, "effects": {**level["effects"], "contact": contact}}))


def rocked(**impacts: str) -> Level:
    """Return balls in a row on a floor, hit by one: one impact comes after the other."""
    balls = {
        f"ball{i}": {
            "shape": {"type": "disc", "radius": 0.5}, "mass": 1 + i, "position": [1.01 * i, 0.5],
            "velocity": [0 if i else 5, 0], "restitution": 0.9,
        }
        for i in range(4)
    }  # fmt: skip
    return parse(
        json.dumps(
            {
                "format": 1,
                "title": "Balls in a row",
                "summary": "One strikes the others.",
                "effects": {"contact": {}, "restitution": impacts},
                "bodies": balls,
            }
        )
    )


def refuse() -> None:
    raise SandboxError(Message("enough"))


def looks(world: World, steps: int) -> int:
    """Return the number of cancellation points in some steps."""
    seen: list[None] = []
    with cancellable(lambda: seen.append(None)):
        world.advance(steps)
    return len(seen)


LONG: dict[str, Callable[[], tuple[Level, int]]] = {
    "contacts that are solved directly": lambda: (pile(5, solver="direct"), 15),
    "impacts one after the other": lambda: (rocked(impacts="sequence"), 5),
}
"""Levels whose steps can last for seconds if they are larger, and how many steps they take here."""


@pytest.mark.parametrize("what", LONG)
def test_what_can_take_long_comes_to_cancellation_points(what: str) -> None:
    level, steps = LONG[what]()

    assert looks(build(level), steps) > steps / 4


def test_a_start_at_which_many_touch_comes_to_them_while_it_settles() -> None:
    level = pile(12)
    world = build(level)
    world.advance(60)
    places = zip(level.bodies, world.snapshot.position.tolist(), strict=True)
    at_rest = {name: (x, y) for name, (x, y) in places if name != "vessel"}
    seen: list[None] = []

    with cancellable(lambda: seen.append(None)):
        world.place(at_rest)

    assert len(seen) > 10


def test_who_looks_changes_no_bit() -> None:
    level = pile(5, solver="direct")
    alone, seen = build(level), build(level)

    for _ in range(15):
        alone.advance()
        looks(seen, 1)

    assert np.array_equal(alone.snapshot.position, seen.snapshot.position)
    assert np.array_equal(alone.snapshot.velocity, seen.snapshot.velocity)


def test_a_run_that_is_broken_off_has_ended_and_another_is_not_concerned() -> None:
    level = pile(5, solver="direct")
    world = build(level)
    world.advance(10)
    before = world.snapshot

    with cancellable(refuse), pytest.raises(SandboxError, match="enough"):
        world.advance(5)

    with pytest.raises(SandboxError, match="enough"):
        world.advance()
    assert world.snapshot is before
    build(level).advance(5)


def test_whoever_asked_before_is_asked_as_well() -> None:
    asked: list[str] = []

    with cancellable(lambda: asked.append("outer")):
        with cancellable(lambda: asked.append("inner")):
            cancellation_point()
        cancellation_point()
    cancellation_point()

    assert asked == ["outer", "inner", "outer"]
