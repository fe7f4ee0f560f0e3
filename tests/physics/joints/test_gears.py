"""Gears and racks hold to rounding, do no work, and tell the forces of their teeth."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sandbox.model.level import Level
from sandbox.physics.energy.ledger import Ledger
from sandbox.physics.quantities.meter import Meter
from sandbox.physics.run import build
from tests.physics.scenes import box, disc, level

TORQUE = 2.0  # N m


def geared(ratio: float, first: float, second: float) -> Level:
    """Two wheels on pins, of moments of inertia I = m / 8, the first of which is turned."""
    bodies = {"a": disc(mass=first), "b": disc((1.5, 0), mass=second)}
    joints: dict[str, Any] = {
        f"pin_{n}": {"type": "pivot", "ends": [n, p]} for n, p in (("a", [0, 0]), ("b", [1.5, 0]))
    }
    joints["gear"] = {"type": "gear", "ends": ["a", "b"], "ratio": ratio}
    effects = {"rotation": {}, "torque": [{"body": "a", "torque": TORQUE}]}
    return level(bodies, effects, joints=joints)


@pytest.mark.sweep
@settings(deadline=None, max_examples=25)
@given(
    ratio=st.floats(0.1, 10).flatmap(lambda n: st.sampled_from([n, -n])),
    first=st.floats(0.1, 100),
    second=st.floats(0.1, 100),
)
def test_wheels_turn_by_their_ratio_as_one_moment_of_inertia(
    ratio: float, first: float, second: float
) -> None:
    world = build(geared(ratio, first, second))
    books = Ledger(world)
    for _ in range(30):
        world.advance()
        books.note()
    a, b = world.snapshot.angle
    alpha = TORQUE / (first / 8 + ratio**2 * second / 8)

    assert b == pytest.approx(ratio * a, rel=1e-12)
    assert a == pytest.approx(alpha * 0.5**2 / 2, rel=1e-9)
    torque = float(Meter(world, ["gear.torque"])(world.snapshot)["gear.torque"])
    assert torque == pytest.approx(second / 8 * ratio * alpha, rel=1e-6)
    assert abs(books.balance.unexplained) < 1e-10 * (1 + books.balance.kinetic)


def test_a_planet_rolls_round_a_sun_that_stands_still() -> None:
    """Of equal wheels the planet turns twice while the arm turns once."""
    arm = {
        "shape": {"type": "segment", "start": [-0.5, 0], "end": [0.5, 0]},
        "mass": 1,
        "position": [0.5, 0],
    }
    bodies = {"sun": disc(), "planet": disc((1, 0)), "arm": arm}
    joints = {
        "still": {"type": "weld", "ends": ["sun", [0, 0]]},
        "motor": {"type": "motor", "ends": [[0, 0], {"body": "arm", "at": [-0.5, 0]}], "rate": 1},
        "axle": {"type": "pivot", "ends": ["planet", {"body": "arm", "at": [0.5, 0]}]},
        "gear": {"type": "gear", "ends": ["sun", "planet"], "ratio": -1, "carrier": "arm"},
    }
    seen = build(level(bodies, {"rotation": {}}, joints=joints)).advance(60)

    assert seen.angle[1] == pytest.approx(2 * seen.angle[2], rel=1e-12)
    assert seen.angle[2] == pytest.approx(1, rel=1e-9)


@pytest.mark.parametrize("direction", [[1, 0], [0, 2], [-3, 4]])
def test_a_rack_moves_by_radius_times_angle(direction: list[float]) -> None:
    bodies = {"wheel": disc(mass=2), "bar": box((0.2, -0.6), mass=3)}
    joints = {
        "pin": {"type": "pivot", "ends": ["wheel", [0, 0]]},
        "rail": {"type": "rail", "ends": ["bar", [0.2, -0.6]], "direction": direction},
        "rack": {"type": "rack", "ends": ["bar", "wheel"], "radius": 0.5, "direction": direction},
    }
    effects = {"rotation": {}, "torque": [{"body": "wheel", "torque": TORQUE}]}
    world = build(level(bodies, effects, joints=joints))
    seen = world.advance(60)
    along = (
        (seen.position[1] - [0.2, -0.6]) @ np.array(direction) / float(np.linalg.norm(direction))
    )
    alpha = TORQUE / (2 / 8 + 3 * 0.5**2)

    assert along == pytest.approx(0.5 * seen.angle[0], rel=1e-12)
    assert seen.angle[0] == pytest.approx(alpha / 2, rel=1e-9)
    assert Meter(world, ["rack.tension"])(seen)["rack.tension"] == pytest.approx(
        -3 * 0.5 * alpha, rel=1e-6
    )


def test_fourth_order_holds_gears_as_well() -> None:
    bodies = {"a": disc(angular_velocity=2), "b": disc((1.5, 0), angular_velocity=-1)}
    joints = {"gear": {"type": "gear", "ends": ["a", "b"], "ratio": -0.5}}
    force = [{"body": "a", "force": [1, 0], "at": [0, 0.5]}]
    stepping = {"scheme": "fourth-order", "rate": 30}
    effects = {"rotation": {}, "force": force}
    seen = build(level(bodies, effects, joints=joints, stepping=stepping)).advance(30)

    assert seen.angle[1] == pytest.approx(-0.5 * seen.angle[0], rel=1e-12)
