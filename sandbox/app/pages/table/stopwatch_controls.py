"""The stopwatch on the page Table: its display, its buttons, and the choice of triggers."""

import pygame
from pygame_gui import UI_BUTTON_PRESSED, UI_SELECTION_LIST_NEW_SELECTION
from pygame_gui.elements import UISelectionList

from sandbox.app.cards.text_column import TextColumn, heading, label
from sandbox.app.pages.table.stopwatch import Stopwatch
from sandbox.app.pages.table.stopwatch_triggers import StopwatchTrigger, triggers
from sandbox.app.runs.session import Session
from sandbox.app.widgets.scrolling_area import Sheet, below
from sandbox.app.words.language import say

LIST = 92  # px, the height of each of the two lists
HEIGHT = 28  # px, of a button
GAP = 6  # px


class StopwatchControls:
    """The widgets of a stopwatch on a sheet."""

    def __init__(self, sheet: Sheet, session: Session, stopwatch: Stopwatch) -> None:
        self._sheet, self._session, self._watch = sheet, session, stopwatch
        self._title = sheet.image(heading(sheet.pen, sheet.width, say("Stopwatch")), 0)
        self._shown = sheet.image(self._drawn(), 0)
        captions = say("Start or stop"), say("Reset")
        first, second = (
            pygame.Rect(0, 0, sheet.widest_button(caption), sheet.px(HEIGHT))
            for caption in captions
        )
        second.left = first.right + GAP
        self.press = sheet.button(first, captions[0], say("start it now, or stop it (3)"))
        self.reset = sheet.button(second, captions[1], say("set it back to 0"))
        """The buttons of the stopwatch."""
        self._labels = [
            sheet.image(label(sheet.pen, sheet.width, text), 0)
            for text in (say("Started"), say("Stopped"))
        ]
        self._known = {occasion.label: occasion for occasion in triggers(session)}
        self.starts, self.stops = self._list(stopwatch.starts), self._list(stopwatch.stops)
        """The lists of triggers that start and stop it."""

    def _list(self, chosen: StopwatchTrigger) -> UISelectionList:
        self._known.setdefault(chosen.label, chosen)
        return self._sheet.choices([*self._known], self._sheet.px(LIST), chosen.label)

    def put(self, y: int) -> int:
        """Place the widgets at a height, and return the lower end [px]."""
        if self._title.relative_rect.y == y:
            return int(self.stops.relative_rect.bottom)
        sheet, x = self._sheet, self._sheet.margin
        self._title.set_relative_position((x, y))
        self._shown.set_relative_position((x, below(self._title)))
        y = below(self._shown) + GAP
        self.press.set_relative_position((x, y))
        self.reset.set_relative_position((self.reset.relative_rect.x, y))
        y += sheet.px(HEIGHT) + GAP
        for caption, chooser in zip(self._labels, (self.starts, self.stops), strict=True):
            caption.set_relative_position((x, y))
            chooser.set_relative_position((x, below(caption)))
            y = below(caption) + sheet.px(LIST) + GAP
        return y

    def process(self, event: pygame.event.Event) -> str | None:
        """Handle a click, and return its message; None if it was on none of these widgets."""
        if event.type == UI_BUTTON_PRESSED and event.ui_element is self.press:
            return self._watch.press(self._session) or ""
        if event.type == UI_BUTTON_PRESSED and event.ui_element is self.reset:
            self._watch.reset()
            return ""
        lists = (self.starts, self.stops)
        if event.type == UI_SELECTION_LIST_NEW_SELECTION and event.ui_element in lists:
            chosen = [self._known[str(each.get_single_selection())] for each in lists]
            self._watch.choose(*chosen)
            return ""
        return None

    def update(self) -> None:
        """Update the display."""
        self._sheet.replace(self._shown, self._drawn())

    def _drawn(self) -> pygame.Surface:
        reading = self._watch.reading(self._session)
        card = TextColumn(self._sheet.pen, self._sheet.width)
        card.text(reading.text, 20, reading.color)
        return card.drawn()
