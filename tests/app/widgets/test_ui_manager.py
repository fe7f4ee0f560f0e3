"""Removed widgets leave nothing behind."""

import gc
from collections.abc import Sequence

import pygame
import pytest
from pygame_gui.core import UIElement
from pygame_gui.core.utility import set_default_manager

from sandbox.app.files.preferences import Preferences
from tests.app.person import Person


def lost(person: Person, known: Sequence[UIElement] = ()) -> list[UIElement]:
    """Return the widgets that still exist but are not in the window, except given ones."""
    gc.collect()
    shown = person.window.panels.manager.get_sprite_group().sprites()
    passed = {id(each) for each in (*shown, *known)}
    return [o for o in gc.get_objects() if isinstance(o, UIElement) and id(o) not in passed]


@pytest.mark.sweep
def test_a_window_in_another_size_of_text_keeps_no_widget_of_the_old_one(person: Person) -> None:
    """pygame_gui keeps its first manager as the default: 50 MB in a full window."""
    of_others = lost(person)
    set_default_manager(person.window.panels.manager)  # as that of the first window is
    person.window.open_level("newton/atwood")
    person.wait(0.2)

    person.window.comfort.choose(**{**Preferences().model_dump(), "size": 150})
    person.wait(0.2)

    assert lost(person, of_others) == []


def test_a_page_that_was_left_is_gone_with_its_widgets(person: Person) -> None:
    """The editor held the page whose names it was asked to complete."""
    of_others = lost(person)
    person.window.open_level("newton/atwood")
    person.press(pygame.K_b, "b")
    person.wait(0.2)
    person.press(pygame.K_o, "o")
    person.wait(0.2)

    assert lost(person, of_others) == []


def test_no_note_is_kept_of_where_widgets_were(person: Person) -> None:
    person.window.open_level("newton/atwood")
    person.press(pygame.K_b, "b")
    person.press(pygame.K_o, "o")

    assert person.window.panels.manager.get_sprite_group().lostsprites == []
