"""Lines that reach far out of a picture are clipped before they are drawn."""

from collections.abc import Callable
from random import Random

import pygame
import pytest

from sandbox.app.drawing import lines
from sandbox.model.shapes import XY

RED = 255, 0, 0


@pytest.fixture
def surface() -> pygame.Surface:
    return pygame.Surface((100, 100))


def test_a_line_keeps_its_way_where_it_is_cut() -> None:
    a, b = lines.clip([(0.0, 10.0), (4e6, 8e6 + 10)])[:2]

    assert a == (0.0, 10.0)
    assert b == pytest.approx(((lines.EDGE - 10) / 2, lines.EDGE))


def test_of_a_line_that_passes_by_nothing_is_drawn(surface: pygame.Surface) -> None:
    lines.stroke(surface, RED, (-1e4, 6e3), (1e4, 6e3), 2)

    assert not pygame.mask.from_threshold(surface, RED, (1, 1, 1)).count()


@pytest.mark.parametrize("most", [1e6, 1e12, 1e37, 1e40, 1e150, 1e307, float("inf"), float("nan")])
@pytest.mark.parametrize("draw", [lines.fill, lines.path, lines.dashed])
def test_however_far_out_something_reaches_it_is_drawn_at_once(
    surface: pygame.Surface, draw: Callable[..., None], most: float
) -> None:
    """pygame's own functions visit each of its pixels, or never finish."""
    random = Random(1)

    def somewhere() -> XY:
        return most * random.uniform(-1, 1), random.choice((most, 1e4, 10)) * random.uniform(-1, 1)

    for _ in range(50):
        corners = [somewhere() for _ in range(4)]
        assert all(lines.are_close([corner]) for corner in lines.clip(corners))
        draw(surface, RED, corners, *([2] if draw is lines.path else []))
