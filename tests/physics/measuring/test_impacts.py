"""The impacts of a step, from the impulses that the engine gave in it."""

import numpy as np
import pytest

from sandbox.model import level_catalog
from sandbox.model.loading import choose, load
from sandbox.physics.measuring.impacts import Impacts, impacts
from sandbox.physics.run import build
from sandbox.physics.stepping.world import World
from tests.physics.scenes import GRAVITY, G, box, floor, level


def opened(name: str, **settings: float) -> World:
    found = load(level_catalog.find(name))
    return build(found, choose(found, settings))


def struck(world: World, steps: int) -> list[Impacts]:
    """Return the impacts of some steps, of those that had any."""
    found = []
    for _ in range(steps):
        world.advance()
        if (now := impacts(world)) is not None:
            found.append(now)
    return found


@pytest.mark.parametrize(("m1", "m2"), [(1000.0, 1.0), (10.0, 10.0), (33.0, 0.7)])
def test_an_elastic_impact_gives_twice_the_reduced_mass_times_the_approach(
    m1: float, m2: float
) -> None:
    world = opened("momentum/elastic-heavy-on-light", m1=m1, m2=m2, v1=2.0, v2=0.0)

    found = struck(world, round(world.level.duration(world.values) / world.dt))

    assert len(found) == 1
    assert found[0].impulse == pytest.approx([2 * m1 * m2 / (m1 + m2) * 2.0], rel=1e-12)
    names = list(world.level.bodies)
    if m1 > m2:
        assert [names[i] for i in found[0].lighter] == ["second"]


@pytest.mark.sweep
def test_in_a_cradle_the_same_impulse_passes_through_every_pair() -> None:
    world = opened("momentum/cradle")
    v = np.sqrt(2 * 9.81 * (1 - np.cos(np.pi / 6)))  # after the fall of L (1 - cos 30°)

    (found,) = struck(world, round(1.0 / world.dt))

    assert len(found.bodies) == 4
    assert found.impulse == pytest.approx([v] * 4, rel=1e-3)  # 1 kg each
    assert found.at[:, 0] == pytest.approx([0.1, 0.3, 0.5, 0.7], abs=1e-6)


@pytest.mark.parametrize(
    "name", ["rotation/rolling", "energy/ramp", "newton/incline-with-friction"]
)
def test_what_rests_rolls_or_slides_strikes_nothing(name: str) -> None:
    assert struck(opened(name), 60) == []


@pytest.mark.parametrize("e", [0.0, 0.5])
def test_a_box_that_falls_on_the_floor_strikes_it_with_its_momentum(e: float) -> None:
    bounce = {"restitution": np.sqrt(e)} if e else {}  # of a pair the product counts
    scene = level(
        {"ground": floor(**bounce), "box": box((0, 2.25), **bounce)},
        {**GRAVITY, "contact": {}, **({"restitution": {}} if e else {})},
    )
    world = build(scene)

    momentum = np.sqrt(2 * G * 2.0)  # of 1 kg

    first = struck(world, 120)[0]

    late = G * world.dt  # that a step which finds it late, and its weight, add at the most
    assert first.momentum == pytest.approx(momentum, abs=late)
    assert first.impulse[0] == pytest.approx((1 + e) * momentum, abs=(1 + e) * late + late)
    assert first.at[0] == pytest.approx([0.0, 0.0], abs=0.12)


def test_the_record_of_a_step_is_not_even_made_where_nothing_strikes(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    world = opened("rotation/rolling")
    world.advance(10)
    assert len(world.contacts.bodies)
    monkeypatch.setattr(World, "last", property(lambda _: pytest.fail("the record was made")))

    assert impacts(world) is None
