"""The page Settings: a row of choices for each setting."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import NamedTuple

import pygame
from pygame_gui import UI_BUTTON_PRESSED
from pygame_gui.elements import UIButton

from sandbox.app import impact_sounds
from sandbox.app.cards.text_column import heading, label
from sandbox.app.drawing import theme
from sandbox.app.files import preferences
from sandbox.app.files.preferences import WindowPreferences
from sandbox.app.pages.page import Desk
from sandbox.app.widgets.scrolling_area import Sheet, below, in_rows
from sandbox.app.widgets.widget_states_and_scrolling import show_pressed
from sandbox.app.words import language
from sandbox.app.words.language import say, say_in

HEIGHT = 28  # px, of a button
GAP = 6  # px


class Choice(NamedTuple):
    """An option of a setting."""

    caption: str
    tip: str
    choose: Callable[[], str]
    """applies it, and returns a message"""
    chosen: bool


class Setting(NamedTuple):
    """A setting: its options, one of which is active."""

    title: str
    help: str
    choices: Sequence[Choice]


def settings(comfort: WindowPreferences) -> tuple[Setting, ...]:
    """Return all settings, with their options and the active ones."""
    return (
        Setting(say("Theme"), say("Ctrl T takes the next one."), list(_themes(comfort))),
        Setting(
            say("Size of text"), say("Ctrl + and Ctrl − change it, too."), list(_sizes(comfort))
        ),
        Setting(
            say("Language"),
            say("The texts of your own levels stay as they are."),
            list(_languages(comfort)),
        ),
        Setting(
            say("Motion"),
            say("Reduced: no flashes at impacts, and cards stand still."),
            list(_motion(comfort)),
        ),
        Setting(say("Sound"), _sound_description(comfort), list(_sound(comfort))),
    )


def _themes(comfort: WindowPreferences) -> Sequence[Choice]:
    return [
        Choice(
            say(theme.title(name)), say("the colours of the window"),
            partial(comfort.choose, theme=name), comfort.chosen.theme == name,
        )
        for name in theme.NAMES
    ]  # fmt: skip


def _sizes(comfort: WindowPreferences) -> Sequence[Choice]:
    chosen = comfort.chosen.size
    suiting = Choice(
        say("Automatic"), say("what suits the screen"), partial(comfort.choose, size=None),
        chosen is None,
    )  # fmt: skip
    return [suiting, *(
        Choice(f"{size} %", say("{size} % of the usual size", size=size),
               partial(comfort.choose, size=size), chosen == size)
        for size in preferences.SIZES
    )]  # fmt: skip


def _languages(comfort: WindowPreferences) -> Sequence[Choice]:
    chosen, title = comfort.chosen.language, language.TITLES[language.system_language()]
    system = Choice(
        say("System"), say("the system's language: {language}", language=title),
        partial(comfort.choose, language=None), chosen is None,
    )  # fmt: skip
    return [system, *(
        Choice(language.TITLES[name], "", partial(comfort.choose, language=name), chosen == name)
        for name in language.NAMES
    )]  # fmt: skip


def _motion(comfort: WindowPreferences) -> Sequence[Choice]:
    now = comfort.chosen.reduced
    return [
        Choice(
            say("Full"),
            say("flashes at impacts, cards that play"),
            partial(comfort.choose, reduced=False),
            not now,
        ),
        Choice(
            say("Reduced"),
            say("no flashes, and cards stand still"),
            partial(comfort.choose, reduced=True),
            now,
        ),
    ]


def _sound_description(comfort: WindowPreferences) -> str:
    """Return a description of the sound, or the reason why there is none although it is on."""
    why = impact_sounds.open_device() if comfort.chosen.sound else ""
    if why:
        return say("No sound is available ({reason}). Switch it on to try again.", reason=why)
    return say("Tones at impacts: deep for heavy bodies, loud for hard impacts.")


def _sound(comfort: WindowPreferences) -> Sequence[Choice]:
    now = comfort.chosen.sound
    return [
        Choice(
            say_in("sound", "Off"), say("nothing is heard"), partial(comfort.choose, sound=False),
            not now,
        ),
        Choice(
            say_in("sound", "On"), say("impacts are heard"), partial(comfort.choose, sound=True),
            now,
        ),
    ]  # fmt: skip


class SettingsPage:
    """A button for each choice; the active ones are pressed."""

    def __init__(self, sheet: Sheet, desk: Desk) -> None:
        self._sheet, self._comfort = sheet, desk.comfort
        self._buttons: dict[UIButton, Choice] = {}
        y = sheet.margin // 2
        for setting in settings(desk.comfort):
            y = self._put(setting, y)
        sheet.set_content_height(y)

    def _put(self, setting: Setting, y: int) -> int:
        """Make rows of buttons for a setting, and return the height of the next setting [px]."""
        sheet, px = self._sheet, self._sheet.pen.px
        y = below(sheet.image(heading(sheet.pen, sheet.width, setting.title), y))
        y = below(sheet.image(label(sheet.pen, sheet.width, setting.help), y)) + px(GAP)
        widths = (sheet.widest_button(choice.caption) for choice in setting.choices)
        places = in_rows(widths, sheet.width, px(HEIGHT), px(GAP))
        for choice, place in zip(setting.choices, places, strict=True):
            button = sheet.button(place.move(0, y), choice.caption, choice.tip)
            show_pressed(button, choice.chosen)
            self._buttons[button] = choice
        return y + place.bottom + px(2 * GAP)

    def button(self, caption: str) -> UIButton:
        """Return the button with a caption."""
        return next(button for button, each in self._buttons.items() if each.caption == caption)

    def process(self, event: pygame.event.Event) -> str | None:
        """Apply the pressed choice; the window is rebuilt for it."""
        if event.type != UI_BUTTON_PRESSED or event.ui_element not in self._buttons:
            return None
        return self._buttons[event.ui_element].choose()

    def update(self) -> None:
        """Do nothing, as a changed setting makes a new page."""
