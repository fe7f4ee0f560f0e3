"""Convex parts: which side shows best that two are apart, and where they are placed."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sandbox.physics.contacts.direct.prediction.convex_parts import (
    PLACEMENTS,
    ConvexPart,
    ConvexParts,
)
from sandbox.physics.joints.exact.constraint_interface import Coordinates
from sandbox.physics.run import build
from tests.physics.scenes import box, disc, level

NUMBERS = st.floats(-2, 2)


@pytest.fixture
def shapes() -> ConvexParts:
    """A box and a disc."""
    world = build(level({"box": box(), "ball": disc((3, 0))}, {"contact": {}}))
    return ConvexParts(list(world.scene.bodies.values()))


def somewhere(x: float) -> Coordinates:
    """Places of two bodies and the plane."""
    return Coordinates.of(np.array([x, 3.0, 0.0], dtype=complex), np.zeros(3))


def test_what_is_asked_for_again_is_placed_already(shapes: ConvexParts) -> None:
    """A drift is looked at from its start again and again: by value, not by what holds it."""
    once = shapes.at(somewhere(0))
    shapes.at(somewhere(1))

    assert shapes.at(somewhere(0)) is once
    assert shapes.at(somewhere(1)) is not once


def test_only_the_last_places_are_remembered(shapes: ConvexParts) -> None:
    once = shapes.at(somewhere(0))
    for x in range(1, PLACEMENTS + 1):
        shapes.at(somewhere(x))

    assert shapes.at(somewhere(0)) is not once


@given(NUMBERS, NUMBERS, st.floats(0, 6))
def test_the_side_that_shows_best_is_the_one_of_the_largest_of_the_least_heights(
    x: float, y: float, angle: float
) -> None:
    one, other = square().placed(0j, 1 + 0j), square().placed(complex(x, y), np.exp(1j * angle))
    heights = [min(way.real for way in one.seen(other, side)) for side in range(4)]

    apart, side = one.shows(other)

    assert side == heights.index(max(heights))
    assert apart == max(heights)


def square() -> ConvexPart:
    """One of 1 m."""
    corners = [complex(x, y) / 2 for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return ConvexPart(corners, [-1j, 1 + 0j, 1j, -1 + 0j], [1.0] * 4, 0.0, 0j, abs(corners[0]))
