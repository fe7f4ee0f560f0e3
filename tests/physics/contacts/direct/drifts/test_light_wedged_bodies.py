"""Light bodies wedged under heavy ones, whose drifts are cut."""

import pytest

from sandbox.physics.energy.ledger import Ledger
from sandbox.physics.run import build
from tests.physics.scenes import GRAVITY, box, floor, level


@pytest.mark.sweep
@pytest.mark.parametrize(("off", "speed"), [(0.25, 0.0), (0.05, 2.0)])
def test_the_books_close_on_a_light_plate_under_a_heavy_block(off: float, speed: float) -> None:
    """The forces on the plate cancel, but not with the rows at the end of a drift that is cut.

    Traced back with these, they gave the plate hundreds of m/s: 1.3e6 J went into friction, and
    sliding, the block threw the plate 11 m away.
    """
    size = (0.4, 0.2)
    bodies = {
        "floor": floor(friction=0.5),
        "plate": box((0, 0.1), size=size, mass=1e-3, friction=0.5),
        "block": box((off, 0.3), size=size, mass=1e5, friction=0.5, velocity=(speed, 0)),
    }
    effects = {**GRAVITY, "contact": {}, "friction": {}, "rotation": {}}
    world = build(level(bodies, effects, stepping={"rate": 240}, duration=0.4))
    ledger = Ledger(world)
    for _ in range(96):
        world.advance()
        ledger.note()

    assert abs(ledger.balance.unexplained) < 500  # J, of 1e5; measured: 44 and 92
    assert abs(float(world.snapshot.position[1, 0])) < 0.5  # m
