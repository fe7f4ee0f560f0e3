"""Shapes look lit from the upper left, in themes that shade."""

from collections.abc import Iterator

import numpy as np
import pygame
import pytest

from sandbox.app.drawing import shading, theme
from sandbox.app.drawing.theme import Color
from sandbox.model.expressions import Array
from sandbox.model.shapes import XY

SIZE = (200, 200)
COLOR = (120, 90, 60)
SQUARE = [(50.0, 50.0), (150.0, 50.0), (150.0, 150.0), (50.0, 150.0)]


@pytest.fixture
def surface() -> pygame.Surface:
    blank = pygame.Surface(SIZE)
    blank.fill(theme.STAGE)
    return blank


@pytest.fixture
def flat() -> Iterator[None]:
    before = theme.used()
    theme.use("contrast")
    yield
    theme.use(before)


def bright(surface: pygame.Surface, at: XY) -> int:
    return sum(surface.get_at((round(at[0]), round(at[1])))[:3])


def pixels(surface: pygame.Surface) -> Array:
    return pygame.surfarray.array3d(surface).astype(float).sum(axis=2)


def test_a_disc_is_darker_on_the_side_away_from_the_light(surface: pygame.Surface) -> None:
    shading.disc(surface, COLOR, (100, 100), 60)

    assert surface.get_at((100, 100))[:3] == COLOR
    assert bright(surface, (72, 55)) > bright(surface, (128, 145))


@pytest.mark.parametrize("corners", [SQUARE, SQUARE[::-1]], ids=["clockwise", "the other way"])
def test_edges_towards_the_light_are_lighter(surface: pygame.Surface, corners: list[XY]) -> None:
    shading.bevel(surface, COLOR, corners, 3)
    top, right, bottom, left = (
        bright(surface, at) for at in ((100, 50), (150, 100), (100, 150), (50, 100))
    )

    assert top > left > sum(COLOR) > right > bottom


def test_ground_is_darker_with_depth(surface: pygame.Surface) -> None:
    shading.solid(surface, COLOR, SQUARE)
    drawn = pixels(surface)[60:140]

    assert drawn[:, 55:65].mean() > drawn[:, 135:145].mean() + 20


def test_ground_that_is_moved_keeps_its_grain(surface: pygame.Surface) -> None:
    shading.solid(surface, COLOR, SQUARE)
    moved = surface.copy()
    moved.fill(theme.STAGE)
    shading.solid(moved, COLOR, [(x + 17, y - 9) for x, y in SQUARE])

    assert (pixels(surface)[55:145, 55:145] == pixels(moved)[72:162, 46:136]).all()


@pytest.mark.parametrize("side", [1, -1])
def test_ground_fades_out_on_one_side_of_a_line(surface: pygame.Surface, side: int) -> None:
    shading.bank(surface, COLOR, [(20, 100), (100, 90), (180, 100)], side, 30)
    added = pixels(surface).mean(axis=0) - sum(theme.STAGE)
    above, below = added[60:85], added[105:130]
    empty, ground = (below, above[::-1]) if side > 0 else (above, below)

    assert (empty == 0).all()
    assert ground[0] > ground[12] > 0


def test_an_endless_line_has_ground_where_it_is_seen(surface: pygame.Surface) -> None:
    shading.bank(surface, COLOR, [(-1e300, 100), (1e300, 100)], -1, 30)

    assert bright(surface, (100, 103)) > bright(surface, (100, 97))


@pytest.mark.usefixtures("flat")
def test_a_theme_of_high_contrast_has_no_shades() -> None:
    surface = pygame.Surface(SIZE)
    shading.backdrop(surface)
    shading.bank(surface, COLOR, [(0, 20), (200, 20)], -1, 10)
    shading.disc(surface, COLOR, (40, 100), 30)
    shading.solid(surface, COLOR, [(90, 60), (190, 60), (190, 160), (90, 160)])

    inner = pygame.surfarray.array3d(surface)[[40, 40, 60, 130, 180], [25, 100, 115, 70, 150]]
    assert [tuple(color) for color in inner.tolist()] == [theme.STAGE, *4 * [COLOR]]


def test_what_is_drawn_on_a_colour_can_be_told_from_it() -> None:
    def apart(a: Color, b: Color) -> float:
        return float(np.abs(np.subtract(a, b)).mean())

    for color in (*theme.BODIES, (73, 80, 87), (240, 240, 240), (5, 5, 5)):
        assert apart(theme.contrasting(color), color) > 60
