"""What is pinned to the ground that it stands on is held by its pin."""

import numpy as np
import pytest

from sandbox.model.expressions import Array
from sandbox.model.level import Level
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import SimulationError
from tests.physics.scenes import GRAVITY, G, Spec, booked, box, disc, fixed, level
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


def bridge(rate: float) -> Level:
    """Six boxes, pinned corner to corner between two banks, sag under a disc that lands on them."""
    heights = (3.25, 2.75, 2.75, 2.75, 2.75, 3.25)
    bodies = {f"box{i}": box((2 * i - 5, y), size=(2, 0.5), mass=10) for i, y in enumerate(heights)}
    pins = [  # where each touches the one before it
        [[-6, 3], {"body": "box0", "at": [-1, -0.25]}],
        [{"body": "box0", "at": [1, -0.25]}, {"body": "box1", "at": [-1, 0.25]}],
        *(
            [{"body": f"box{i}", "at": [1, -0.25]}, {"body": f"box{i + 1}", "at": [-1, -0.25]}]
            for i in (1, 2, 3)
        ),
        [{"body": "box4", "at": [1, 0.25]}, {"body": "box5", "at": [-1, -0.25]}],
        [{"body": "box5", "at": [1, -0.25]}, [6, 3]],
    ]
    joints = {f"pin{i}": {"type": "pivot", "ends": ends} for i, ends in enumerate(pins)}
    effects: Spec = {**GRAVITY, "contact": {}, "rotation": {}}
    return level(
        {**bodies, "disc": disc((0.5, 4), mass=7.85)},
        effects,
        joints=joints,
        stepping={"rate": rate},
    )


@pytest.mark.sweep
def test_a_blow_on_a_bridge_leaves_the_contacts_at_its_pins_out() -> None:
    """In the blow they contradicted the pins by rounding, and the run stopped at 0.98 s."""
    (coarse, books), (fine, fine_books) = booked(bridge(60), 2), booked(bridge(240), 2)

    apart = coarse.snapshot.position[-1] - fine.snapshot.position[-1]
    assert np.hypot(*apart) < 0.02  # 0.017 m
    missed, fine_missed = (abs(one.balance.unexplained) for one in (books, fine_books))
    assert missed > 9 * fine_missed  # of second order


def _turned(point: tuple[float, float], angle: float) -> Array:
    turned = complex(*point) * np.exp(1j * angle)
    return np.array([turned.real, turned.imag])
