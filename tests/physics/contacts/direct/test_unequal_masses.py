"""Heavy bodies on very light ones."""

import pytest

from sandbox.model.level import Level
from sandbox.physics.energy.balance_check import Closer
from sandbox.physics.run import build
from tests.physics.scenes import GRAVITY, Spec, box, disc, fixed, level

RUBS: Spec = {"friction": 0.5**0.5}


def pressed(rate: float) -> Level:
    """A hundred tonnes on a disc of a gram."""
    bodies = {
        "ground": fixed({"type": "box", "width": 20, "height": 1}, (0, -0.5), **RUBS),
        "light": disc((0, 0.1), radius=0.1, mass=1e-3, **RUBS),
        "heavy": box((0, 0.7), size=(1, 1), mass=1e5, **RUBS),
    }
    effects = {**GRAVITY, "contact": {"solver": "direct"}, "friction": {}, "rotation": {}}
    return level(bodies, effects, stepping={"rate": rate})


@pytest.mark.parametrize("rate", [60, 240])
def test_rounding_on_a_light_body_is_no_impact(rate: float) -> None:
    """The heavy body fell freely for half a kick, and left 1,340 and 459 J without a cause."""
    world = build(pressed(rate))
    books = Closer(world)
    for _ in range(int(rate)):
        world.advance()
        books.note()

    assert books.closing.unexplained <= 0.01
