"""Every named quantity against its definition, on one state and on a run."""

import numpy as np
import pytest

from sandbox.model.level import Level
from sandbox.model.quantities import QuantityError, quantities
from sandbox.physics.measure import Meter
from sandbox.physics.world import build
from tests.physics.scenes import GRAVITY, G, atwood, box, disc, fixed, level, run

SCENE = level(
    {
        "wheel": disc((1, 2), mass=2, velocity=[3, 4], angular_velocity=5),
        "post": fixed({"type": "disc", "radius": 0.1}, (50, 50)),
        "block": box((-1, 0), mass=4, velocity=[0, 1]),
    },
    {**GRAVITY, "rotation": {}},
)
INERTIA = 2 * 0.5**2 / 2  # kg m², of the wheel

AT_THE_START = {
    "t": 0,
    "wheel.position.x": 1,
    "wheel.position": 5**0.5,
    "wheel.speed": 5,
    "wheel.velocity": 5,
    "wheel.momentum.y": 8,
    "wheel.acceleration.y": -G,
    "wheel.angular_velocity": 5,
    "wheel.kinetic_energy": 2 * 25 / 2 + INERTIA * 25 / 2,
    "wheel.potential_energy": 2 * G * 2,
    "wheel.energy": 25 + INERTIA * 25 / 2 + 4 * G,
    "wheel.contact.normal": 0,
    "post.energy": 0,
    "post.position.x": 50,
    "system.center.x": (2 * 1 + 4 * -1) / 6,
    "system.center.y": 4 / 6,
    "system.momentum.x": 6,
    "system.momentum.y": 12,
    "system.kinetic_energy": 25 + INERTIA * 25 / 2 + 2,
    "system.potential_energy": 4 * G,
    "system.angular_momentum": 2 * (1 * 4 - 2 * 3) + INERTIA * 5 + 4 * (-1 * 1),
}


@pytest.mark.parametrize("name", AT_THE_START)
def test_a_quantity_is_what_its_definition_says(name: str) -> None:
    world = build(SCENE)

    assert Meter(world, [name])(world.snapshot)[name] == pytest.approx(
        AT_THE_START[name], rel=1e-12
    )


@pytest.mark.parametrize("scene", [SCENE, atwood(1, 2)], ids=["turning", "string"])
def test_every_quantity_is_the_same_on_a_run_as_on_each_of_its_states(scene: Level) -> None:
    names = [quantity.name for quantity in quantities(scene)]
    world = build(scene)
    meter = Meter(world, names)
    states = [world.snapshot, *(world.advance() for _ in range(5))]
    each = [meter(state) for state in states]
    together = meter(type(states[0]).stack(states))

    for name in names:
        assert together[name].shape == (6,)
        assert together[name] == pytest.approx(
            [float(one[name]) for one in each], rel=1e-14, abs=1e-14
        )


def test_an_unknown_quantity_is_refused_by_name() -> None:
    with pytest.raises(QuantityError, match=r"wheel\.velocity"):
        Meter(build(SCENE), ["wheel.velocty"])


def test_angular_momentum_stays_where_nothing_turns_the_system() -> None:
    """A free wheel far from the origin: L about the origin is constant to rounding."""
    scene = level({"wheel": disc((3, 4), velocity=[1, -2], angular_velocity=7)}, {"rotation": {}})
    world = build(scene)
    momentum = Meter(world, ["system.angular_momentum"])(run(world, 60))["system.angular_momentum"]

    assert np.ptp(momentum) <= 1e-13 * abs(momentum[0])
