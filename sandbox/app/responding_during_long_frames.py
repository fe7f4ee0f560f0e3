"""Handles events and shows a message during a long frame, such as a slow step or building a level.

A step is not split over frames. Long computations pass cancellation points
(`physics/state/cancellation_points.py`). There the window shows that it is responding, cancels the
computation if the user presses Esc or closes the window, and keeps all other events for the next
frame.
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from time import perf_counter

import pygame

from sandbox.app.drawing import theme
from sandbox.app.open_level_and_panels import OpenLevelAndPanels
from sandbox.app.panels import stage_messages
from sandbox.app.words.language import say
from sandbox.model.errors import SandboxError
from sandbox.physics.state.cancellation_points import cancellable

LONG = 0.25  # s, after which a message is shown
AGAIN = 0.1  # s, between two looks


class LongFrameWatch:
    """Keeps a window responsive during long frames."""

    def __init__(self, space: OpenLevelAndPanels) -> None:
        self._space = space
        self._kept: list[pygame.Event] = []
        self._since = self._looked = 0.0  # s
        self._behind: pygame.Surface | None = None  # the picture at the start

    @contextmanager
    def watched(self) -> Iterator[None]:
        """Return a context in which the window stays responsive."""
        self._since = self._looked = perf_counter()
        self._behind = None
        with cancellable(self._check_time):
            yield

    def events(self) -> Sequence[pygame.Event]:
        """Return the events since the last frame, including those kept during it."""
        kept, self._kept = self._kept, []
        return [*kept, *pygame.event.get()]

    def _check_time(self) -> None:
        """Show a message with the time taken, once the frame is long; raise if the user cancels."""
        now = perf_counter()
        if now - self._since < LONG or now - self._looked < AGAIN:
            return
        took = f"{now - self._since:.1f} s"
        stopped = self._stopped()
        self._draw(say("This takes long: {took}. Esc stops it.", took=took))
        self._looked = perf_counter()
        if stopped:
            raise SandboxError("stopped by Esc after {took}", took=took)

    def _stopped(self) -> bool:
        """Collect events, and return whether the user wants to stop or to quit."""
        stopped = False
        for event in pygame.event.get():
            if event.type == pygame.QUIT:
                self._space.open, stopped = False, True
            elif event.type == pygame.KEYDOWN and event.key == pygame.K_ESCAPE:
                stopped = True
            else:
                self._keep(event)
        return stopped

    def _keep(self, event: pygame.Event) -> None:
        """Keep an event; successive mouse movements are merged."""
        last = self._kept[-1] if self._kept else None
        if last and last.type == event.type == pygame.MOUSEMOTION and last.buttons == event.buttons:
            by = last.rel[0] + event.rel[0], last.rel[1] + event.rel[1]
            self._kept[-1] = pygame.Event(event.type, {**event.dict, "rel": by})
        else:
            self._kept.append(event)

    def _draw(self, text: str) -> None:
        """Draw a message across the middle of the last picture, at the window's current size."""
        surface = pygame.display.get_surface() or self._space.surface
        if self._behind is None:
            self._behind = surface.copy()
        surface.fill(theme.STAGE)
        surface.blit(self._behind, (0, 0))
        area = self._space.panels.layout.stage.clip(surface.get_rect())
        middle = pygame.Rect(area.x, area.centery, area.width, 0)
        stage_messages.draw_banner(surface, self._space.pen, middle, text, theme.NOTICE)
        pygame.display.flip()
