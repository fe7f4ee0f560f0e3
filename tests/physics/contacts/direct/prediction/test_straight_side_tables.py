"""The straight sides of bodies: those in one line count as one."""

from collections.abc import Sequence
from itertools import pairwise
from time import process_time

import numpy as np
import pymunk
import pytest

from sandbox.physics.contacts.direct.prediction.convex_parts import parts_of
from sandbox.physics.contacts.direct.prediction.straight_side_tables import Sides

POINTS = [(-2, 0), (-1, 0), (0, 0), (1, -1), (2, -1)]


def sides_of(points: Sequence[tuple[float, float]], half: float = 0.0) -> Sides:
    """The sides of a line through some points, beside a disc, which has none."""
    line, wheel = pymunk.Body(), pymunk.Body()
    shapes = [pymunk.Segment(line, a, b, half) for a, b in pairwise(points)]
    return Sides([parts_of([pymunk.Circle(wheel, 1)]), parts_of(shapes)])


def test_segments_that_go_straight_on_have_one_side() -> None:
    sides = sides_of(POINTS)
    up = np.flatnonzero(np.abs(sides.normal[1] - 1j) < 1e-9)

    assert sides.any.tolist() == [False, True]
    assert np.count_nonzero(np.isfinite(sides.height[1])) == 6  # three, seen from above and below
    lengths = sorted((sides.end - sides.begin)[1, up])
    assert lengths == pytest.approx([1, 2])


@pytest.mark.parametrize("half", [0.0, 0.1])
def test_the_sides_at_a_corner_lead_away_from_it(half: float) -> None:
    found = list(sides_of(POINTS, half).at(1, 0j))

    ways = [1j * way * normal for normal, _, way in found]
    assert sorted(np.angle(ways)) == pytest.approx([-np.pi / 4] * 2 + [np.pi] * 2)
    assert [abs(foot) for _, foot, _ in found] == pytest.approx([half] * 4)
    assert not list(sides_of(POINTS).at(0, 0j))


def test_a_point_on_a_side_faces_it_alone() -> None:
    sides = sides_of(POINTS)

    on, along = sides.facing(np.array([1]), np.array([1j]), np.array([-1.5 + 0j]))

    assert np.count_nonzero(on) == 1
    assert sides.begin[1, on[0]] <= along[0] <= sides.end[1, on[0]]
    assert along == pytest.approx([1.5])  # positions count to the left of the normal


def test_a_line_of_thousands_of_points_is_laid_out_quickly() -> None:
    points = [(x / 100, 0.1 * np.sin(x / 100)) for x in range(3000)]
    begun = process_time()

    sides = sides_of(points)

    assert np.count_nonzero(np.isfinite(sides.height[1])) == 5998
    assert process_time() - begun < 1.0
