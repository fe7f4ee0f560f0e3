"""A liquid is drawn below its surface, and over the bodies in it."""

import numpy as np
import pygame

from sandbox.app.drawing import theme
from tests.app.person import Person


def test_it_fills_the_stage_below_its_surface_and_veils_what_is_within(person: Person) -> None:
    person.window.open_level("newton/floating-block")
    person.wait()

    def color(x: float, y: float) -> tuple[int, ...]:
        pixel = person.on_screen((x, y))
        return tuple(person.window.surface.get_at((round(pixel[0]), round(pixel[1]))))[:3]

    assert color(1.03, -0.53) == theme.mix(theme.STAGE, theme.ACCENT, 0.14)
    assert max(np.abs(np.subtract(color(1.03, 0.53), theme.STAGE))) < 16
    assert color(0.3, -0.2) != color(0.3, 0.5)  # of the block


def test_where_there_is_none_nothing_is_drawn(person: Person) -> None:
    person.window.open_level("kinematics/free-fall")
    person.wait()

    blue = theme.mix(theme.STAGE, theme.ACCENT, 0.14)
    pixels = pygame.surfarray.array3d(person.window.surface)
    assert not (pixels == blue).all(axis=2).any()
