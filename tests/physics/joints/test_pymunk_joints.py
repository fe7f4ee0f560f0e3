"""pymunk's own joints, which a level may ask for: they hold, but not to rounding."""

import numpy as np
import pymunk
import pytest

from sandbox.model.level import Level
from sandbox.physics.run import build
from tests.physics.scenes import GRAVITY, G, Spec, box, disc, level, measured


def own(kind: str, *ends: object, **rest: object) -> Spec:
    return {"type": kind, "ends": list(ends), "exact": False, **rest}


def pendulum(*, exact: bool) -> Level:
    rod = {"type": "rod", "ends": [[0, 0], "bob"], "exact": exact}
    return level({"bob": disc((1, 0))}, GRAVITY, joints={"rod": rod}, stepping={"rate": 480})


def test_an_exact_rod_is_the_better_one() -> None:
    def errors(*, exact: bool) -> tuple[float, float]:
        found = measured(build(pendulum(exact=exact)), 3 * 480, "rod.length", "bob.energy")
        return np.abs(found["rod.length"] - 1).max(), np.abs(found["bob.energy"]).max()

    assert max(errors(exact=True)) <= 2e-4  # 4e-16 m, 1.6e-4 J
    length, energy = errors(exact=False)
    assert 1e-3 <= length <= 5e-3  # 2.8e-3 m
    assert 0.05 <= energy <= 0.25  # 0.125 J of 9.8


def test_pymunks_own_joint_needs_no_callback() -> None:
    assert build(pendulum(exact=True)).hooks == 1
    assert build(pendulum(exact=False)).hooks == 0


def test_a_rod_that_hangs_carries_the_weight() -> None:
    hanging = level(
        {"bob": disc((0, -1), mass=2)}, GRAVITY, joints={"rod": own("rod", [0, 0], "bob")}
    )
    found = measured(build(hanging), 60, "rod.tension", "bob.position.y")

    assert found["rod.tension"][-1] == pytest.approx(2 * G, rel=1e-6)
    assert found["bob.position.y"][-1] == pytest.approx(-1, abs=1e-3)


def test_a_rod_has_the_length_that_is_asked_for_and_a_rope_is_slack_until_it_is_taut() -> None:
    """h = g t² / 2 until the rope of 1 m is taut, after 0.45 s."""
    scene = level(
        {"bob": disc((0, 0)), "held": disc((3, 0))},
        GRAVITY,
        joints={
            "rope": own("rope", [0, 0], "bob", length=1),
            "rod": own("rod", [3, 2], "held", length=2),
        },
        stepping={"rate": 240},
    )
    found = measured(build(scene), 240, "rope.length", "rope.tension", "rod.length", "t")
    falling = found["t"] < 0.44

    assert np.abs(found["rope.length"] - G * found["t"] ** 2 / 2)[falling].max() <= 1e-12
    assert not found["rope.tension"][falling].any()
    assert found["rope.length"].max() <= 1.03  # 4.43 m/s of a step, until the rope has it
    assert found["rope.tension"].max() > 100
    assert np.abs(found["rod.length"] - 2).max() <= 1e-3


def test_a_pivot_holds_the_end_of_a_stick() -> None:
    stick = {"body": "stick", "at": [-0.5, 0]}
    scene = level(
        {
            "stick": {
                "shape": {"type": "box", "width": 1, "height": 0.1},
                "mass": 1,
                "position": [0.5, 0],
            }
        },
        {**GRAVITY, "rotation": {}},
        joints={"pin": own("pivot", [0, 0], stick)},
        stepping={"rate": 240},
    )
    found = measured(build(scene), 240, "pin.length", "stick.angle")

    assert found["pin.length"].max() <= 5e-3
    assert found["stick.angle"].min() < -1


def test_a_weld_makes_two_bodies_one() -> None:
    scene = level(
        {"a": box((0, 0)), "b": box((1, 0))},
        {"rotation": {}, "force": [{"body": "a", "force": [0, 1], "at": [-0.2, 0]}]},
        joints={"weld": own("weld", "a", "b")},
        stepping={"rate": 240},
    )
    found = measured(build(scene), 240, "a.angle", "b.angle", "weld.torque", "weld.length")

    assert abs(found["a.angle"][-1]) > 0.1
    assert np.abs(found["a.angle"] - found["b.angle"]).max() <= 2e-3
    assert np.abs(found["weld.length"] - 1).max() <= 2e-3
    assert found["weld.torque"][-1] > 0


@pytest.mark.parametrize("rate", [2, -3])
def test_a_motor_turns_its_second_body_counterclockwise(rate: float) -> None:
    scene = level(
        {"arm": disc((0, 0))},
        {"rotation": {}},
        joints={"motor": own("motor", [0, 0], "arm", rate=rate)},
    )
    found = measured(build(scene), 60, "arm.angular_velocity")

    assert found["arm.angular_velocity"][-1] == pytest.approx(rate)


def test_without_rotation_nothing_holds_angles() -> None:
    scene = level({"a": box((0, 0)), "b": box((1, 0))}, {}, joints={"weld": own("weld", "a", "b")})
    world = build(scene)
    world.advance(10)

    assert not any(isinstance(c, pymunk.GearJoint) for c in world.scene.space.constraints)
    assert world.scene.joints.torque().tolist() == [0]


@pytest.mark.parametrize("kind", ["rod", "rope"])
def test_a_body_that_is_put_elsewhere_is_held_there(kind: str) -> None:
    scene = level({"bob": disc((0, -1))}, GRAVITY, joints={"tie": own(kind, [0, 0], "bob")})
    world = build(scene)
    world.place({"bob": (0, -2)})
    found = measured(world, 30, "tie.length")

    assert np.abs(found["tie.length"] - 2).max() <= 1e-2
