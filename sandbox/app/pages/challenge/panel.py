"""The page Challenge: free parameters, goals, hints."""

import pygame
from pygame_gui import UI_BUTTON_PRESSED

from sandbox.app.pages.challenge.card import hints, standing, task
from sandbox.app.pages.challenge.judge import Judge
from sandbox.app.pages.page import Desk
from sandbox.app.widgets.scrolling_area import Sheet, below
from sandbox.app.widgets.widget_states_and_scrolling import show
from sandbox.app.words import level_translation
from sandbox.app.words.language import later, say

FIRST, ANOTHER = later("A hint"), later("Another hint")
HEIGHT = 28  # px, of the button


class ChallengePage:
    """The task, the free parameters, the standing of the goals, and hints.

    Attributes
    ----------
    button, others
        The button that asks for a hint, and the one that shows all challenges.
    """

    def __init__(self, sheet: Sheet, desk: Desk) -> None:
        self._sheet, self._session = sheet, desk.session
        self._judge = desk.worker(Judge)
        y = below(sheet.image(task(sheet.pen, sheet.width, desk.session), sheet.margin // 2)) + 12
        challenge, level = desk.session.level.challenge, desk.session.original
        free = {name: level.parameters[name] for name in (challenge.free if challenge else ())}
        y += sheet.add_parameters(y, free, desk.session.chosen, level_translation.of(level)).height
        self._standing = sheet.image(self._draw_standing(), y + 4)
        self._hints = sheet.image(self._draw_hints(), below(self._standing) + 8)
        self.button = sheet.button(
            pygame.Rect((0, 0), (sheet.widest_button(say(FIRST), say(ANOTHER)), sheet.px(HEIGHT))),
            "",
            say("one hint more"),
        )
        caption = say("All challenges")
        self.others = sheet.button(
            pygame.Rect((0, 0), (sheet.widest_button(caption), sheet.px(HEIGHT))), caption,
            say("show the cards of all challenges"),
        )  # fmt: skip
        self.update()

    def command_of(self, button: object) -> str | None:
        """Return the command of a button; None if it is not one of these."""
        return "challenges" if button is self.others else None

    def process(self, event: pygame.event.Event) -> str | None:
        """Show another hint if its button was pressed."""
        if event.type != UI_BUTTON_PRESSED or event.ui_element is not self.button:
            return None
        self._judge.hint(self._session)
        return ""

    def update(self) -> None:
        """Show the standing of the challenge."""
        sheet = self._sheet
        sheet.parameters.show(self._session.chosen)
        sheet.replace(self._standing, self._draw_standing())
        sheet.replace(self._hints, self._draw_hints())
        self._hints.set_relative_position((self._sheet.margin, below(self._standing) + 8))
        left = len(self._all_hints) - len(self._shown_hints)
        y = below(self._hints) + 8
        self.button.set_relative_position((self._sheet.margin, y))
        y += sheet.px(HEIGHT) + 8 if left else 0
        self.others.set_relative_position((self._sheet.margin, y))
        if left:
            self.button.set_text(say(ANOTHER if self._shown_hints else FIRST))
        show(self.button, bool(left))
        sheet.set_content_height(y + sheet.px(HEIGHT) + 8)

    @property
    def _all_hints(self) -> tuple[str, ...]:
        challenge = self._session.level.challenge
        return challenge.hints if challenge else ()

    @property
    def _shown_hints(self) -> tuple[str, ...]:
        words = level_translation.of(self._session.original)
        shown = self._judge.hints.get(self._session.original.title, 0)
        return tuple(map(words, self._all_hints[:shown]))

    def _draw_standing(self) -> pygame.Surface:
        best = self._judge.stars(self._session)
        return standing(self._sheet.pen, self._sheet.width, self._session, best)

    def _draw_hints(self) -> pygame.Surface:
        return hints(self._sheet.pen, self._sheet.width, self._shown_hints)
