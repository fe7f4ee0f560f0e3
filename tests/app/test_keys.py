"""The table of keys."""

from typing import get_args

import pygame
import pytest

from sandbox.app.keys import BINDINGS, Command, command


def pressed(key: int, text: str = "", mod: int = 0) -> Command | None:
    return command(pygame.Event(pygame.KEYDOWN, key=key, unicode=text, mod=mod))


def test_every_command_has_exactly_one_line_in_the_table() -> None:
    assert sorted(binding.command for binding in BINDINGS) == sorted(get_args(Command))


def test_no_key_has_two_meanings() -> None:
    keys = [key for binding in BINDINGS for key in (*binding.keys, *binding.characters)]

    assert len(keys) == len(set(keys))


@pytest.mark.parametrize(
    ("key", "text", "expected"),
    [
        (pygame.K_SPACE, " ", "play"),
        (pygame.K_RIGHT, "", "step"),
        (pygame.K_PERIOD, ".", "step"),
        (pygame.K_8, "]", "faster"),  # as on a German keyboard
        (pygame.K_PLUS, "+", "faster"),
        (pygame.K_F1, "", "help"),
        (pygame.K_q, "q", None),
    ],
)
def test_keys_are_known_by_place_or_by_what_they_write(
    key: int, text: str, expected: Command | None
) -> None:
    assert pressed(key, text) == expected


def test_shortcuts_of_the_desktop_are_left_alone() -> None:
    assert pressed(pygame.K_r, "r", pygame.KMOD_LCTRL) is None
