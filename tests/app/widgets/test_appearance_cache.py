"""The looks of widgets are kept while they are used, within the stated memory."""

import pygame
import pytest

from sandbox.app.widgets import appearance_cache
from sandbox.app.widgets.appearance_cache import AppearanceCache
from tests.app.person import Person


def picture(side: int) -> pygame.Surface:
    return pygame.Surface((side, side), pygame.SRCALPHA, 32)


def test_what_nobody_has_wanted_for_longest_goes_first(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(appearance_cache, "MOST", 3 * 100)
    kept = AppearanceCache()
    for name in ("first", "second", "third"):
        kept.add_surface_to_cache(picture(5), name)
    wanted = kept.find_surface_in_cache("first")

    kept.add_surface_to_cache(picture(5), "fourth")

    assert wanted is not None
    assert kept.find_surface_in_cache("first") is wanted
    assert kept.find_surface_in_cache("second") is None


def test_a_look_that_is_drawn_anew_takes_the_place_of_the_old_one(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(appearance_cache, "MOST", 3 * 100)
    kept = AppearanceCache()
    for _ in range(9):
        kept.add_surface_to_cache(picture(5), "same")
    kept.add_surface_to_cache(picture(5), "other")

    assert kept.find_surface_in_cache("same") is not None
    assert kept.find_surface_in_cache("other") is not None


def test_the_window_keeps_its_looks_there(person: Person) -> None:
    assert isinstance(person.window.panels.manager.get_theme().shape_cache, AppearanceCache)
