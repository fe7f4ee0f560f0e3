"""What is said to stay apart in a drift does, and most of what does is seen to."""

from cmath import rect
from itertools import product

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from sandbox.physics.contacts.detection.time_of_impact import Path, meet
from sandbox.physics.contacts.direct.prediction.convex_parts import ConvexParts
from sandbox.physics.contacts.direct.prediction.separation_bound import Separation
from sandbox.physics.geometry.outline_distance import Outline, gap, outlines
from sandbox.physics.run import build
from sandbox.physics.stepping.world import World
from tests.physics.scenes import box, disc, level

CORNER = {
    "type": "polygon",
    "vertices": [[-1, -1], [1, -1], [1, -0.8], [-0.8, -0.8], [-0.8, 1], [-1, 1]],
}

PAIRS = {
    "boxes": {"a": box(), "b": box((2, 0))},
    "box and disc": {"a": box(), "b": disc((2, 0))},
    "discs": {"a": disc(), "b": disc((2, 0))},
    "a hollow corner": {"a": {"mass": 1, "shape": CORNER}, "b": box((2, 0))},
}
"""Each turned and moved at random."""

DRIFT = 0.02
NUMBERS = st.floats(-3, 3)
STATES = st.tuples(*[st.tuples(NUMBERS, NUMBERS, NUMBERS)] * 2).map(np.array)


def world_of(pair: str) -> World:
    return build(level(PAIRS[pair], {"contact": {}}))


@pytest.mark.sweep
@pytest.mark.parametrize("pair", PAIRS)
@given(place=STATES, velocity=STATES, acceleration=STATES)
def test_what_stays_apart_for_certain_never_meets(
    pair: str, place: np.ndarray, velocity: np.ndarray, acceleration: np.ndarray
) -> None:
    bodies = list(world_of(pair).scene.bodies.values())
    shapes = ConvexParts(bodies)
    path = Path(place, 20 * velocity, 300 * acceleration)
    left = Separation(shapes, path, DRIFT).unsure((0, 1))
    own, others = ([o for o in outlines(bodies) if o.body == body] for body in (0, 1))
    sure = set(product(range(len(own)), range(len(others)))) - set(left)
    assume(sure)
    for first, second in sure:
        one, other = own[first], others[second]
        for t in np.linspace(0, DRIFT, 50):
            assert distance(path.pose_at(t), one, other) > 0
        assert meet(path, one, other, 0.0, DRIFT, np.zeros((2, 2, 3))) is None


def test_what_only_passes_by_is_known_to() -> None:
    """Side by side, corner by corner, and turning away: nobody need look for when they meet."""
    place = np.array([(0, 0, 0), (0.51, 0.3, 0.0)])
    assert not unsure("boxes", place, np.array([(0, 0, 0), (0, 5.0, 0)]))
    assert not unsure(
        "boxes", place + np.array([(0, 0, 0), (0, 0.21, 0.8)]), np.array([(0, 0, 0), (1, 5, 2)])
    )
    assert unsure("boxes", place, np.array([(0, 0, 0), (-5.0, 0, 0)])) == [(0, 0)]


def test_of_a_body_only_the_parts_that_may_be_met_are_left() -> None:
    bodies = list(world_of("a hollow corner").scene.bodies.values())
    right = max(
        (c for o in outlines(bodies) if o.body == 0 for c in o.corners), key=lambda c: c.real
    )
    place = np.array([(0, 0, 0), (right.real + 0.26, right.imag, 0)])
    found = unsure("a hollow corner", place, np.array([(0, 0, 0), (-5.0, 0, 0)]))

    assert len(found) == 1


def unsure(pair: str, place: np.ndarray, velocity: np.ndarray) -> list[tuple[int, int]]:
    """Return which parts of two bodies may meet within the drift."""
    shapes = ConvexParts(list(world_of(pair).scene.bodies.values()))
    path = Path(place, velocity, np.zeros((2, 3)))
    return Separation(shapes, path, DRIFT).unsure((0, 1))


def distance(place: np.ndarray, one: Outline, other: Outline) -> float:
    """Return how far two shapes are apart [m]."""
    (x, y, angle), (u, v, turn) = place.tolist()
    here = [complex(x, y) + rect(1, angle) * corner for corner in one.corners]
    there = [complex(u, v) + rect(1, turn) * corner for corner in other.corners]
    return gap(here, there, one.radius + other.radius).distance
