"""Sensors: how deep a body is in one, and that nothing else knows that they are there."""

from math import cos, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sandbox.model.errors import LevelError
from sandbox.model.level import Level
from sandbox.physics.geometry.depth_in_polygon import depth
from sandbox.physics.quantities.meter import Meter
from sandbox.physics.run import build, simulate
from tests.physics.scenes import GRAVITY, G, disc, floor, level

ELL = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]]
SHAPES = {
    "disc": {"type": "disc", "radius": 1},
    "box": {"type": "box", "width": 2, "height": 1},
    "polygon": {"type": "polygon", "vertices": ELL},
}
FALL = {"event": "crossing", "quantity": "ball.within.gate", "value": 0}


def gate(shape: str = "box", **said: object) -> dict[str, object]:
    return {"type": "static", "sensor": True, "shape": SHAPES[shape], **said}


def seen(this: Level) -> float:
    world = build(this)
    return float(Meter(world, ["ball.within.gate"])(world.snapshot)["ball.within.gate"])


@pytest.mark.parametrize(
    ("shape", "place", "deep"),
    [
        ("disc", (0.25, 0), 0.75),
        ("disc", (0, 3), -2),
        ("box", (0.9, 0), 0.1),
        ("box", (0, 0), 0.5),
        ("box", (1.3, 0.9), -0.5),
        ("polygon", (0.5, 0.5), 0.5),
        ("polygon", (1.5, 1.5), -0.5),
        ("polygon", (1.5, 0.75), 0.25),
    ],
)
@pytest.mark.parametrize("angle", [0.0, 0.7, 4.0])
def test_a_body_is_as_deep_as_its_centre_is_from_the_outline(
    shape: str, place: tuple[float, float], deep: float, angle: float
) -> None:
    (x, y), c, s = place, cos(angle), sin(angle)
    at = 5 + c * x - s * y, -2 + s * x + c * y
    this = level({"ball": disc(at), "gate": gate(shape, position=[5, -2], angle=angle)}, {})

    assert seen(this) == pytest.approx(deep, abs=1e-12)


@given(x=st.floats(-3, 3), y=st.floats(-3, 3))
def test_the_way_around_a_polygon_does_not_matter(x: float, y: float) -> None:
    corners = np.array([complex(*corner) for corner in ELL])
    point = np.array(complex(x, y))

    assert depth(point, corners) == pytest.approx(depth(point, corners[::-1]), abs=1e-15)


@pytest.mark.parametrize(
    "contact", [{}, {"solver": "direct"}, {"located": ["ball"]}, {"apart": [["ball", "gate"]]}]
)
def test_a_sensor_changes_no_bit_of_what_passes_through_it(contact: dict[str, object]) -> None:
    """But where it is named it is told to be one."""
    bodies = {"ball": disc((0, 0)), "floor": floor(-3)}
    if "apart" in contact:
        with pytest.raises(LevelError, match="'gate' is a sensor"):
            level({**bodies, "gate": gate()}, {**GRAVITY, "contact": contact})
        return
    states = []
    for more in ({}, {"gate": gate(position=[0, -1.5])}):
        world = build(level({**bodies, **more}, {**GRAVITY, "contact": contact}))
        world.advance(120)
        states.append((world.snapshot.position[0].tolist(), world.snapshot.velocity[0].tolist()))

    assert states[0] == states[1]


def test_events_wait_for_a_body_to_enter_and_to_leave() -> None:
    """It falls through a metre in which a push doubles its weight's pull."""
    events = {
        "in": {"at": {**FALL, "direction": "up"}, "on": ["push"]},
        "out": {"at": {**FALL, "direction": "down"}, "off": ["push"]},
    }
    push = [{"name": "push", "body": "ball", "force": [0, -G]}]
    bodies = {"ball": disc((0, 0)), "gate": gate(position=[0, -1.5])}
    world = build(level(bodies, {**GRAVITY, "force": push}, events=events))
    world.advance(60)

    assert world.snapshot.position[0, 1] < -2
    fallen = -float(world.snapshot.position[0, 1])
    assert world.snapshot.velocity[0, 1] ** 2 / 2 == pytest.approx(G * (fallen + 1), rel=1e-12)


def test_a_sensor_that_moves_is_followed() -> None:
    bodies = {
        "ball": disc((0, 0), velocity=[1, 0]),
        "gate": gate("disc", type="kinematic", velocity=[1, 0.5]),
    }
    world = build(level(bodies, {}))
    world.advance(60)

    deep = Meter(world, ["ball.within.gate"])(world.snapshot)["ball.within.gate"]
    assert float(deep) == pytest.approx(0.5, rel=1e-12)


def test_a_sensor_counts_the_moving_bodies_whose_centre_is_in_it() -> None:
    """Three discs of 0.5 m/s at 1.25, 1.75 and 2.25 m from a gate from -1 to 1 m, and a wall."""
    balls = {f"ball{i}": disc((-1.25 - i / 2, 0), velocity=[0.5, 0]) for i in range(3)}
    scene = level({**balls, "gate": gate(), "wall": floor(-1)}, {}, duration=4)
    trace = simulate(scene, record=["gate.count"])

    assert trace.units["gate.count"] == ""
    for t, count in ((0.25, 0), (1, 1), (2, 2), (3, 3), (4, 3)):
        assert trace.columns["gate.count"][round(60 * t)] == count


def test_an_event_may_wait_until_so_many_are_in_a_sensor() -> None:
    """The second of two balls of 1 m/s, 2 m behind the first, is in the gate after 2.5 s."""
    balls = {f"ball{i}": disc((-1.5 - 2 * i, 2), velocity=[1, 0]) for i in range(2)}
    box = {"type": "box", "width": 102, "height": 1}
    bucket = {**gate(position=[50, 2]), "shape": box}
    full = {"event": "crossing", "quantity": "gate.count", "value": 1.5}
    scene = level(
        {**balls, "gate": bucket, "held": disc((0, 5))},
        {**GRAVITY, "field": [{"force": [0, G], "per": "mass", "bodies": ["ball0", "ball1"]}]},
        joints={"hold": {"type": "weld", "ends": ["held", [0, 5]]}},
        events={"let_go": {"at": full, "cut": ["hold"]}},
    )
    fallen = build(scene).advance(240).position[3, 1]

    assert fallen == pytest.approx(5 - G * 1.5**2 / 2, abs=1e-9)


@pytest.mark.parametrize(
    ("said", "rule"),
    [
        ({"type": "dynamic", "mass": 1}, "a sensor must be static or kinematic"),
        ({"friction": 0.5}, "a sensor has no surface"),
        (
            {"shape": {"type": "segment", "start": [0, 0], "end": [1, 0]}},
            "a sensor must be a disc, a box or a polygon, not a segment",
        ),
    ],
)
def test_what_no_sensor_can_be_is_told(said: dict[str, object], rule: str) -> None:
    bodies = {"ball": disc((0, 5)), "floor": floor(-3), "gate": {**gate(), **said}}
    with pytest.raises(LevelError, match=rule):
        level(bodies, {"contact": {}})


def test_who_waits_for_a_sensor_to_be_touched_is_told() -> None:
    touch = {"event": "contact", "bodies": ["ball", "gate"]}
    check = {"quantity": "t", "formula": "1", "tolerance": 1e-3, "at": touch}
    bodies = {"ball": disc((0, 5)), "floor": floor(-3), "gate": gate()}
    with pytest.raises(LevelError, match=r"a sensor, which nothing touches; .*\.within\."):
        level(bodies, {"contact": {}}, checks=[check])


def test_only_sensors_tell_how_deep_a_body_is() -> None:
    with pytest.raises(LevelError, match=r"'ball\.within\.floor' is not a quantity"):
        level(
            {"ball": disc((0, 5)), "floor": floor(-3)},
            {},
            checks=[{"quantity": "ball.within.floor", "formula": "1", "tolerance": 1}],
        )
