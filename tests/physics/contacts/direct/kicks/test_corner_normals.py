"""Corners that meet corners keep their normal."""

import json
from math import cos, pi, sin, sqrt

import numpy as np
import pytest

from sandbox.model.level_catalog import root
from sandbox.model.loading import parse
from sandbox.physics.run import build
from sandbox.physics.stepping.world import World
from tests.physics.scenes import GRAVITY, G, Spec, box, fixed, level

HALF = 0.25 * sqrt(2)
"""m, from the middle of a box of 0.5 m to its corners."""


def tip_on_tip(spin: float, rate: float) -> World:
    """Return a box that stands with a corner on a corner, and turns about it [rad/s]."""
    square: Spec = {"type": "box", "width": 0.5, "height": 0.5}
    lower = fixed(square, (0, -HALF), angle=pi / 4, friction=5)
    turns: Spec = {"angular_velocity": spin, "velocity": [-spin * HALF, 0]}
    upper = box((0, HALF), angle=pi / 4, friction=5, **turns)
    effects = {**GRAVITY, "contact": {"solver": "direct"}, "friction": {}, "rotation": {}}
    return build(level({"lower": lower, "upper": upper}, effects, stepping={"rate": rate}))


@pytest.mark.parametrize("steps", [40, pytest.param(720, marks=pytest.mark.sweep)])
def test_a_house_of_cards_stands_at_240_hz(steps: int) -> None:
    """In 3 s no card moves by 2e-14 m; with pymunk's normals at the tips it was 2.5e-8 m."""
    house = json.loads((root() / "hard/house-of-cards.json").read_text())
    house["effects"]["contact"]["solver"] = "direct"
    house["stepping"] = {"rate": 240}
    world = build(parse(json.dumps(house)))
    start = world.snapshot.position

    moved = max(float(np.abs(world.advance().position - start).max()) for _ in range(steps))
    assert moved <= 1e-12


def test_what_stands_on_a_tip_stands_until_it_is_disturbed() -> None:
    """It used to be pushed off by a normal that was wrong by some rounding."""
    assert np.abs(tip_on_tip(0, 240).advance(240).position[1] - (0, HALF)).max() <= 1e-13


@pytest.mark.parametrize(("spin", "rate", "bound"), [(0.5, 240, 1e-5), (-0.5, 960, 5e-7)])
def test_what_falls_over_a_tip_turns_about_it(spin: float, rate: int, bound: float) -> None:
    """It loses no energy, to second order: 3.6e-6 and 2.3e-7 J, and 1e-3 and 8e-5 before."""
    world = tip_on_tip(spin, rate)
    last = world.advance(rate // 4)
    turned, moment = last.angle[1] - pi / 4, 1 / 24 + HALF**2

    place = np.array([-sin(turned), cos(turned)]) * HALF
    assert np.abs(last.position[1] - place).max() <= 1e-7
    kinetic = moment * (last.angular_velocity[1] ** 2 - spin**2) / 2
    assert kinetic == pytest.approx(G * HALF * (1 - cos(turned)), abs=bound)
