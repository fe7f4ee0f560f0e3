"""The table of keys."""

from collections import Counter
from importlib.resources import files

import pygame
import pytest

from sandbox.app.keymap import BINDINGS, command, tip
from sandbox.app.pages.register import PAGES
from sandbox.app.panels.play_bar import LEFT, WAYS
from tests.app.person import Person, until


def pressed(key: int, text: str = "", mod: int = 0) -> str | None:
    return command(pygame.Event(pygame.KEYDOWN, key=key, unicode=text, mod=mod))


def test_every_command_of_the_window_has_exactly_one_line_in_the_table(person: Person) -> None:
    without_key = [page.command for page in PAGES if not page.key]
    listed = [*(b.command for b in BINDINGS), *without_key]
    assert sorted(listed) == sorted(person.window.commands.names)


def test_no_key_has_two_meanings() -> None:
    keys: Counter[object] = Counter(
        key for binding in BINDINGS for key in (*binding.keys, *binding.characters)
    )
    keys.update(("Ctrl", key) for binding in BINDINGS for key in binding.controls)

    assert [key for key, meanings in keys.items() if meanings > 1] == []


def test_every_command_has_a_key_and_says_what_it_does() -> None:
    silent = [
        b.command for b in BINDINGS if not (b.keys or b.characters or b.controls) or not b.text
    ]

    assert silent == []


@pytest.mark.parametrize(
    ("key", "text", "expected"),
    [
        (pygame.K_SPACE, " ", "play"),
        (pygame.K_RIGHT, "", "step"),
        (pygame.K_PERIOD, ".", "step"),
        (pygame.K_8, "]", "faster"),  # as on a German keyboard
        (pygame.K_PLUS, "+", "faster"),
        (pygame.K_F1, "", "help"),
        (pygame.K_s, "s", "scheme_race page"),
        (pygame.K_s, "S", "race"),
        (pygame.K_o, "O", "branch"),
        (pygame.K_m, "M", "momentum page"),  # which leaves the capital letter free
        (pygame.K_F9, "", None),
    ],
)
def test_keys_are_known_by_place_or_by_what_they_write(
    key: int, text: str, expected: str | None
) -> None:
    assert pressed(key, text) == expected


def test_shortcuts_of_the_desktop_are_left_alone() -> None:
    assert pressed(pygame.K_r, "r", pygame.KMOD_LCTRL) is None
    assert pressed(pygame.K_o, "o", pygame.KMOD_LALT) is None


@pytest.mark.parametrize("mod", [pygame.KMOD_LCTRL, pygame.KMOD_LMETA])
def test_a_file_is_opened_as_everywhere(mod: int) -> None:
    assert pressed(pygame.K_o, "\x0f", mod) == "open file"


def test_what_a_button_says_of_its_key_can_be_drawn_by_the_font_of_widgets() -> None:
    """Tooltips are drawn in Noto Sans alone, which has no arrows."""
    pygame.font.init()
    font = pygame.font.Font(str(files("pygame_gui") / "data" / "NotoSans-Regular.ttf"), 14)
    buttons = [*LEFT, *WAYS, ("home", ""), ("new scene", ""), ("open file", "")]
    named = [*(name for name, _ in buttons), *(page.command for page in PAGES)]

    for name in named:
        assert None not in font.metrics(tip(name)), name


def test_ctrl_and_arrows_go_from_impact_to_impact(person: Person) -> None:
    """By keyboard, the impact was hundreds of single steps back."""
    person.window.open_level("momentum/cradle")
    session = person.session
    for _ in range(session.end):
        session.step()
    first, last = sorted(blow.steps for blow in session.run.marks.shown)
    seen = []

    for key in (*3 * [pygame.K_LEFT], *3 * [pygame.K_RIGHT]):
        person.press(key, mod=pygame.KMOD_CTRL)
        until(person, lambda: session.sought is None)
        seen.append(session.world.steps)

    assert seen == [last, first, 0, first, last, session.end]
