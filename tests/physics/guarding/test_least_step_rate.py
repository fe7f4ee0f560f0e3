"""The rates that scenes need, compared with those at which they fail."""

from math import cos, sin, sqrt

import numpy as np
import pytest

from sandbox.model.level import Level
from sandbox.physics.geometry.outline_distance import smallest_width
from sandbox.physics.guarding.least_step_rate import rate_bounds
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import SimulationError
from tests.physics.scenes import GRAVITY, G, Spec, box, disc, fixed, level, measured


def chain(links: int, load: float, rate: float) -> Level:
    """Links of 0.1 m and 1 kg with a load at the end, let go at 0.3 rad."""
    balls = {
        f"ball{i}": disc(
            (0.1 * i * sin(0.3), -0.1 * i * cos(0.3)),
            radius=0.02,
            mass=load if i == links else 1,
        )
        for i in range(1, links + 1)
    }
    ends = [[0, 0], *balls]
    rods = {f"rod{i}": {"type": "rod", "ends": [ends[i], ends[i + 1]]} for i in range(links)}
    return level(balls, GRAVITY, joints=rods, stepping={"rate": rate})


@pytest.mark.parametrize(("links", "load"), [(5, 1e4), (20, 100), (20, 1e5)])
def test_a_chain_under_load_breaks_below_the_rate_that_its_tension_asks_for(
    links: int, load: float
) -> None:
    world = build(chain(links, load, 20_000))
    need = rate_bounds(world.scene, world.snapshot)[0]
    assert need.subject.startswith("the joint 'rod")
    assert need.rate == pytest.approx(sqrt(load * G * cos(0.3) / 0.1), rel=0.1)

    energy = measured(build(chain(links, load, 1.15 * need.rate)), 300, "system.energy")
    scale = load * G * 0.1 * links * (1 - cos(0.3))
    assert np.ptp(energy["system.energy"]) <= 1e-3 * scale
    with pytest.raises(SimulationError, match="rate"):
        build(chain(links, load, 0.9 * need.rate)).advance(600)


def test_a_spring_asks_for_what_it_is_refused_below() -> None:
    spring = {"type": "spring", "ends": [[0, 0], "ball"], "stiffness": 1e4}
    scene = level({"ball": disc((1, 0))}, {}, joints={"spring": spring})
    world = build(scene)
    assert [(n.rate, n.subject) for n in rate_bounds(world.scene, world.snapshot)] == [
        (50, "the spring 'spring'")
    ]


def test_a_fast_body_asks_for_steps_as_long_as_it_is_wide() -> None:
    bodies: Spec = {
        "slow": disc(velocity=[1, 0]),
        "bullet": box((5, 0), size=(0.05, 0.02), velocity=[300, 400]),
        "wall": fixed({"type": "box", "width": 1, "height": 1}, (9, 9)),
    }
    world = build(level(bodies, {"contact": {}}))
    first, second = rate_bounds(world.scene, world.snapshot)
    assert first.subject == "the body 'bullet'"
    assert first.rate == pytest.approx(500 / 0.02)
    assert second.subject == "the body 'slow'"
    assert second.rate == pytest.approx(1)
    assert rate_bounds(world.scene, world.snapshot, ["bullet"]) == [second]
    assert smallest_width(world.scene.space) == pytest.approx(0.02, rel=1e-6)


@pytest.mark.parametrize("solver", ["direct", "iterative"])
def test_a_line_asks_for_nothing_for_it_is_as_wide_as_its_skin(solver: str) -> None:
    line: Spec = {
        "shape": {"type": "segment", "start": [-1, 0], "end": [1, 0]},
        "mass": 1,
        "velocity": [0, 5],
    }
    world = build(level({"line": line, "ball": disc((5, 5))}, {"contact": {"solver": solver}}))
    assert rate_bounds(world.scene, world.snapshot) == []


def test_a_pin_asks_for_nothing_for_it_has_no_length_to_swing_about() -> None:
    pin = {"type": "pivot", "ends": [[0, 0], {"body": "rod", "at": [-0.3, 0]}]}
    scene = level(
        {"rod": box((0.3, 0), size=(0.6, 0.1))}, {**GRAVITY, "rotation": {}}, joints={"pin": pin}
    )
    world = build(scene)
    assert world.snapshot.tension[0] > 1
    assert rate_bounds(world.scene, world.snapshot) == []


def test_what_rests_asks_for_nothing() -> None:
    world = build(level({"a": disc(), "b": disc((3, 0))}, {"contact": {}}))
    assert rate_bounds(world.scene, world.snapshot) == []
    assert smallest_width(world.scene.space) == 1
