"""Runs in a batch end with the bits of each run alone."""

import numpy as np
import pytest

from sandbox.model.expressions import Array, Values
from sandbox.model.level import Level
from sandbox.model.level_catalog import find
from sandbox.model.loading import choose, load
from sandbox.physics.ensemble.batched_runs import BatchStepper, can_be_batched, can_join
from sandbox.physics.run import build, simulate
from sandbox.physics.stepping.world import World

PENDULUM = "lagrange/double-pendulum"
WATCHED = (
    "t",
    "lower.position.x",
    "upper.velocity",
    "lower.acceleration.y",
    "system.energy",
    "system.angular_momentum",
    "second.length",
)


def worlds(level: Level, values: list[Values]) -> list[World]:
    return [build(level, v) for v in values]


@pytest.mark.sweep
@pytest.mark.parametrize("count", [3, 2, 17])
def test_pendulums_end_in_the_bits_of_each_alone(count: int) -> None:
    """Chaos would turn the last bit into 1e-5 within two seconds."""
    level = load(find(PENDULUM))
    values = [choose(level, {"angle": 101 + 2.7 * i, "m": 0.6 + i / 20}) for i in range(count)]
    steps = [600 + 30 * i for i in range(count)]
    assert can_be_batched(level, level.stepping, WATCHED)
    flown = BatchStepper(worlds(level, values), WATCHED, steps, None).run()
    for one, chosen, length in zip(flown, values, steps, strict=True):
        alone = simulate(level, chosen, length / level.stepping.rate, WATCHED)
        assert one.trace is not None
        assert (one.trace.t == alone.t).all()
        for name in WATCHED:
            assert (one.trace.columns[name] == alone.columns[name]).all(), name


@pytest.mark.parametrize("name", ["kinematics/projectile", "kinematics/free-fall"])
def test_so_does_what_flies_freely(name: str) -> None:
    level = load(find(name))
    values = [choose(level, {"g": 2.0 + i}) for i in range(5)]
    names = ("t", "ball.position.y", "ball.speed", "ball.energy")
    for one, chosen in zip(
        BatchStepper(worlds(level, values), names, [70] * 5, None).run(), values, strict=True
    ):
        alone = simulate(level, chosen, 70 / level.stepping.rate, names)
        assert one.trace is not None
        assert all((one.trace.columns[n] == alone.columns[n]).all() for n in names)


def test_a_condition_ends_each_where_it_holds_first() -> None:
    level = load(find("kinematics/projectile"))
    values = [choose(level, {"angle": angle}) for angle in (10.0, 30.0, 80.0)]

    def falls(columns: dict[str, Array], _: Array, __: World) -> int | None:
        below = columns["ball.velocity.y"] < 0
        return int(np.argmax(below)) if below.any() else None

    names = ("t", "ball.velocity.y")
    for one in BatchStepper(worlds(level, values), names, [900] * 3, falls).run():  # type: ignore[arg-type]
        assert one.has_stopped
        assert one.trace is not None
        assert (one.trace.columns["ball.velocity.y"][:-1] >= 0).all()
        assert one.trace.columns["ball.velocity.y"][-1] < 0


@pytest.mark.sweep
def test_what_a_run_alone_is_stopped_for_is_left_to_it() -> None:
    """At 20 Hz the joints of a fast pendulum cannot hold."""
    level = load(find(PENDULUM))
    slow = level.model_copy(update={"stepping": level.stepping.at(12)})
    values = [choose(slow, {"angle": angle}) for angle in (100.0, 149.0)]
    flown = BatchStepper(worlds(slow, values), ("t",), [200] * 2, None).run()
    assert any(one.trace is None for one in flown)


@pytest.mark.parametrize(
    "name", ["newton/incline", "energy/spring-oscillator", "lagrange/simple-pendulum"]
)
def test_contacts_springs_and_lone_rods_run_alone(name: str) -> None:
    level = load(find(name))
    body = next(n for n, b in level.bodies.items() if b.type == "dynamic")
    names = ("t", f"{body}.position.x")
    assert not (can_be_batched(level, level.stepping, names) and can_join(build(level)))
