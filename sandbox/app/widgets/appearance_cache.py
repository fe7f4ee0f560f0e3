"""The looks of widgets, kept to be drawn again: a shape of one size in one set of colours each."""

import pygame
from pygame_gui.core.surface_cache import SurfaceCache

MOST = 16_000_000
"""The bytes of pictures that are kept."""


class Looks(SurfaceCache):
    """The looks that were last wanted.

    pygame_gui fits them into a few large pictures, rectangle by rectangle. What is given back
    leaves ever smaller ones: after some minutes each look takes 8 ms to put away.
    """

    def __init__(self) -> None:
        self._kept: dict[str, pygame.Surface] = {}
        self._bytes = 0

    def add_surface_to_cache(self, surface: pygame.Surface, string_id: str) -> None:
        """Keep a picture under a name, and drop those that were unused for longest."""
        self._drop(string_id)
        self._kept[string_id] = surface
        self._bytes += _size(surface)
        while self._bytes > MOST:
            self._drop(next(iter(self._kept)))

    def find_surface_in_cache(self, lookup_id: str) -> pygame.Surface | None:
        """Return the look of a name; None if it is not kept."""
        found = self._kept.pop(lookup_id, None)
        if found is not None:
            self._kept[lookup_id] = found
        return found

    def update(self) -> None:
        """Put nothing away: all is where it stays."""

    def remove_user_from_cache_item(self, string_id: str) -> None:
        """Keep a look that one widget has no longer: another may want it."""

    def _drop(self, name: str) -> None:
        if name in self._kept:
            self._bytes -= _size(self._kept.pop(name))


def _size(surface: pygame.Surface) -> int:
    return surface.get_pitch() * surface.get_height()
