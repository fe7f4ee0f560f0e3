"""Bodies that stick to each other at their first touch."""

from math import sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sandbox.model.level import Level
from sandbox.physics.measuring.interpolation_between_steps import crossing, value_at
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import SimulationError
from tests.physics.scenes import GRAVITY, G, Spec, box, disc, floor, level, measured, run, worst


def sticking(*pairs: tuple[str, str], **effects: object) -> Spec:
    return {"contact": {}, "sticking": {"pairs": [{"bodies": list(p)} for p in pairs]}, **effects}


def off_centre(b: float, m1: float, m2: float, rate: float = 240, **effects: object) -> Level:
    """Two discs of 0.3 m, the first at 3 m/s, that meet after half a second."""
    return level(
        {
            "a": disc((-sqrt(0.36 - b * b) - 1.5 + 1e-13, b), radius=0.3, mass=m1, velocity=[3, 0]),
            "b": disc((0, 0), radius=0.3, mass=m2),
        },
        sticking(("a", "b"), **effects),
        stepping={"rate": rate},
    )


MASSES = st.floats(-1, 1).map(lambda power: 10.0**power)
KEPT = ("system.momentum.x", "system.momentum.y", "system.angular_momentum")


@pytest.mark.sweep
@settings(max_examples=30, deadline=None)
@given(st.floats(-0.55, 0.55), MASSES, MASSES)
def test_discs_that_stick_off_centre_keep_momentum_and_turn(b: float, m1: float, m2: float) -> None:
    """ω = μ v b / I, with I = (m1 + m2) r² / 2 + μ (2 r)²; second order."""
    scene = off_centre(b, m1, m2, rotation={})
    found = measured(build(scene), 240, *KEPT, "a.angular_velocity", "b.angular_velocity")
    reduced = m1 * m2 / (m1 + m2)
    omega = -reduced * 3 * b / ((m1 + m2) * 0.3**2 / 2 + reduced * 0.36)

    for name in KEPT:
        assert np.ptp(found[name]) <= 1e-13 * (m1 + m2), name  # 1e-15
    for body in ("a", "b"):
        spin = found[f"{body}.angular_velocity"]
        assert (spin[:119] == 0).all()
        assert np.abs(spin[121:] - omega).max() <= 1e-4 * 5  # 5e-6 of ω


def test_the_spin_of_what_sticks_is_second_order() -> None:
    def error(rate: float) -> float:
        end = build(off_centre(0.3, 1, 2, rate, rotation={})).advance(int(rate))
        return abs(float(end.angular_velocity[0]) + 1.6)

    assert error(60) / error(120) == pytest.approx(4, rel=0.05)


def test_what_sticks_stays_where_it_touched() -> None:
    motion = run(build(off_centre(0.4, 1, 3, rotation={})), 480)
    apart = np.hypot(*(motion.position[121:, 1] - motion.position[121:, 0]).T)

    assert worst(apart, 0.6) <= 1e-12
    assert np.ptp((motion.angle[:, 1] - motion.angle[:, 0])[121:]) <= 1e-13


def test_without_rotation_what_sticks_goes_straight_on() -> None:
    found = measured(build(off_centre(0.4, 1, 2)), 240, "a.velocity.x", "b.velocity.x", *KEPT[:2])

    assert worst(found["a.velocity.x"][121:], 1.0) <= 1e-13
    assert worst(found["b.velocity.x"][121:], 1.0) <= 1e-13
    assert np.ptp(found["system.momentum.x"]) <= 1e-14
    assert np.abs(found["system.momentum.y"]).max() <= 1e-14


@pytest.mark.parametrize("e", [0, 0.5, 1])
def test_what_sticks_does_not_bounce(e: float) -> None:
    scene = level(
        {
            "a": disc((-1, 0), radius=0.2, velocity=[2, 0], restitution=e, friction=1),
            "b": disc((0, 0.1), radius=0.2, restitution=1, friction=1),
        },
        sticking(("a", "b"), restitution={}, friction={}, rotation={}),
        stepping={"rate": 240},
    )
    found = measured(build(scene), 240, "system.kinetic_energy", "a.angular_velocity", *KEPT)

    for name in KEPT:
        assert np.ptp(found[name]) <= 1e-13, name
    assert found["system.kinetic_energy"][-1] < 0.6 * 2
    assert found["a.angular_velocity"][-1] > 0


def test_only_the_pairs_that_are_named_stick() -> None:
    bodies = {
        "a": disc((-1, 0), radius=0.2, velocity=[2, 0]),
        "b": disc((0, 0), radius=0.2),
        "c": disc((1, 0), radius=0.2),
    }
    end = build(level(bodies, sticking(("b", "c")))).advance(120)

    assert end.velocity[1, 0] == pytest.approx(end.velocity[2, 0], rel=1e-12)
    assert end.velocity[:, 0].sum() == pytest.approx(2, rel=1e-12)


@pytest.mark.sweep
def test_three_that_all_touch_become_one() -> None:
    """The third pair is one already when it touches: nothing is said twice."""
    bodies = {
        "a": disc((-0.2, 0), radius=0.2),
        "b": disc((0.2, 0), radius=0.2, velocity=[-0.1, 0]),
        "c": disc((0, 1), radius=0.2, mass=2, velocity=[0, -1], angular_velocity=1),
    }
    scene = level(
        bodies, sticking(("a", "b"), ("b", "c"), ("a", "c"), rotation={}), stepping={"rate": 240}
    )
    found = measured(build(scene), 480, *KEPT)
    end = build(scene).advance(480)

    for name in KEPT:
        assert np.ptp(found[name]) <= 1e-13, name
    assert np.ptp(end.angular_velocity) <= 1e-12


def test_what_sticks_to_the_ground_stays_there() -> None:
    scene = level(
        {"ball": disc((0, 2), radius=0.2, velocity=[1, 0], angular_velocity=3), "ground": floor()},
        {**GRAVITY, **sticking(("ball", "ground"), rotation={})},
    )
    motion = run(build(scene), 120)

    assert np.ptp(motion.position[60:, 0], axis=0).max() <= 1e-13
    assert np.abs(motion.velocity[60:, 0]).max() <= 1e-12


def test_what_sticks_on_the_ground_stays_on_it() -> None:
    """A wagon runs into another on a floor: no hop, and the ground carries both."""
    scene = level(
        {
            "a": box((-2, 0.25), velocity=[2, 0], mass=1),
            "b": box((0, 0.25), mass=3),
            "ground": floor(),
        },
        {**GRAVITY, **sticking(("a", "b"), rotation={})},
        stepping={"rate": 240},
    )
    found = measured(
        build(scene), 480, "a.position.y", "b.position.y", "a.velocity.x", "b.velocity.x",
        "a.contact.normal", "b.contact.normal",
    )  # fmt: skip

    assert worst(found["b.velocity.x"][300:], 0.5) <= 1e-9
    assert np.abs(found["a.position.y"] - 0.25).max() <= 1e-5
    assert np.abs(found["b.position.y"] - 0.25).max() <= 1e-5
    carried = found["a.contact.normal"] + found["b.contact.normal"]
    assert worst(carried[300:], 4 * G) <= 1e-3


def ballistic(rate: float, kind: str = "rod") -> Level:
    """Clay of 0.1 kg at 20 m/s, and a block of 1.9 kg on a rod of 2 m."""
    return level(
        {
            "clay": disc((-0.75, 0), radius=0.05, mass=0.1, velocity=[20, 0]),
            "block": box((0, 0), size=(0.4, 0.3), mass=1.9),
        },
        {**GRAVITY, **sticking(("clay", "block"))},
        joints={"rod": {"type": kind, "ends": [[0, 2], "block"]}},
        stepping={"rate": rate},
    )


@pytest.mark.parametrize("kind", ["rod", "rope"])
def test_a_ballistic_pendulum_swings_to_the_height_of_its_common_speed(kind: str) -> None:
    """v' = m v / (m + M) at the impact, to rounding; h = v'² / 2 g to second order."""
    names = ("block.velocity.x", "clay.velocity.x", "block.position.y", "rod.length", "t")
    found = measured(build(ballistic(480, kind)), 480, *names)
    speed = found["block.velocity.x"]
    hit = int(np.argmax(speed > 0))
    top = crossing(found["t"], speed, 0.0, "down")

    assert (speed[:hit] == 0).all()
    assert speed[hit] == pytest.approx(1, rel=1e-14)
    assert found["clay.velocity.x"][hit] == pytest.approx(1, rel=1e-14)
    assert top is not None
    height = value_at(found["t"], found["block.position.y"], top)
    assert height == pytest.approx(1 / (2 * G), rel=1e-4)  # 5e-6
    assert worst(found["rod.length"], 2.0) <= 1e-12


def test_the_rod_feels_the_impact_for_one_step_only() -> None:
    found = measured(build(ballistic(480)), 60, "rod.tension", "block.velocity.x")
    hit = int(np.argmax(found["block.velocity.x"] > 0))
    tension = found["rod.tension"]

    assert worst(tension[:hit], 1.9 * G) <= 1e-9
    assert tension[hit] > 1.2 * 2 * (G + 0.5)
    assert tension[hit + 1] == pytest.approx(2 * (G + 0.5), rel=1e-3)


def test_what_sticks_and_is_pinned_already_is_told_by_name() -> None:
    at = {"body": "b", "at": [-1, 0]}
    scene = level(
        {"a": disc((0, 0), radius=0.2), "b": disc((1, 0), radius=0.2, angular_velocity=3),
         "c": disc((0, 1), radius=0.2, velocity=[0, -1])},
        sticking(("a", "c"), ("b", "c"), rotation={}),
        joints={
            "pin": {"type": "pivot", "ends": ["a", at]},
            "bar": {"type": "weld", "ends": ["a", "c"]},
        },
    )  # fmt: skip
    with pytest.raises(SimulationError, match="b and c' is redundant"):
        build(scene).advance(600)


def test_a_level_without_sticking_watches_no_one() -> None:
    scene = off_centre(0.3, 1, 2)
    plain = scene.model_copy(
        update={"effects": scene.effects.model_copy(update={"sticking": None})}
    )

    assert build(plain).hooks == 0
    assert build(scene).hooks > 0
