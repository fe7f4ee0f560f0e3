"""What touches elsewhere already lands at its own time: in kinks of the ground, and on corners."""

import numpy as np
import pytest

from sandbox.model.level import Level
from tests.physics.contacts.direct.courses import course
from tests.physics.scenes import GRAVITY, Spec, box, disc, fixed, level

DIRECT: Spec = {**GRAVITY, "contact": {"solver": "direct"}, "friction": {}, "rotation": {}}

FOOT, TOP = (1, 0), (2.5, 0.6)

KINK = {
    "ground": fixed({"type": "polyline", "points": [[-10, 0], FOOT, TOP, [20, 0.6]]}, friction=0.8)
}

RAMP = {
    "ground": fixed({"type": "box", "width": 30, "height": 1}, (0, -0.5), friction=0.8),
    "ramp": fixed({"type": "polygon", "vertices": [FOOT, TOP, [2.5, 0]]}, friction=0.8),
}

COMING: dict[str, Spec] = {
    "disc": disc((0, 0.4), radius=0.4, mass=2, velocity=[3, 0], angular_velocity=-7.5),
    "box": box((0, 0.2), size=(0.8, 0.4), mass=2, velocity=[4, 0]),
}


def coming(what: str, ground: dict[str, Spec], rate: float, e: float | None = None) -> Level:
    bodies = {**ground, what: {**COMING[what], "friction": 0.01 if what == "box" else 0.75}}
    if e is None:
        return level(bodies, DIRECT, stepping={"rate": rate})
    bounces = {name: {**body, "restitution": e**0.5} for name, body in bodies.items()}
    return level(bounces, {**DIRECT, "restitution": {}}, stepping={"rate": rate})


@pytest.mark.parametrize("e", [None, 0.5])
def test_a_wheel_meets_the_next_side_as_it_meets_another_body(e: float | None) -> None:
    """It was 1 cm deep at 60 Hz, with 0.2 J and 5e-3 N s that had no cause."""
    (kink, energy, momentum), (ramp, *_) = (
        course(coming("disc", ground, 60, e), 0.5) for ground in (KINK, RAMP)
    )

    assert np.abs(kink.position[-1] - ramp.position[-1]).max() <= 1e-7
    assert np.abs(kink.velocity[-1] - ramp.velocity[-1]).max() <= 1e-6
    assert energy <= 1e-3
    assert momentum <= 1e-12


@pytest.mark.parametrize("rate", [60, 240])
def test_a_box_meets_the_next_side_with_its_corner(rate: float) -> None:
    """It was 12 and 3 mm deep, and lost 0.2 and 0.07 J without a cause."""
    _, energy, momentum = course(coming("box", KINK, rate), 0.6)

    assert energy <= 8e-4 * (60 / rate) ** 2 * 1.1
    assert momentum <= 1e-12


@pytest.mark.parametrize("rate", [60, 240])
def test_the_other_corner_of_a_box_that_bounces_lands_at_its_own_time(rate: float) -> None:
    """It was met where the step ended: 0.5 and 0.1 mm deep, and 2.7e-3 J had no cause at 240 Hz."""
    rocking = box((0, 0.36), size=(0.6, 0.4), mass=2, velocity=[0.5, 0], angle=0.25)
    bodies = {"floor": fixed({"type": "box", "width": 30, "height": 1}, (0, -0.5)), "box": rocking}
    bounces = {
        name: {**body, "friction": 0.7, "restitution": 0.63} for name, body in bodies.items()
    }
    scene = level(bounces, {**DIRECT, "restitution": {}}, stepping={"rate": rate})
    _, energy, momentum = course(scene, 1.0)

    assert energy <= 2.3e-3 * (60 / rate) ** 2 * 1.2
    assert momentum <= 1e-12
