"""The rulers along two edges."""

import pygame
import pytest

from sandbox.app.drawing.camera import Camera
from sandbox.app.drawing.text import Pen
from sandbox.app.stage import grid

SIZE = (370, 540)


class Sheet(pygame.Surface):
    """A surface that remembers what was drawn on it, and where."""

    def __init__(self) -> None:
        super().__init__(SIZE)
        self.put: list[tuple[pygame.Surface, pygame.Rect]] = []

    def blit(self, source: pygame.Surface, dest: object = (0, 0), *_: object) -> pygame.Rect:
        assert isinstance(dest, pygame.Rect)
        self.put.append((source, dest))
        return dest


def rulers(pen: Pen, camera: Camera) -> Sheet:
    sheet = Sheet()
    grid.draw_rulers(sheet, camera, pen)
    return sheet


@pytest.mark.parametrize("tenth", range(10))
def test_no_number_is_cut_by_an_edge_or_by_the_corner(pen: Pen, tenth: int) -> None:
    camera = Camera(SIZE)
    camera.scale = 33.5
    camera.center = tenth / 2, tenth / 2

    *numbers, (_, unit) = rulers(pen, camera).put

    corner = unit.copy()
    corner.width, corner.left = 2 * unit.centerx, 0
    assert len(numbers) > 2
    assert all(pygame.Rect((0, 0), SIZE).contains(place) for _, place in numbers)
    assert unit.collidelist([place for _, place in numbers]) < 0
    assert corner.collidelist([place for _, place in numbers]) < 0


def test_numbers_far_from_the_origin_can_be_told_apart(pen: Pen) -> None:
    camera = Camera(SIZE)
    camera.center = 1e7, 0.0

    along = [image for image, place in rulers(pen, camera).put if place.top > SIZE[1] - grid.RULER]

    shown = {image.get_buffer().raw for image in along}
    assert len(along) > 2
    assert len(shown) == len(along)
