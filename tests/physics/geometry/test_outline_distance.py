"""Gaps between outlines."""

import numpy as np
import pymunk
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from sandbox.physics.geometry.outline_distance import Outline, gap, outlines

SQUARE = (-1 - 1j, 1 - 1j, 1 + 1j, -1 + 1j)


def test_two_squares_side_by_side_touch_at_two_points() -> None:
    found = gap(SQUARE, [c + 2.5 + 0.2j for c in SQUARE], 0.1)

    assert found.distance == pytest.approx(0.4, rel=1e-14)
    assert found.normal == 1
    assert sorted(p.imag for p in found.points) == pytest.approx([-0.8, 1])
    assert all(p.real == pytest.approx(1) for p in found.points)


def test_squares_at_their_corners_are_as_far_as_these() -> None:
    found = gap(SQUARE, [c + 5 + 6j for c in SQUARE], 0.5)

    assert found.distance == pytest.approx(4.5)
    assert found.normal == pytest.approx(0.6 + 0.8j)
    assert found.points == (1 + 1j,)


def test_corners_that_rounding_puts_at_one_place_have_no_side_between_them() -> None:
    """A box of 1e-15 m by 2 m, a metre from the origin."""
    flat = [1 - 1j, 1 - 1j, 1 + 1j, 1 + 1j]

    assert gap(SQUARE, [c + 2 for c in flat], 0.0).distance == pytest.approx(2)


def test_shapes_so_far_away_that_rounding_leaves_one_place_are_points() -> None:
    far = 1e95 + 1e95j, -1e64 + 0j

    found = gap([c + far[0] for c in SQUARE], [c + far[1] for c in SQUARE], 0.0)

    assert found.distance == pytest.approx(abs(far[0]), rel=1e-12)


def test_an_overlap_is_a_negative_gap_along_the_shortest_way_out() -> None:
    found = gap(SQUARE, [c + 0.3 - 1.8j for c in SQUARE], 0.0)

    assert found.distance == pytest.approx(-0.2)
    assert found.normal == pytest.approx(-1j)
    assert gap((0.9 + 0.1j,), SQUARE, 0.25).distance == pytest.approx(-0.35)


def test_a_point_near_a_side_has_its_normal_to_the_last_digit() -> None:
    found = gap((0.3 + 1j + 1e-8j,), SQUARE, 0.0)

    assert found.normal == -1j
    assert found.distance == pytest.approx(1e-8, rel=1e-7)


GRID = st.integers(-100, 100).map(lambda i: i / 100)
CORNERS = st.lists(st.builds(complex, GRID, GRID), min_size=1, max_size=7)


def hull(points: list[complex]) -> list[complex]:
    shape = pymunk.Poly(pymunk.Body(1, 1), [(p.real, p.imag) for p in points])
    return list(dict.fromkeys(complex(*corner) for corner in shape.get_vertices()))


@pytest.mark.sweep
@settings(max_examples=200, deadline=None)
@given(CORNERS, CORNERS, GRID.map(lambda x: 4 * x), GRID.map(lambda y: 3 * y))
@example([0j, -0.01j], [0.01 + 0j, -0.01 - 0.01j], 0.0, 0.0)  # lines that cross
@example([0j, 0.3 + 0.1j], [0.6 + 0.2j, 0.9 + 0.3j], 0.0, 0.0)  # in one line, and apart
def test_the_gap_is_that_between_the_nearest_points(
    ones: list[complex], others: list[complex], x: float, y: float
) -> None:
    """Against points strewn along both outlines."""
    one, other = hull(ones), [c + complex(x, y) for c in hull(others)]
    found = gap(one, other, 0.0)
    if found.distance < 0:
        return
    share = np.linspace(0, 1, 101)

    def strewn(core: list[complex]) -> np.ndarray:
        return np.concatenate([core[i - 1] + share * (c - core[i - 1]) for i, c in enumerate(core)])

    nearest = np.abs(strewn(one)[:, None] - strewn(other)[None]).min()
    assert found.distance <= nearest + 1e-12
    assert found.distance >= nearest - 0.03
    assert abs(found.normal) == pytest.approx(1, abs=1e-9)


def test_outlines_come_in_an_order_of_their_own() -> None:
    body = pymunk.Body(1, 1)
    space = pymunk.Space()
    space.add(body)
    for x in (3, 1, 2):
        space.add(pymunk.Circle(body, 0.5, (x, 0)))
    space.add(pymunk.Segment(body, (0, 0), (1, 0), 0.1), pymunk.Segment(body, (1, 0), (1, 2), 0.1))

    found = outlines([body])
    assert [o.corners for o in found] == [(0j, 1), (1,), (1, 1 + 2j), (2,), (3,)]
    assert found[0] == Outline(0, (0j, 1 + 0j), 0.1, 1.0, 0, (0j, 2j))
    assert found[2].continuations == (-1, 0)
