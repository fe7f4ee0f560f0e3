"""The page Table: the values, a button that saves all, and the stopwatch."""

import pygame
from pygame_gui import UI_BUTTON_PRESSED

from sandbox.app.pages.accuracy.background_study import BackgroundStudy
from sandbox.app.pages.graph.chosen_quantities import Choice
from sandbox.app.pages.page import Desk
from sandbox.app.pages.share import saving
from sandbox.app.pages.table.card import values
from sandbox.app.pages.table.stopwatch import Stopwatch
from sandbox.app.pages.table.stopwatch_controls import StopwatchControls
from sandbox.app.widgets.scrolling_area import Sheet, below
from sandbox.app.words.language import later, say

HEIGHT = 28  # px, of the button
GAP = 12  # px, above the stopwatch
TIP = later("save these quantities at every recorded instant, with all digits")


class TablePage:
    """The quantities of the graph page by time, and below them the stopwatch."""

    def __init__(self, sheet: Sheet, desk: Desk) -> None:
        self._sheet, self._session = sheet, desk.session
        self._choice, self._studying = desk.worker(Choice), desk.worker(BackgroundStudy)
        caption = say("Save as CSV")
        place = pygame.Rect(0, sheet.margin // 2, sheet.widest_button(caption), sheet.px(HEIGHT))
        self.save = sheet.button(place, caption, say(TIP))
        """The button that saves the table."""
        self._table = sheet.image(self._drawn(), sheet.margin // 2 + sheet.px(HEIGHT) + 6)
        self.timing = StopwatchControls(sheet, desk.session, desk.worker(Stopwatch))
        """The stopwatch."""
        self.update()

    def process(self, event: pygame.event.Event) -> str | None:
        """Save the table, and return the message; or handle the widgets of the stopwatch."""
        if event.type != UI_BUTTON_PRESSED or event.ui_element is not self.save:
            return self.timing.process(event)
        path = saving.graph_table(self._session, self._choice.up(self._session))
        return say("saved {path}", path=path)

    def update(self) -> None:
        """Draw the table and the stopwatch again."""
        self._sheet.replace(self._table, self._drawn())
        self.timing.update()
        self._sheet.set_content_height(self.timing.put(below(self._table) + GAP))

    def _drawn(self) -> pygame.Surface:
        sheet, session = self._sheet, self._session
        trust = self._studying.trust(session)
        return values(sheet.pen, sheet.width, session, self._choice.up(session), trust)
