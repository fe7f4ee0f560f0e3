"""Strings wound on wheels, welds and motors."""

from math import pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sandbox.model.level import Level
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import SimulationError
from tests.physics.scenes import GRAVITY, G, Spec, box, disc, level, measured, run, worst

TURNING = {**GRAVITY, "rotation": {}}


def winding(end: object, wheel: str, radius: float, way: str) -> Spec:
    return {"type": "winding", "ends": [end, wheel], "radius": radius, "unwinds": way}


def massive(m1: float, m2: float, moment: float, radius: float, rate: float = 60) -> Level:
    """Two weights on a string over a wheel that turns on a pin."""
    return level(
        {
            "wheel": disc((0, 0), radius=radius, moment=moment),
            "left": box((-radius, -3), mass=m1),
            "right": box((radius, -3), mass=m2),
        },
        TURNING,
        joints={
            "pin": {"type": "pivot", "ends": [[0, 0], "wheel"]},
            "a": winding("left", "wheel", radius, "counterclockwise"),
            "b": winding("right", "wheel", radius, "clockwise"),
        },
        stepping={"rate": rate},
    )


SIZES = st.floats(-1, 1).map(lambda power: 10.0**power)


@pytest.mark.sweep
@settings(max_examples=30, deadline=None)
@given(SIZES, SIZES, SIZES, st.floats(0.2, 1))
def test_a_wheel_with_a_moment_pulls_harder_on_the_side_that_falls(
    m1: float, m2: float, moment: float, radius: float
) -> None:
    """a = (m2 − m1) g / (m1 + m2 + I / R²), T1 = m1 (g + a), T2 = m2 (g − a)."""
    names = ("left.position.y", "wheel.angle", "a.tension", "b.tension", "t")
    found = measured(build(massive(m1, m2, moment, radius)), 40, *names)
    a = (m2 - m1) * G / (m1 + m2 + moment / radius**2)

    assert np.abs(found["left.position.y"] + 3 - a * found["t"] ** 2 / 2).max() <= 1e-13
    assert np.abs(found["wheel.angle"] * radius + a * found["t"] ** 2 / 2).max() <= 1e-13
    assert worst(found["a.tension"], m1 * (G + a)) <= 1e-10  # 1e-12
    assert worst(found["b.tension"], m2 * (G - a)) <= 1e-10


def test_a_light_wheel_is_a_peg() -> None:
    found = measured(build(massive(1, 1.5, 1e-9, 0.5)), 40, "a.tension", "b.tension")

    assert found["a.tension"] == pytest.approx(2 * 1.5 * G / 2.5, rel=1e-8)
    assert found["b.tension"] == pytest.approx(2 * 1.5 * G / 2.5, rel=1e-8)


@pytest.mark.parametrize("way", ["clockwise", "counterclockwise"])
def test_a_yo_yo_unwinds_as_it_falls(way: str) -> None:
    """a = g / (1 + I / (m r²)), straight down, turning by many whole turns."""
    sense = 1 if way == "counterclockwise" else -1
    scene = level(
        {"disc": disc((0, 0), radius=0.25, mass=0.5, moment=0.002)},
        TURNING,
        joints={"string": winding([0.1 * sense, 1], "disc", 0.1, way)},
    )
    names = ("disc.position.x", "disc.position.y", "disc.angle", "string.tension", "t")
    found = measured(build(scene), 90, *names)
    a = G / (1 + 0.002 / (0.5 * 0.1**2))

    assert found["disc.angle"][-1] * sense > 10 * 2 * pi
    assert worst(found["disc.angle"], sense * a * found["t"] ** 2 / 0.2) <= 1e-12  # 1e-16
    assert worst(found["disc.position.y"], -a * found["t"] ** 2 / 2) <= 1e-12
    assert np.abs(found["disc.position.x"]).max() <= 1e-13
    assert worst(found["string.tension"], 0.5 * (G - a)) <= 1e-10


@pytest.mark.sweep
def test_a_string_winds_up_on_a_post_around_and_around() -> None:
    """A puck on a post that does not turn: its speed stays, and R per radian is taken off.

    The free length shrinks as d(s²)/dt = −2 R v: the involute of the circle.
    """
    bodies = {
        "post": {"type": "static", "shape": {"type": "disc", "radius": 0.1}},
        "puck": disc((2, -0.1), radius=0.05, velocity=[0, 1]),
    }
    joints = {"string": winding("puck", "post", 0.1, "counterclockwise")}
    world = build(level(bodies, {}, joints=joints, stepping={"rate": 240}))
    found = measured(world, 8 * 240, "string.length", "puck.speed", "t")
    free = np.sqrt(4 - 2 * 0.1 * found["t"])

    assert worst(found["string.length"], free) <= 1e-4
    assert worst(found["puck.speed"], 1.0) <= 1e-4


def test_a_winding_goes_slack_and_never_pushes() -> None:
    """A bob thrown up above its wheel falls freely until the string is tight."""
    bodies = {"wheel": disc((0, 0), mass=1e3), "bob": box((0.5, -2), velocity=[0, 3])}
    joints = {
        "pin": {"type": "pivot", "ends": [[0, 0], "wheel"]},
        "string": winding("bob", "wheel", 0.5, "clockwise"),
    }
    found = measured(
        build(level(bodies, TURNING, joints=joints, stepping={"rate": 240})), 240,
        "bob.position.y", "string.tension", "t",
    )  # fmt: skip
    t = found["t"]
    free = t < 6 / G - 2 / 240

    assert (found["string.tension"] >= 0).all()
    assert (found["string.tension"][free] == 0).all()
    assert found["string.tension"][t > 6 / G + 2 / 240].min() > 0
    assert worst(found["bob.position.y"][free], -2 + 3 * t[free] - G * t[free] ** 2 / 2) <= 1e-12


def test_an_end_that_runs_into_its_wheel_ends_the_run_by_name() -> None:
    bodies = {"wheel": disc((0, 0), mass=1e3), "bob": box((0.5, -2), velocity=[0, 9])}
    joints = {
        "pin": {"type": "pivot", "ends": [[0, 0], "wheel"]},
        "string": winding("bob", "wheel", 0.6, "clockwise"),
    }
    with pytest.raises(SimulationError, match="'string' has run into its wheel") as caught:
        run(build(level(bodies, TURNING, joints=joints)), 120)

    assert caught.value.subject == "string"


def dumbbell(offset: float, spin: float) -> Level:
    """Two welded discs that fly and turn."""
    return level(
        {
            "a": disc((0, 0), radius=0.2, mass=2, velocity=[1, 2], angular_velocity=spin),
            "b": disc((offset, 0.3), radius=0.3, mass=1, angle=0.5),
        },
        {"rotation": {}},
        joints={"bar": {"type": "weld", "ends": ["a", "b"]}},
        stepping={"rate": 240},
    )


@pytest.mark.sweep
@settings(max_examples=20, deadline=None)
@given(st.floats(0, 2), st.floats(-5, 5))
def test_welded_bodies_move_as_one_and_keep_what_they_have(offset: float, spin: float) -> None:
    world = build(dumbbell(offset, spin))
    motion = run(world, 240)
    names = ("system.momentum.x", "system.momentum.y", "system.angular_momentum", "bar.tension")
    found = measured(build(dumbbell(offset, spin)), 240, *names)
    apart = motion.position[:, 1] - motion.position[:, 0]
    angle = motion.angle[:, 0]
    seen = np.stack(
        (
            apart[:, 0] * np.cos(angle) + apart[:, 1] * np.sin(angle),
            apart[:, 1] * np.cos(angle) - apart[:, 0] * np.sin(angle),
        )
    )
    assert np.ptp(seen, axis=1).max() <= 1e-12  # 1e-15
    assert np.ptp(motion.angle[:, 1] - angle) <= 1e-12
    for name in names[:3]:
        assert np.ptp(found[name]) <= 1e-11, name


def test_a_weld_to_the_plane_carries_a_shelf() -> None:
    """Force m g, and the torque m g L of a weight at its end."""
    scene = level(
        {"shelf": box((0.5, 0), size=(1, 0.1), mass=2), "pot": disc((1, 0.2), mass=3)},
        TURNING,
        joints={
            "wall": {"type": "weld", "ends": ["shelf", [0, 0]]},
            "glue": {"type": "weld", "ends": ["shelf", "pot"]},
        },
    )
    found = measured(build(scene), 60, "wall.tension", "wall.torque", "pot.position.y")

    assert found["wall.tension"] == pytest.approx(5 * G, rel=1e-10)
    assert np.abs(found["wall.torque"]) == pytest.approx((2 * 0.5 + 3 * 1) * G, rel=1e-10)
    assert worst(found["pot.position.y"], 0.2) <= 1e-13


@pytest.mark.parametrize(
    "other",
    [
        {"type": "spring", "ends": [[3, 2], "ball"], "stiffness": 20, "length": 1},
        {"type": "pulley", "ends": ["ball", "pot"], "over": [[3, 3], [4, 3]]},
    ],
    ids=["spring", "string"],
)
def test_what_is_solved_apart_from_a_weld_has_no_torque(other: Spec) -> None:
    scene = level(
        {
            "shelf": box((0.5, 0), size=(1, 0.1), mass=2),
            "ball": disc((3, 1)),
            "pot": disc((4, 1), mass=3),
        },
        TURNING,
        joints={"other": other, "wall": {"type": "weld", "ends": ["shelf", [0, 0]]}},
    )
    end = build(scene).advance(30)

    assert end.torque[0] == 0
    assert abs(end.torque[1]) == pytest.approx(2 * 0.5 * G, rel=1e-10)


def test_without_rotation_a_weld_keeps_places() -> None:
    scene = level(
        {"a": disc((0, 0), velocity=[3, 0]), "b": disc((1, 1), mass=2)},
        {},
        joints={"tie": {"type": "weld", "ends": ["a", "b"]}},
    )
    end = build(scene).advance(60)

    assert end.velocity[:, 0] == pytest.approx([1, 1], rel=1e-14)
    assert end.torque[0] == 0


def driven(rate: object, hertz: float = 240) -> Level:
    """An arm of 1 m on a motor, with a ball welded to its end."""
    inner = {"body": "arm", "at": [-0.5, 0]}
    return level(
        {
            "arm": box((0.5, 0), size=(1, 0.05), mass=1),
            "ball": disc((1, 0), radius=0.1, mass=2),
        },
        {"rotation": {}},
        joints={
            "motor": {"type": "motor", "ends": [[0, 0], inner], "rate": rate},
            "clamp": {"type": "weld", "ends": ["arm", "ball"]},
        },
        stepping={"rate": hertz},
    )  # fmt: skip


@pytest.mark.sweep
def test_a_motor_needs_the_torque_that_turns_what_it_carries() -> None:
    """τ = I α, F = m L √(ω⁴ + α²); second order."""
    moment = (1 + 0.05**2) / 12 + 0.25 + 2 * (0.1**2 / 2 + 1)

    def errors(rate: float) -> tuple[float, float]:
        names = ("motor.torque", "clamp.tension", "t")
        found = measured(build(driven("1.5*t", rate)), round(2 * rate), *names)
        omega = 1.5 * found["t"]
        return (
            worst(found["motor.torque"], 1.5 * moment),
            worst(found["clamp.tension"], 2 * np.hypot(omega**2, 1.5)),
        )

    coarse, fine = errors(120), errors(240)
    assert max(fine) <= 1e-4  # 3e-5
    assert coarse[0] / fine[0] == pytest.approx(4, rel=0.1)
    assert coarse[1] / fine[1] == pytest.approx(4, rel=0.1)


@pytest.mark.sweep
def test_a_motor_turns_at_its_rate() -> None:
    """Exactly where the rate is linear in time; by the midpoint rule elsewhere."""
    steady = measured(build(driven(2)), 480, "ball.angle", "t")
    swinging = measured(build(driven("3*cos(2*t)")), 480, "ball.angle", "t")

    assert worst(steady["ball.angle"], 2 * steady["t"]) <= 1e-13
    assert worst(swinging["ball.angle"], 1.5 * np.sin(2 * swinging["t"])) <= 1e-5  # 3e-6


def test_a_motor_between_two_free_bodies_turns_them_against_each_other() -> None:
    """Nothing outside: the angular momentum stays zero, and I1 ω1 = −I2 ω2."""
    scene = level(
        {"a": disc((0, 0), radius=0.2, mass=2), "b": disc((0, 0), radius=0.4, mass=1)},
        {"rotation": {}},
        joints={"motor": {"type": "motor", "ends": ["a", "b"], "rate": "t"}},
    )
    names = ("a.angular_velocity", "b.angular_velocity", "system.angular_momentum", "t")
    found = measured(build(scene), 60, *names)

    between = found["b.angular_velocity"] - found["a.angular_velocity"]
    assert worst(between, found["t"]) <= 1e-12
    assert np.abs(found["system.angular_momentum"]).max() <= 1e-15


def test_a_wound_string_that_is_turned_beyond_all_numbers_is_told() -> None:
    wheel = {"shape": {"type": "disc", "radius": 0.5}, "mass": 1}
    effects = {"rotation": {}, "torque": [{"body": "wheel", "torque": "1/t"}]}
    string = {
        "type": "winding", "ends": [[2, -4], "wheel"], "radius": 0.5, "unwinds": "counterclockwise",
    }  # fmt: skip

    with pytest.raises(SimulationError, match="no longer finite"):
        build(level({"wheel": wheel}, effects, joints={"string": string})).advance(3)
