"""Stops hold what rests on them to rounding, and take what runs into them."""

from math import cos, pi, radians, sqrt
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sandbox.model.errors import LevelError
from sandbox.model.level import Level
from sandbox.physics.energy.ledger import Ledger
from sandbox.physics.quantities.meter import Meter
from sandbox.physics.run import build
from tests.physics.scenes import GRAVITY, G, box, disc, floor, level

DIAGONAL = {"direction": [1, -1]}


def slider(*velocity: float) -> Level:
    """A bead on a rail that goes down to the right at 45°, with stops."""
    joints = {
        "rail": {"type": "rail", "ends": ["bead", [0, 0]], **DIAGONAL},
        "stop": {"type": "stop", "ends": ["bead", [0, 0]], **DIAGONAL, "range": [-1, 0.5]},
    }
    return level({"bead": disc(radius=0.1, velocity=velocity)}, GRAVITY, joints=joints)


BAR = {"type": "segment", "start": [-1, 0], "end": [1, 0]}


def hinge(least: float, most: float) -> dict[str, Any]:
    """A pin at the end of a stick of 2 m, and its stops [degrees]."""
    end = {"body": "stick", "at": [-1, 0]}
    limits = [f"{least}*deg", f"{most}*deg"]
    return {
        "pin": {"type": "pivot", "ends": [[0, 0], end]},
        "stop": {"type": "angle_stop", "ends": [[0, 0], end], "range": limits},
    }


def flap(least: float, most: float, mass: float = 2) -> Level:
    """A stick that falls around a pin at its end."""
    stick = {"shape": BAR, "mass": mass, "position": [1, 0]}
    return level({"stick": stick}, {**GRAVITY, "rotation": {}}, joints=hinge(least, most))


def test_what_slides_into_a_stop_rests_there_with_its_weight_on_it() -> None:
    world = build(slider(0, 0))
    books = Ledger(world)
    for _ in range(90):
        world.advance()
        books.note()
    seen, balance = world.snapshot, books.balance

    assert seen.position[0] == pytest.approx([0.5 / sqrt(2), -0.5 / sqrt(2)], abs=1e-14)
    assert seen.tension == pytest.approx([G / sqrt(2), G / sqrt(2)], rel=1e-9)
    assert balance.loss["impacts"] == pytest.approx(G * 0.5 / sqrt(2), rel=1e-3)
    assert abs(balance.unexplained) < 1e-12


def test_between_its_stops_nothing_is_felt() -> None:
    world = build(slider(-0.5, 0.5))
    stop = list(world.level.joints).index("stop")
    for _ in range(10):
        assert world.advance().tension[stop] == 0
    along = np.array([1, -1]) / sqrt(2) @ world.snapshot.position[0]

    assert along == pytest.approx(-sqrt(0.5) / 6 + G / sqrt(2) / 72, rel=1e-9)


@pytest.mark.sweep
@settings(deadline=None, max_examples=20)
@given(least=st.floats(-80, -5), mass=st.floats(0.1, 100))
def test_a_flap_falls_to_its_stop_and_turns_no_further(least: float, mass: float) -> None:
    world = build(flap(least, 30, mass))
    meter = Meter(world, ["stop.torque"])
    lowest = 0.0
    for _ in range(90):
        lowest = min(lowest, float(world.advance().angle[0]))
    torque = float(meter(world.snapshot)["stop.torque"])

    assert lowest >= radians(least) - 1e-12
    assert world.snapshot.angle[0] == pytest.approx(radians(least), abs=1e-12)
    assert torque == pytest.approx(mass * G * cos(radians(least)), rel=1e-6)


def test_a_flap_that_is_thrown_up_is_stopped_above_with_a_torque_the_other_way() -> None:
    stick = {"shape": BAR, "mass": 2, "position": [1, 0], "velocity": [0, 3], "angular_velocity": 3}
    world = build(level({"stick": stick}, {"rotation": {}}, joints=hinge(-30, 45)))
    most = max(float(world.advance().angle[0]) for _ in range(60))

    assert most == pytest.approx(pi / 4, abs=1e-12)
    assert world.snapshot.angular_velocity[0] == pytest.approx(0, abs=1e-9)


def test_a_stop_and_contacts_are_solved_together() -> None:
    """A box on a box that a stop keeps from sliding: both press as they weigh."""
    bodies = {
        "floor": floor(),
        "lower": box((0, 0.25)),
        "upper": box((0, 0.75)),
    }
    joints = {
        "stop": {
            "type": "stop",
            "ends": ["lower", [0, 0.25]],
            "direction": [1, 0],
            "range": [-1, 0],
        }
    }
    effects = {**GRAVITY, "contact": {}, "force": [{"body": "lower", "force": [5, 0]}]}
    seen = build(level(bodies, effects, joints=joints)).advance(60)

    assert seen.tension[0] == pytest.approx(5, rel=1e-9)
    assert seen.position[1] == pytest.approx([0, 0.25], abs=1e-6)


def test_what_starts_beyond_a_stop_is_refused() -> None:
    with pytest.raises(LevelError, match="it starts at 0 rad, beyond the stops"):
        flap(5, 30)


def test_a_range_the_wrong_way_round_is_refused() -> None:
    with pytest.raises(LevelError, match="from the smaller to the larger"):
        flap(30, -30)
