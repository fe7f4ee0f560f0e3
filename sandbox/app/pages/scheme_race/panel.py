"""The page Race."""

import pygame
from pygame_gui import UI_BUTTON_PRESSED

from sandbox.app.pages.page import Desk
from sandbox.app.pages.scheme_race import scheme_comparison
from sandbox.app.pages.scheme_race.card import race_intro, standing
from sandbox.app.widgets.scrolling_area import Sheet, below
from sandbox.app.words.language import later, say

RACE, END = later("Race"), later("End the race")
HEIGHT = 30  # px, of the button


class RacePage:
    """The button that starts and ends the race, and its standings."""

    def __init__(self, sheet: Sheet, desk: Desk) -> None:
        self._sheet, self._session = sheet, desk.session
        y = below(sheet.image(race_intro(sheet.pen, sheet.width), sheet.margin // 2)) + 8
        self.button = sheet.button(
            pygame.Rect((0, y), (sheet.widest_button(say(RACE), say(END)), sheet.px(HEIGHT))),
            "",
            say("every scheme at once (S)"),
        )
        self._table = sheet.image(self._drawn(), y + sheet.px(42))
        self.update()

    def process(self, event: pygame.event.Event) -> str | None:
        """Start or end the race."""
        if event.type != UI_BUTTON_PRESSED or event.ui_element is not self.button:
            return None
        scheme_comparison.toggle(self._session)
        return ""

    def update(self) -> None:
        """Show the standings."""
        text = say(END if scheme_comparison.racing(self._session) else RACE)
        if self.button.text != text:
            self.button.set_text(text)
        self._sheet.replace(self._table, self._drawn())
        self._sheet.set_content_height(below(self._table) + 2)

    def _drawn(self) -> pygame.Surface:
        return standing(self._sheet.pen, self._sheet.width, self._session)
