"""Caches the pictures of widgets: one for each shape, size and set of colours."""

import pygame
from pygame_gui.core.surface_cache import SurfaceCache

MOST = 16_000_000
"""The largest total size of the pictures [bytes]."""


class AppearanceCache(SurfaceCache):
    """The pictures that were used last.

    pygame_gui packs them as rectangles into a few large pictures. Releasing them fragments the free
    space: after some minutes, storing a picture takes 8 ms.
    """

    def __init__(self) -> None:
        self._kept: dict[str, pygame.Surface] = {}
        self._bytes = 0

    def add_surface_to_cache(self, surface: pygame.Surface, string_id: str) -> None:
        """Store a picture under a name, and drop the least recently used ones."""
        self._drop(string_id)
        self._kept[string_id] = surface
        self._bytes += _size(surface)
        while self._bytes > MOST:
            self._drop(next(iter(self._kept)))

    def find_surface_in_cache(self, lookup_id: str) -> pygame.Surface | None:
        """Return the picture with a name, or None."""
        found = self._kept.pop(lookup_id, None)
        if found is not None:
            self._kept[lookup_id] = found
        return found

    def update(self) -> None:
        """Do nothing: pictures are stored at once."""

    def remove_user_from_cache_item(self, string_id: str) -> None:
        """Do nothing: another widget may use the picture."""

    def _drop(self, name: str) -> None:
        if name in self._kept:
            self._bytes -= _size(self._kept.pop(name))


def _size(surface: pygame.Surface) -> int:
    return surface.get_pitch() * surface.get_height()
