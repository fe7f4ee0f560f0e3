"""Larger and smaller text fits everywhere."""

from itertools import product
from pathlib import Path

import pygame
import pytest
from pygame_gui.elements import UIButton, UITextEntryLine

from sandbox.app.drawing import theme
from sandbox.app.drawing.theme import Color
from sandbox.app.files import preferences
from sandbox.app.files.preferences import SIZES
from sandbox.app.pages.register import PAGES
from sandbox.app.panels.window_layout import divide
from sandbox.app.words.language import NAMES, Name
from tests.app.person import Person
from tests.app.scenes import falling
from tests.sample import thinned

SMALLEST, USUAL = (900, 600), (1280, 800)
CONTROL = pygame.KMOD_LCTRL
LOOKS = thinned(product([SMALLEST, USUAL], [80, 150, 200], NAMES), 5)
"""Of the window: how large it is, how large its text is [%], and its language."""


def choose(person: Person, size: int, language: Name = "en") -> None:
    person.window.comfort.choose(size=size, language=language)
    person.wait(0.05)


def widgets(person: Person) -> list[UIButton | UITextEntryLine]:
    """Return the visible buttons and fields."""
    return [
        each
        for each in person.window.panels.manager.get_sprite_group().sprites()
        if isinstance(each, UIButton | UITextEntryLine) and each.visible and each.alive()  # type: ignore[no-untyped-call]
    ]


@pytest.mark.sweep
def test_the_keys_go_through_the_sizes_and_back(person: Person) -> None:
    comfort = person.window.comfort
    found = [comfort.size]
    for _ in SIZES:
        person.press(pygame.K_PLUS, "+", CONTROL)
        found.append(comfort.size)
    assert sorted(set(found)) == [size for size in SIZES if size >= 100]
    person.press(pygame.K_0, "0", CONTROL)
    assert comfort.size == 100
    for _ in SIZES:
        person.press(pygame.K_MINUS, "-", CONTROL)
    assert comfort.size == min(SIZES)


def test_a_size_is_kept_for_the_next_window(person: Person) -> None:
    person.press(pygame.K_EQUALS, "=", CONTROL)  # + with Shift, where it stands on that key

    assert preferences.WindowPreferences().size == 110


@pytest.mark.parametrize(("height", "size"), [(1080, 100), (1440, 100), (2160, 150)])
def test_what_is_written_on_a_dense_screen_is_larger_at_first(height: int, size: int) -> None:
    assert preferences.WindowPreferences(height).size == size


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("window", [SMALLEST, USUAL, (1920, 1080)])
def test_the_parts_of_the_window_fill_it_and_do_not_overlap(
    window: tuple[int, int], size: int
) -> None:
    for levels in (True, False):
        layout = divide(window, levels, side=True, scale=size / 100)
        across = layout.levels.width + layout.stage.width + layout.side.width

        assert across == window[0]
        assert layout.stage.width >= 300
        assert layout.side.width >= 320 * min(size / 100, 1.5)
        assert layout.stage.height + layout.controls.height == window[1]


@pytest.mark.sweep
@pytest.mark.parametrize(("window", "size", "language"), LOOKS)
def test_no_caption_is_larger_than_its_widget_on_any_page(
    person: Person, tmp_path: Path, window: tuple[int, int], size: int, language: Name
) -> None:
    person.resize(window)
    person.open(tmp_path, falling())
    choose(person, size, language)
    pen = person.window.pen
    for page in PAGES:
        person.window.do(page.command)
        person.wait()
        for each in widgets(person):
            if isinstance(each, UIButton) and each.text:
                assert pen.write(each.text, 11).width <= each.rect.width + 2, (page.name, each.text)
            if each.rect.height > 20 * size / 100 and getattr(each, "text", ""):
                assert pen.height(11) <= each.rect.height, (page.name, each.text)


@pytest.mark.sweep
@pytest.mark.parametrize(("window", "size", "language"), LOOKS)
def test_no_two_widgets_of_a_page_cover_each_other(
    person: Person, tmp_path: Path, window: tuple[int, int], size: int, language: Name
) -> None:
    person.resize(window)
    person.open(tmp_path, falling())
    choose(person, size, language)
    for page in PAGES:
        person.window.do(page.command)
        person.wait()
        seen = [
            each
            for each in widgets(person)
            if "sliding_button" not in each.most_specific_combined_id
        ]
        for i, one in enumerate(seen):
            for other in seen[i + 1 :]:
                if one.ui_container is other.ui_container:
                    assert not one.rect.colliderect(other.rect), (page.name, one, other)


@pytest.mark.parametrize("size", [150, 200])
def test_what_has_no_room_is_scrolled_to(person: Person, tmp_path: Path, size: int) -> None:
    person.resize(SMALLEST)
    person.open(tmp_path, falling())
    choose(person, size)
    side = person.side
    container = side._sheet.container
    lowest = side.parameters.row("mass").field

    assert lowest.rect.bottom > container.rect.bottom or container.vert_scroll_bar is not None
    for _ in range(8):
        person.press(pygame.K_PAGEDOWN)
    assert side._sheet.checks is None or side._sheet.checks.rect.bottom <= container.rect.bottom + 4


@pytest.mark.parametrize(
    ("window", "size"), [((200, 900), 100), (SMALLEST, 200), ((1600, 300), 100)]
)
def test_a_note_is_whole_in_a_narrow_window_and_leaves_some_of_the_stage(
    person: Person, monkeypatch: pytest.MonkeyPatch, window: tuple[int, int], size: int
) -> None:
    """At 200 x 900 it was cut off, and at 900 x 600 large text hid the whole stage."""
    person.resize(window)
    choose(person, size)
    person.window.open_level("kinematics/projectile")
    boxes: list[pygame.Rect] = []
    rect = pygame.draw.rect

    def noted(
        surface: pygame.Surface, color: Color, box: pygame.Rect, *more: int, **how: int
    ) -> None:
        if color == theme.RAISED:
            boxes.append(box.move(surface.get_abs_offset()))
        rect(surface, color, box, *more, **how)

    person.window.banner.write("saved /home/somebody/Documents/Mechanics sandbox/projectile 9.gif")
    monkeypatch.setattr(pygame.draw, "rect", noted)
    person.wait()

    stage = person.window.panels.layout.stage.clip(person.window.surface.get_rect())
    assert stage.contains(boxes[0])
    assert boxes[0].height < stage.height / 2
