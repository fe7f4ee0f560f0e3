"""Taking an overlap back parts nobody else: here light wheels that springs press on the ground."""

import numpy as np
import pytest

from sandbox.model.expressions import Array
from sandbox.physics.run import build
from validation.stability.hard_case import make
from validation.stability.scene_parts import Document

MASS, WHEEL, ARM = 2000.0, 10.0, 10.0
"""Of the chassis, and of each wheel with its arm [kg]."""

SPEED, RADIUS, RATE = 4.0, 0.4, 480


def car() -> Document:
    """Return a car on swing arms, on its way from a plane to a hill that bends at once."""
    moving = {"velocity": [SPEED, 0], "friction": 1}
    bodies: Document = {
        "plane": still({"type": "segment", "start": [-9, 0], "end": [1.5, 0]}),
        "hill": still(
            {"type": "curve", "curve": ["s", "0.05*(1 - cos(pi*(s - 1.5)))"], "s": [1.5, 9]}
        ),
        "chassis": {
            "shape": {"type": "box", "width": 3.2, "height": 0.8}, "mass": MASS,
            "position": [0, 1.2], **moving,
        },
    }  # fmt: skip
    joints: Document = {}
    for name, x in (("rear", -1.1), ("front", 1.1)):
        bodies[name] = {
            "shape": {"type": "disc", "radius": RADIUS}, "mass": WHEEL, "position": [x, RADIUS],
            "angular_velocity": -SPEED / RADIUS, **moving,
        }  # fmt: skip
        bodies[f"{name}_arm"] = {
            "shape": {"type": "segment", "start": [-0.3, 0.2], "end": [0.3, -0.2]}, "mass": ARM,
            "position": [x - 0.3, 0.6], **moving,
        }  # fmt: skip
        joints[f"{name}_pin"] = pivot("chassis", [x - 0.6, -0.4], f"{name}_arm", [-0.3, 0.2])
        joints[f"{name}_axle"] = pivot(f"{name}_arm", [0.3, -0.2], name, [0, 0])
        joints[f"{name}_spring"] = {
            "type": "spring", "ends": [{"body": "chassis", "at": [x, 0.3]}, name],
            "stiffness": 60000, "length": 1.27, "damping": 3000,
        }  # fmt: skip
    own = ["chassis", "rear", "front", "rear_arm", "front_arm"]
    return {
        "format": 1, "title": "Car", "bodies": bodies, "joints": joints,
        "effects": {
            "gravity": {"acceleration": [0, -9.81]}, "friction": {}, "rotation": {},
            "contact": {"apart": [own]},
        },
        "stepping": {"rate": RATE}, "duration": 1,
    }  # fmt: skip


def still(shape: Document) -> Document:
    """Return ground."""
    return {"type": "static", "shape": shape, "friction": 1}


def pivot(one: str, on_one: list[float], other: str, on_other: list[float]) -> Document:
    """Return a pin through two bodies."""
    return {
        "type": "pivot",
        "ends": [{"body": one, "at": on_one}, {"body": other, "at": on_other}],
    }


@pytest.fixture(scope="module")
def pressed() -> Array:
    """What carries each wheel on its way over the first half of the hill: (T, 2) [N]."""
    world = build(make(car()))
    names = list(car()["bodies"])
    wheels = [names.index("rear"), names.index("front")]
    return np.array([world.advance().normal[wheels] for _ in range(RATE // 4)])


def test_a_wheel_stays_on_the_ground_while_another_is_lifted_out_of_a_hill(pressed: Array) -> None:
    """It was a nanometre off, free for a step, and its spring shot it into the ground."""
    assert pressed.min() > MASS * 9.81 / 4
