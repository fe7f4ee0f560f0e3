"""The banner at the top of the stage: the most urgent of the messages."""

from math import inf

import pygame

from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color
from sandbox.app.pages.effects import switching_effects
from sandbox.app.panels import stage_messages
from sandbox.app.runs.session import Session
from sandbox.app.words import formatting, language
from sandbox.app.words.language import later, say
from sandbox.model.translatable_message import NOTHING
from sandbox.physics.state.simulation_errors import SimulationError

NOTE = 5.0  # s, the time for which a note is shown


class Banner:
    """Shows temporary notes, and the status of the current run."""

    def __init__(self) -> None:
        self._note, self._left = "", 0.0
        self._ended: tuple[object, str, str] = None, "", ""

    def write(self, text: str, *, lasting: bool = False) -> None:
        """Show a note for a while, or until the next one; an empty note removes it."""
        self._note, self._left = text, inf if lasting else NOTE

    def is_showing(self, text: str) -> bool:
        """Whether this note is shown at present."""
        return self._left > 0 and self._note == text

    def update(self, seconds: float) -> None:
        """Advance by some time [s]."""
        self._left -= seconds

    def draw(
        self, surface: pygame.Surface, pen: Pen, area: pygame.Rect, session: Session | None
    ) -> int:
        """Draw the note at the top of an area, if there is one; return its lower edge [px]."""
        text, color = self._told(session)
        return stage_messages.draw_banner(surface, pen, area, text, color) if text else 0

    def _told(self, session: Session | None) -> tuple[str, Color]:
        noted = (self._note if self._left > 0 else ""), theme.NOTICE
        return (self._run_message(session) if session is not None else None) or noted

    def _run_message(self, session: Session) -> tuple[str, Color] | None:
        """Return the run's message that takes precedence over a note, or is shown without one."""
        if session.run.trying and isinstance(session.failure, SimulationError):
            message = say(
                "{failure} – trying remedies …", failure=session.failure.with_advice(NOTHING)
            )
            return message, theme.FAILED
        if session.failure is not None:
            message = later("{failure} – R restarts")
            if session.doubted:
                message = later(
                    "{failure} – R restarts, Space goes on with a result that is no longer right"
                )
            return say(message, failure=session.failure), theme.FAILED
        if session.halted:
            message = say("{reason} – Space goes on anyway", reason=session.halted)
            return message, theme.NOTICE
        if session.waiting:
            target = formatting.error(session.level.stepping.accuracy or 0.0)
            text = say("Looking for the cheapest setting with an error of {asked} …", asked=target)
            return text, theme.NOTICE
        if not (self._note and self._left > 0) and session.at_end and not session.playing:
            return self._complete(session), theme.ACCENT
        return None

    def _complete(self, session: Session) -> str:
        if session.changes:
            return self._effect_of_changes(session)
        attempt = session.attempt()
        if attempt is not None and attempt.stars:
            earned = say(
                "{stars} of {most} stars", stars=attempt.stars, most=attempt.possible_stars
            )
            return say("{stars} – R restarts, F3 shows all challenges", stars=earned)
        when = formatting.seconds(session.duration)
        return say("Run complete at {when} – R restarts, Space goes on", when=when)

    def _effect_of_changes(self, session: Session) -> str:
        """Return how the changed effects alter the run, computed once per run and language."""
        world, spoken, text = self._ended
        if world is not session.world or spoken != language.used():
            text = switching_effects.summary(session, switching_effects.compared(session))
            self._ended = session.world, language.used(), text
        return text
