"""The page of the level itself: description, parameters, checks."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import pygame
from pygame_gui import UI_BUTTON_PRESSED

from sandbox.app.cards.checks import NOTHING, checks, unjudged
from sandbox.app.cards.text_column import heading
from sandbox.app.pages.level.card import header
from sandbox.app.pages.page import Desk
from sandbox.app.runs.session import Session
from sandbox.app.widgets.scrolling_area import Sheet, below
from sandbox.app.widgets.widget_states_and_scrolling import show_pressed
from sandbox.app.words import level_translation
from sandbox.app.words.language import later, say

if TYPE_CHECKING:
    from pygame_gui.elements import UIButton

    from sandbox.physics.accuracy.error_causes_and_costs import ErrorBudget

SWITCH = 26  # px
TIP = later(
    "a changed parameter acts from now on; the run so far stays (Shift O, or Shift and drag)"
)


class LevelPage:
    """The description of the level, its parameters, and the results of its checks."""

    def __init__(self, sheet: Sheet, desk: Desk) -> None:
        self._sheet, self._session, self._desk = sheet, desk.session, desk
        pen, width, level = sheet.pen, sheet.width, desk.session.original
        y = below(sheet.image(header(pen, width, level), sheet.margin // 2)) + 8
        if level.parameters:
            y = below(sheet.image(heading(pen, width, say("Parameters")), y))
        y += sheet.add_parameters(
            y, level.parameters, desk.session.chosen, level_translation.of(level)
        ).height
        self.onwards: UIButton | None = None
        if level.parameters:
            place = pygame.Rect(0, y + 4, width, sheet.px(SWITCH))
            self.onwards = sheet.button(place, say("Changes act from now on"), say(TIP))
            y += sheet.px(SWITCH) + 6
        self._checks = sheet.checks = sheet.image(self._drawn(), y + 8)
        sheet.set_content_height(below(self._checks) + 2)

    def process(self, event: pygame.event.Event) -> str | None:
        """Switch between changes from now on and from the start."""
        if event.type != UI_BUTTON_PRESSED or event.ui_element is not self.onwards:
            return None
        return turn(self._session)

    def update(self) -> None:
        """Update the parameters and the checks."""
        if self.onwards is not None:
            show_pressed(self.onwards, self._session.branches)
        self._sheet.replace(self._checks, self._drawn())
        self._sheet.set_content_height(below(self._checks) + 2)
        self._sheet.parameters.show(self._session.chosen)

    def _drawn(self) -> pygame.Surface:
        session, sheet = self._session, self._sheet
        if session.changes:
            return unjudged(sheet.pen, sheet.width)
        return checks(
            sheet.pen,
            sheet.width,
            session.readings(),
            level_translation.of(session.original),
            disturbed=session.world.disturbed,
            splits=self._splits(),
        )

    def _splits(self) -> Mapping[int, "ErrorBudget"]:
        """Return the two parts of the errors; none before the first step, when nothing is off."""
        if not self._session.world.steps:
            return NOTHING
        from sandbox.app.pages.accuracy.background_study import BackgroundStudy

        return self._desk.worker(BackgroundStudy).splits(self._session)


def turn(session: Session) -> str:
    """Switch whether changes act from now on or from the start, and return the message."""
    session.branches = not session.branches
    if session.branches:
        return say("a changed parameter acts from now on; the run so far stays behind as a trail")
    return say("a changed parameter restarts the run")


def switch(desk: Desk) -> str:
    """Do the same for the command `branch`."""
    return turn(desk.session)
