"""Drives that nothing can give way to are told as such, and no higher rate is advised."""

import pytest

from sandbox.model.level import Level
from sandbox.physics.advising.remedy_trials import with_advice
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import BlockedError
from tests.physics.scenes import GRAVITY, Spec, box, fixed, floor, level

ROUGH: Spec = {**GRAVITY, "contact": {"solver": "direct"}, "friction": {}, "rotation": {}}


def crushed() -> Level:
    """A plate is driven down on boxes that stand on the floor."""
    row = {f"box{i}": box((0.2 * i, 0.1), size=(0.19, 0.2), friction=0.5) for i in range(3)}
    plate: Spec = {
        "type": "kinematic",
        "shape": {"type": "box", "width": 2, "height": 0.1},
        "position": [0.2, 0.3],
        "motion": {"displacement": [0, "-0.2*t"]},
        "friction": 0.5,
    }
    return level({**row, "plate": plate, "floor": floor(friction=0.5)}, ROUGH)


def pushed() -> Level:
    """A rod that grows pushes a block against a stop."""
    stop = fixed({"type": "box", "width": 0.2, "height": 1}, (0.5, 0.5), friction=0.5)
    bodies = {"block": box((0, 0.1), size=(0.2, 0.2), friction=0.5), "stop": stop}
    rod: Spec = {"type": "rod", "ends": ["block", [-2, 0.1]], "length": "2 + 0.2*t"}
    return level({**bodies, "floor": floor(friction=0.5)}, ROUGH, joints={"rod": rod})


@pytest.mark.parametrize("scene", [crushed(), pushed()], ids=["plate", "rod"])
def test_no_rate_is_advised_where_nothing_can_give_way(scene: Level) -> None:
    """They were told to take a rate of 960 Hz, at which they stop as well."""
    world = build(scene)
    with pytest.raises(BlockedError, match="nothing can give way") as stopped:
        world.advance(200)

    error = with_advice(stopped.value, scene, world.values, world.stepping)
    assert error.rate is None
    assert "rate" not in str(error)
