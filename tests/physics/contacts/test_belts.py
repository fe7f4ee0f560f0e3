"""Surfaces that run."""

from math import cos, radians, sin

import numpy as np
import pytest

from sandbox.model.level import Level
from sandbox.physics.run import build
from tests.physics.scenes import GRAVITY, G, box, disc, fixed, level, measured, run, worst

SPEED, MU = 2.0, 0.4


def carried(
    angle: float = 0,
    *,
    start: float = 0,
    first: bool = False,
    static: float = MU,
) -> Level:
    """A block on a belt that runs to the right, and rises there by an angle."""
    way = [start * cos(angle), start * sin(angle)]
    block = box(angle=angle, velocity=way)
    side = fixed(
        {"type": "segment", "start": [-200, 0], "end": [200, 0]},
        (0.25 * sin(angle), -0.25 * cos(angle)),
        angle=angle,
    )
    bodies = {"belt": side, "block": block} if first else {"block": block, "belt": side}
    pair = {"bodies": ["block", "belt"], "coefficient": MU, "static": static}
    effects = {
        **GRAVITY,
        "contact": {},
        "friction": {"pairs": [pair]},
        "belt": [{"body": "belt", "velocity": [SPEED, 0]}],
    }
    return level(bodies, effects, stepping={"rate": 240})


@pytest.mark.parametrize("first", [True, False])
def test_a_block_is_driven_until_it_has_the_belts_speed(*, first: bool) -> None:
    """Uniformly, by mu g, and then not at all; whichever of the two is named first."""
    names = ("block.velocity.x", "block.position.x", "block.contact.friction", "t")
    found = measured(build(carried(first=first)), 480, *names)
    t, catches = found["t"], SPEED / (MU * G)
    slips, rides = t < catches - 1 / 240, t > catches + 1 / 240

    assert worst(found["block.velocity.x"][slips], MU * G * t[slips]) <= 1e-12
    assert worst(found["block.velocity.x"][rides], SPEED) <= 1e-12
    assert worst(found["block.contact.friction"][slips], MU * G) <= 1e-12
    assert np.abs(found["block.contact.friction"][rides]).max() <= 1e-9
    behind = SPEED * t[-1] - found["block.position.x"][-1]
    assert behind == pytest.approx(SPEED**2 / (2 * MU * G), rel=1e-4)  # 2e-5: second order


def test_a_belt_carries_uphill_what_its_friction_holds() -> None:
    """tan 20° = 0.36 is less than the coefficient: it rides at the belt's speed."""
    angle = radians(20)
    ride = run(build(carried(angle, start=SPEED)), 240)
    way = ride.position[:, 0] @ [cos(angle), sin(angle)]

    assert worst(way, SPEED * ride.t) <= 1e-12
    assert worst(ride.friction[:, 0], G * sin(angle)) <= 1e-10


@pytest.mark.parametrize(("start", "rides"), [(SPEED, True), (0.0, False)])
def test_what_moves_with_its_belt_sticks_and_what_stands_slips(
    start: float, *, rides: bool
) -> None:
    """At 25°, tan 25° = 0.47: above the kinetic 0.4, below the static 0.6."""
    angle = radians(25)
    ride = run(build(carried(angle, start=start, static=0.6)), 240)
    way = ride.position[:, 0] @ [cos(angle), sin(angle)]
    slides = G * (MU * cos(angle) - sin(angle)) * ride.t**2 / 2

    assert np.abs(way - (SPEED * ride.t if rides else slides)).max() <= 1e-10


def test_a_belt_pushes_with_the_momentum_that_its_load_gains() -> None:
    """∫ F dt = m v, summed from the contact force at the steps."""
    names = ("block.contact.friction", "block.momentum.x")
    found = measured(build(carried()), 480, *names)
    friction = found["block.contact.friction"]
    impulse = (friction.sum() - friction[0] / 2 - friction[-1] / 2) / 240

    assert impulse == pytest.approx(found["block.momentum.x"][-1], rel=1e-9)


def test_a_disc_on_a_belt_rolls_backwards_as_it_is_driven() -> None:
    """Free to roll, its centre gets a third of the belt's speed: I = m r²/2."""
    scene = level(
        {
            "ball": disc((0, 0.25)),
            "belt": fixed({"type": "box", "width": 90, "height": 1}, (0, -0.75)),
        },
        {
            **GRAVITY,
            "contact": {},
            "rotation": {},
            "friction": {"pairs": [{"bodies": ["ball", "belt"], "coefficient": MU}]},
            "belt": [{"body": "belt", "velocity": [SPEED, 0]}],
        },
        stepping={"rate": 240},
    )
    end = build(scene).advance(480)

    assert end.velocity[0, 0] == pytest.approx(SPEED / 3, rel=1e-9)
    assert end.angular_velocity[0] == pytest.approx((SPEED - SPEED / 3) / 0.5, rel=1e-9)
