"""A stopwatch for the time of the run, started and stopped by hand or by events."""

from math import ceil, log10
from typing import NamedTuple

import pygame

from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color
from sandbox.app.pages.page import IdleWorker
from sandbox.app.pages.table.stopwatch_triggers import BY_HAND, StopwatchTrigger, TriggerTime, find
from sandbox.app.runs.live_run import LiveRun
from sandbox.app.runs.session import Session
from sandbox.app.words.language import say

BETWEEN = 0.01
"""The resolution of an event's time between two steps, as a share of a step."""
CORNER = 16, 62  # px, from the upper right corner, below a banner of one line
PADDING = 8  # px
DIAL = 8  # px, the radius of the sign beside the time


class Reading(NamedTuple):
    """The display of a stopwatch."""

    seconds: float
    """The measured time [s]."""
    decimals: int
    """The number of significant decimals."""
    has_started: bool
    """Whether it was started."""
    is_running: bool
    """Whether it is still running."""

    @property
    def text(self) -> str:
        """The time as text."""
        return f"{self.seconds:.{self.decimals}f} s"

    @property
    def color(self) -> Color:
        """The colour of the display, which shows whether the stopwatch runs."""
        return theme.NOTICE if self.is_running else theme.TEXT if self.has_started else theme.DIM


class Stopwatch(IdleWorker):
    """Measures the time between two moments of the run, up to the shown state.

    Attributes
    ----------
    starts, stops
        The triggers that start and stop it.
    shown
        Whether it is visible, from its first use until it is put away.
    news
        An object that differs whenever the display must change.
    """

    def __init__(self) -> None:
        super().__init__()
        self._session: Session | None = None
        self.hide()

    def hide(self) -> None:
        """Reset the measured time and the triggers, and hide it."""
        self.starts = self.stops = BY_HAND
        self.reset()
        self.shown = False

    def reset(self) -> None:
        """Discard the times of presses by hand."""
        self._began: float | None = None
        self._ended: float | None = None
        self._known: tuple[LiveRun, dict[StopwatchTrigger, TriggerTime]] | None = None
        self._read: tuple[tuple[object, ...], Reading] | None = None
        self.news = object()

    def choose(self, starts: StopwatchTrigger, stops: StopwatchTrigger) -> None:
        """Choose the triggers that start and stop it."""
        self.starts, self.stops = starts, stops
        self.reset()
        self.shown = True

    def press(self, session: Session) -> str | None:
        """Start or stop it; return a message if that is impossible."""
        self._follow_level(session)
        self.shown, self.news = True, object()
        if BY_HAND not in (self.starts, self.stops):
            return say(
                "The run starts and stops the stopwatch; the page Table can switch it to manual"
            )
        again = self._began is None or self._ended is not None or self.stops is not BY_HAND
        if self.starts is BY_HAND and again:
            self._began, self._ended = session.t, None
        else:
            self._ended = session.t
        return None

    def reading(self, session: Session) -> Reading:
        """Return the reading at the shown step, which is the same each time.

        It is computed once in a step, since an event that has not happened yet is searched in all
        states.
        """
        step = session.world, session.world.steps, self.news
        if self._read is None or self._read[0] != step:
            self._read = step, self._found(session)
        return self._read[1]

    def _found(self, session: Session) -> Reading:
        dt, now = session.world.dt, TriggerTime(session.t, between=False)
        began = self._trigger_time(self.starts, self._began, session.run)
        ended = self._trigger_time(self.stops, self._ended, session.run)
        if began is None or began.t > now.t:
            return Reading(0.0, _decimals(dt), has_started=False, is_running=False)
        going = ended is None or not began.t <= ended.t <= now.t
        last = now if going or ended is None else ended
        sharp = began.between and last.between
        decimals = _decimals(dt * BETWEEN if sharp else dt)
        return Reading(last.t - began.t, decimals, has_started=True, is_running=going)

    def _trigger_time(
        self, occasion: StopwatchTrigger, pressed: float | None, run: LiveRun
    ) -> TriggerTime | None:
        if occasion.at is None:
            return None if pressed is None else TriggerTime(pressed, between=False)
        if self._known is None or self._known[0] is not run:
            self._known = run, {}
        crossing = self._known[1]
        if occasion not in crossing and (found := find(occasion.at, run)) is not None:
            crossing[occasion] = found
        return crossing.get(occasion)

    def follow(self, session: Session, seconds: float, *, watched: bool) -> str | None:  # noqa: ARG002
        """Put it away when another level is opened."""
        self._follow_level(session)
        return None

    def _follow_level(self, session: Session) -> None:
        if session is not self._session:
            self._session = session
            self.hide()

    def draw(self, surface: pygame.Surface, pen: Pen, session: Session) -> None:
        """Draw it in the upper right corner, if it is visible."""
        if not self.shown:
            return
        reading = self.reading(session)
        text = pen.write(reading.text, 20, reading.color, True)
        dial, pad = pen.px(DIAL), pen.px(PADDING)
        box = pygame.Rect(0, 0, text.width + 2 * dial + 3 * pad, text.height + pad)
        box.topright = surface.width - CORNER[0], CORNER[1]
        pygame.draw.rect(surface, theme.PANEL, box, border_radius=6)
        pygame.draw.rect(surface, theme.EDGE, box, 1, border_radius=6)
        center = box.left + pad + dial, box.centery
        pygame.draw.aacircle(surface, reading.color, center, dial, 2)
        pygame.draw.line(surface, reading.color, center, (center[0], center[1] - dial + 3), 2)
        surface.blit(text, text.get_rect(midleft=(center[0] + dial + pad, box.centery)))


def _decimals(resolution: float) -> int:
    """Return the number of significant decimals of a time with a resolution [s]."""
    return max(ceil(-log10(resolution) - 1e-9), 0)
