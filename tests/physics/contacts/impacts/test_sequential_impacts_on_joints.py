"""Impacts in sequence of bodies that hang, or stand on tracks."""

from math import cos, sin, sqrt

import numpy as np
import pytest

from sandbox.model.expressions import Array
from sandbox.model.level import Level
from sandbox.model.level_catalog import find
from sandbox.model.loading import load
from sandbox.physics.contacts.impacts.pile_impacts import Pile
from sandbox.physics.engine.space_arrays import Integers
from sandbox.physics.run import build
from tests.physics.contacts.impacts.test_sequential_impacts import SEQUENCE, kinetic
from tests.physics.scenes import GRAVITY, G, Spec, box, disc, fixed, floor, level, run, worst


def hung(count: int, angle: float, e: float = 1, rate: float = 1000) -> Level:
    """Newton's cradle: balls on rods of 1 m, touching where they hang; the first is drawn aside."""
    names = [f"ball{i}" for i in range(count)]
    places = [(0.1 * i, 0.0) for i in range(count)]
    places[0] = (-sin(angle), 1 - cos(angle))
    rest: Spec = {"radius": 0.05, "restitution": sqrt(e)}
    return level(
        {name: disc(place, **rest) for name, place in zip(names, places, strict=True)},
        {**GRAVITY, **SEQUENCE},
        joints={
            f"rod{i}": {"type": "rod", "ends": [name, [0.1 * i, 1]], "length": 1}
            for i, name in enumerate(names)
        },
        stepping={"rate": rate},
    )


@pytest.mark.sweep
@pytest.mark.parametrize("count", [2, 5])
def test_a_cradle_of_rods_passes_the_swing_on(count: int) -> None:
    angle = 0.5
    world = build(hung(count, angle))
    flight = run(world, 1500)
    energy = kinetic(world, flight) + G * flight.position[..., 1].sum(axis=1)
    height = 1 - cos(angle)

    assert worst(energy, G * height) <= 2e-5  # 1.2e-5, leapfrog's own
    assert flight.position[:, -1, 1].max() == pytest.approx(height, rel=1e-5)
    assert np.abs(flight.velocity[1200:, 1:-1]).max(initial=0) <= 0.02


def test_an_impulse_passes_through_rods() -> None:
    """A ball hits the near one of two on a light rod, end on: it meets the mass of both."""
    rest: Spec = {"radius": 0.1, "restitution": 1}
    scene = level(
        {
            "shot": disc((-0.5, 0), velocity=[3, 0], **rest),
            "near": disc((0, 0), **rest),
            "far": disc((1, 0), **rest),
        },
        SEQUENCE,
        joints={"rod": {"type": "rod", "ends": ["near", "far"]}},
    )
    end = build(scene).advance(60)

    assert np.abs(end.velocity[:, 0] - [-1, 2, 2]).max() <= 1e-12


@pytest.mark.parametrize("start", [0.464, 0.466, 0.468])
def test_a_jerk_of_its_rope_does_not_soften_the_impact_after_it(start: float) -> None:
    """The rope is taut a step before the ball is at the wall, or at once, and takes up to 370 N."""
    ball = disc((start, -0.7), radius=0.05, velocity=[2, -3], restitution=1)
    wall = fixed({"type": "segment", "start": [0.6, -5], "end": [0.6, 5]}, restitution=1)
    rope = {"type": "rope", "ends": [[0, 0], "ball"], "length": 1}
    world = build(
        level({"ball": ball, "wall": wall}, SEQUENCE, joints={"r": rope}, stepping={"rate": 240})
    )
    flight = run(world, 13)

    assert flight.velocity[-1, 0, 0] < -1  # −1.4, −1.0, −2.7; by pymunk −0.23 in the second


def test_a_ball_that_bounces_less_and_less_comes_to_rest() -> None:
    scene = level(
        {"ball": disc((0, 1), restitution=0.5), "floor": floor(restitution=1)},
        {**GRAVITY, **SEQUENCE},
    )
    flight = run(build(scene), 180)

    assert np.abs(flight.velocity[150:, 0]).max() <= 1e-12
    assert worst(flight.normal[150:, 0], G) <= 1e-9


def test_carts_that_collide_in_sequence_stay_on_their_track() -> None:
    """Resting contacts are pymunk's: nothing vertical is ever measured, and impulses are."""
    scene = level(
        {
            "a": box((-2, 0.25), velocity=[2, 0], restitution=1),
            "b": box((1, 0.25), mass=3, restitution=1),
            "track": floor(restitution=0),
        },
        {**GRAVITY, **SEQUENCE},
    )
    flight = run(build(scene), 180)

    assert np.abs(flight.velocity[:, :, 1]).max() <= 1e-12
    assert np.abs(flight.acceleration[..., 1]).max() <= 1e-9
    assert worst(flight.velocity[-1, :2, 0], np.array([-1.0, 1.0])) <= 1e-12
    weight = flight.normal[:, 1] - 3 * G
    assert weight.sum() / 60 == pytest.approx(3, rel=1e-9), "the impulse, 3 kg · 1 m/s"


def test_what_hangs_side_by_side_does_not_collide_by_the_rounding_of_places(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Four balls are left at rest by the fifth: 231 impacts of 1e-14 m/s in 400 steps before.

    The blow of the fifth is the only one.
    """
    piles = []
    settle = Pile.settle

    def count(pile: Pile, bodies: Integers) -> Array:
        piles.append(bodies)
        return settle(pile, bodies)

    monkeypatch.setattr(Pile, "settle", count)

    build(load(find("momentum/cradle"))).advance(700)

    assert [len(bodies) for bodies in piles] == [4]
