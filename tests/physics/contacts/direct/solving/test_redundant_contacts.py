"""What is pinned to the ground that it stands on is held by its pin."""

import numpy as np
import pytest

from sandbox.model.expressions import Array
from sandbox.model.level import Level
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import SimulationError
from tests.physics.scenes import GRAVITY, G, Spec, booked, box, fixed, level
from tests.sample import thinned

HINGED: Spec = {**GRAVITY, "contact": {}, "friction": {}, "rotation": {}}
GROUND = fixed({"type": "segment", "start": [-3, 0], "end": [6, 0]}, friction=0.8)


def dominoes(count: int, rate: float, turn: float = -3) -> Level:
    """Boxes that stand on the ground, each pinned to it at a corner; the first is tipped over."""
    bodies = {
        f"domino{i}": box((0.25 * i, 0.25), size=(0.08, 0.5), mass=1 + i, friction=0.5)
        for i in range(count)
    }
    bodies["domino0"] |= {"angular_velocity": turn, "velocity": [-0.25 * turn, 0]}
    hinges = {
        f"hinge{i}": {
            "type": "pivot",
            "ends": [[0.25 * i + 0.04, 0], {"body": f"domino{i}", "at": [0.04, -0.25]}],
        }
        for i in range(count)
    }
    return level({"ground": GROUND, **bodies}, HINGED, joints=hinges, stepping={"rate": rate})


@pytest.mark.sweep
@pytest.mark.parametrize(("count", "rate"), thinned([(1, 240), (2, 240), (3, 480)], 3))
def test_hinged_dominoes_fall_and_lie_with_all_energy_accounted_for(
    count: int, rate: float
) -> None:
    world, ledger = booked(dominoes(count, rate), 1.5)

    falls = sum(1 + i for i in range(count)) * G * 0.25
    assert world.snapshot.angle[-1] == pytest.approx(-np.pi / 2, abs=1e-6)
    assert np.abs(world.snapshot.angular_velocity).max() < 1e-9
    assert abs(ledger.balance.unexplained) < 2e-4 * falls


def test_a_pin_on_the_ground_holds_to_rounding_while_its_body_turns() -> None:
    world = build(dominoes(1, 240))
    for _ in range(180):
        now = world.advance()
        pin = now.position[1] + _turned((0.04, -0.25), now.angle[1])
        assert np.hypot(*(pin - (0.04, 0))) < 1e-14


def test_what_a_joint_drives_into_the_ground_is_refused() -> None:
    press = {
        "type": "kinematic",
        "shape": {"type": "disc", "radius": 0.01},
        "position": [1, 1],
        "velocity": [0, -1e-6],
        "friction": 0,
    }
    weld = {"weld": {"type": "weld", "ends": ["press", "box"]}}
    scene = level(
        {"ground": GROUND, "box": box((0, 0.1), size=(0.2, 0.2), friction=0.5), "press": press},
        {**HINGED, "contact": {"apart": [["press", "ground"], ["press", "box"]]}},
        joints=weld,
        stepping={"rate": 60},
    )
    with pytest.raises(SimulationError, match="presses 'ground' and 'box' together, and nothing"):
        build(scene).advance(120)


def _turned(point: tuple[float, float], angle: float) -> Array:
    turned = complex(*point) * np.exp(1j * angle)
    return np.array([turned.real, turned.imag])
