"""The level's own page: what it is, its parameters, its checks."""

import pygame

from sandbox.app.cards.card import heading
from sandbox.app.cards.checks import checks, unjudged
from sandbox.app.pages.accuracy.studying import Studying
from sandbox.app.pages.level.card import header
from sandbox.app.pages.page import Desk
from sandbox.app.widgets.parameters import Parameters
from sandbox.app.widgets.sheet import MARGIN, Sheet, below


class LevelPage:
    """What the level is, its parameters, and how its checks stand."""

    def __init__(self, sheet: Sheet, desk: Desk) -> None:
        self._sheet, self._session = sheet, desk.session
        self._studying = desk.worker(Studying)
        pen, width, level = sheet.pen, sheet.width, desk.session.original
        y = below(sheet.image(header(pen, width, level), MARGIN // 2)) + 8
        if level.parameters:
            y = below(sheet.image(heading(pen, width, "Parameters"), y))
        area = pygame.Rect(MARGIN, y, width, 0)
        values = desk.session.values
        sheet.parameters = Parameters(
            sheet.manager, pen, sheet.container, area, level.parameters, values
        )
        self._checks = sheet.image(self._drawn(), y + sheet.parameters.height + 8)
        sheet.end(below(self._checks) + 2)

    def process(self, _event: pygame.event.Event) -> str | None:
        """Return nothing: what is changed here is a parameter."""
        return None

    def update(self) -> None:
        """Bring parameters and checks up to date."""
        self._sheet.replace(self._checks, self._drawn())
        self._sheet.end(below(self._checks) + 2)
        self._sheet.parameters.show(self._session.values)

    def _drawn(self) -> pygame.Surface:
        session, sheet = self._session, self._sheet
        if session.changes:
            return unjudged(sheet.pen, sheet.width)
        return checks(
            sheet.pen,
            sheet.width,
            session.readings(),
            disturbed=session.world.disturbed,
            splits=self._studying.splits(session),
        )
