"""The page Accuracy: the cost of another digit, and the parts of the errors."""

from math import log10

import pygame
from pygame_gui import UI_BUTTON_PRESSED, UI_HORIZONTAL_SLIDER_MOVED
from pygame_gui.elements import UIHorizontalSlider

from sandbox.app.cards.text_column import TextColumn
from sandbox.app.pages.accuracy import work_precision_diagram
from sandbox.app.pages.accuracy.background_study import BackgroundStudy
from sandbox.app.pages.accuracy.card import current_accuracy, dial_ends, shares_and_errors, status
from sandbox.app.pages.page import Desk
from sandbox.app.widgets.scrolling_area import Sheet, below
from sandbox.app.words.language import later, say

DIAGRAM = 158  # px, its height
MEASURE, CANCEL = later("Measure"), later("Cancel")
HEIGHT = 26  # px, of the button
DIAL = 2, 10
"""The range of digits that can be requested, from fast to exact."""
UNASKED = 6
"""The position of the dial while no accuracy is requested."""


class AccuracyPage:
    """The dial, the diagram, the parts of a frame's time, and the errors of the checks.

    Attributes
    ----------
    dial, button
        The dial, and the button that starts or cancels the work.
    """

    def __init__(self, sheet: Sheet, desk: Desk) -> None:
        self._sheet, self._session, self._load = sheet, desk.session, desk.load
        self._studying = desk.worker(BackgroundStudy)
        pen, width = sheet.pen, sheet.width
        self._asked = sheet.image(self._drawn_dial(), sheet.margin // 2)
        y = below(self._asked)
        self.dial = UIHorizontalSlider(
            pygame.Rect(sheet.margin, y, width, sheet.px(14)),
            UNASKED,
            DIAL,
            sheet.manager,
            container=sheet.container,
        )
        y += sheet.px(18)
        y = below(sheet.image(dial_ends(pen, width, say("fast"), say("exact")), y)) + 6
        self._diagram = sheet.image(self._drawn(), y)
        y = below(self._diagram) + 4
        self._wide = sheet.widest_button(say(MEASURE), say(CANCEL))
        place = pygame.Rect(width - self._wide, y, self._wide, sheet.px(HEIGHT))
        self.button = sheet.button(
            place, say(MEASURE), say("start or stop measuring error and cost")
        )
        self._status = sheet.image(self._drawn_status(), y)
        self._below = y + sheet.px(HEIGHT) + 6
        self._rest = sheet.image(self._drawn_rest(), self._below)
        self.update()

    @property
    def _digits(self) -> int:
        """The number of digits requested; 0 if none are."""
        target = self._studying.target
        return 0 if target is None else round(-log10(target))

    def process(self, event: pygame.event.Event) -> str | None:
        """Start or cancel the work, or search for a setting with the accuracy of the dial."""
        if event.type == UI_HORIZONTAL_SLIDER_MOVED and event.ui_element is self.dial:
            digits = round(event.value)
            if digits != self._digits:
                self._studying.seek(self._session, 10.0**-digits)
            return ""
        if event.type != UI_BUTTON_PRESSED or event.ui_element is not self.button:
            return None
        self._studying.measure_or_cancel(self._session)
        return ""

    def update(self) -> None:
        """Show the results so far."""
        self._session.world.kicks.time_calls()  # a keyframe may have put back a state without it
        text = say(CANCEL if self._studying.running else MEASURE)
        if self.button.text != text:
            self.button.set_text(text)
        self._turn_dial()
        replace = self._sheet.replace
        replace(self._asked, self._drawn_dial())
        replace(self._diagram, self._drawn())
        replace(self._status, self._drawn_status())
        replace(self._rest, self._drawn_rest())
        self._sheet.set_content_height(below(self._rest) + 2)

    def _turn_dial(self) -> None:
        """Set the dial to the requested accuracy, unless it is being dragged."""
        knob = self.dial.sliding_button
        if knob is None or not knob.held:
            self.dial.set_current_value(self._digits or UNASKED, warn=False)

    def _drawn_dial(self) -> pygame.Surface:
        studying, session = self._studying, self._session
        place = studying.least_known(session)
        return current_accuracy(
            self._sheet.pen, self._sheet.width, studying.target, session.world.stepping,
            studying.here, place,
        )  # fmt: skip

    def _drawn(self) -> pygame.Surface:
        studying, pen, width = self._studying, self._sheet.pen, self._sheet.width
        card = TextColumn(pen, width)
        card.text(say("largest numerical error"), 12)
        chart = work_precision_diagram.draw(
            pen, (width, self._sheet.px(DIAGRAM)), studying.points, studying.here
        )
        card.put(chart, 0)
        card.y += chart.height + 3
        legend = work_precision_diagram.legend(pen, width, studying.points)
        card.put(legend, 0)
        card.y += legend.height
        return card.drawn()

    def _drawn_status(self) -> pygame.Surface:
        width = self._sheet.width - self._wide - 8
        return status(
            self._sheet.pen,
            (width, self._sheet.px(HEIGHT)),
            self._studying.progress,
            self._studying.failure,
        )

    def _drawn_rest(self) -> pygame.Surface:
        pen, width, session = self._sheet.pen, self._sheet.width, self._session
        splits = self._studying.splits(session)
        return shares_and_errors(pen, width, self._load.shares, session.original, splits)
