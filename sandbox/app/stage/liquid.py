"""Draws the liquid of buoyancy, which fills everything below its surface."""

from math import ceil

import pygame

from sandbox.app.drawing import theme
from sandbox.app.drawing.camera import Camera
from sandbox.physics.stepping.world import World

SHARE = 0.14  # of the liquid's colour, mixed with that of the stage
VEIL = 60  # opacity over bodies, from 0 to 255


def draw_liquid(surface: pygame.Surface, camera: Camera, world: World) -> None:
    """Draw the liquid behind everything, with a line along its surface."""
    if (area := _area(surface, camera, world)) is not None:
        surface.fill(theme.mix(theme.STAGE, theme.ACCENT, SHARE), area)
        surface.fill(theme.ACCENT, (area.x, area.y, area.width, 2))


def draw_veil(surface: pygame.Surface, camera: Camera, world: World) -> None:
    """Draw a translucent layer over the bodies in the liquid."""
    if (area := _area(surface, camera, world)) is not None:
        veil = pygame.Surface(area.size, pygame.SRCALPHA)
        veil.fill((*theme.mix(theme.STAGE, theme.ACCENT, SHARE), VEIL))
        surface.blit(veil, area)


def _area(surface: pygame.Surface, camera: Camera, world: World) -> pygame.Rect | None:
    """Return the visible area of the liquid, or None."""
    liquid = world.level.effects.buoyancy
    if liquid is None:
        return None
    top = ceil(camera.to_screen((0.0, liquid.surface(world.values)))[1])
    area = pygame.Rect(0, top, surface.width, surface.height - top).clip(surface.get_rect())
    return area if area.height else None
