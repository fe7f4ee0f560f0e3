"""The window: events in, frames out."""

import gc
from collections.abc import Iterator, Sequence
from time import perf_counter

import pygame

from sandbox.app.command_actions import CommandActions
from sandbox.app.files.open_level_watch import FileWatch
from sandbox.app.frame_budget import FrameBudget
from sandbox.app.frame_painting import paint
from sandbox.app.impact_sounds import Sounds
from sandbox.app.input_event_dispatch import InputEventDispatch
from sandbox.app.malloc_tuning import give_back_gaps
from sandbox.app.open_level_and_panels import SIZE, OpenLevelAndPanels
from sandbox.app.pages.register import preload
from sandbox.app.responding_during_long_frames import LongFrameWatch
from sandbox.app.runs.session import Session
from sandbox.app.words.language import say

RATE = 60  # frames per second
QUIET_RATE = 20  # frames per second while the window is idle
QUIET = 1.0  # s without an event, after which the window is idle
LONGEST_FRAME = 0.1  # s; a longer frame counts as this long


class Window(OpenLevelAndPanels):
    """The desktop app. `run` it, or drive it `frame` by `frame`."""

    def __init__(self, size: tuple[int, int] = SIZE) -> None:
        super().__init__(size)
        self.commands = CommandActions(self)
        """The commands, by name."""
        self._events = InputEventDispatch(self, self.commands)
        self._watch, self._sounds = FileWatch(), Sounds()
        self.hold_up = LongFrameWatch(self)
        """Keeps the window responsive during long frames."""
        self._quiet = 0.0  # s since the last event
        self._allowance, self._stepped = FrameBudget(), 0.0  # s, in this frame

    def do(self, command: str) -> None:
        """Execute a command, as its key does."""
        self.commands.do(command)

    def run(self) -> None:
        """Show frames until the window is closed."""
        for _ in self.pictures():
            pass

    def pictures(self) -> Iterator[None]:
        """Show frames until the window is closed, and yield after each."""
        self._show(0.0)
        yield
        self.preload()
        clock, before, frozen = pygame.time.Clock(), perf_counter(), self._followed
        while self.open:
            clock.tick(RATE if self._busy else QUIET_RATE)
            now = perf_counter()
            self._show(min(now - before, LONGEST_FRAME))
            if self._followed is not frozen:  # the frozen widgets are not in use any more: 23 MB
                self.preload()
                frozen = self._followed
            self._keep_run(now - before)
            before = now
            yield
        self.recovery.delete()

    def _keep_run(self, seconds: float) -> None:
        """Keep the run in a file, after some time [s], until the window is closed on purpose."""
        if self.session is not None and (why := self.recovery.follow(self.session, seconds)):
            self.banner.write(say(why))

    def _show_at_once(self, text: str) -> None:
        if self.empty:  # the first level is still being prepared: show the rest of the window
            self.lay_out()
            for _ in range(2):  # the rows of the list are made in the first
                self.panels.update(0.0)
            self._draw(0.0)
        super()._show_at_once(text)

    def _show(self, seconds: float) -> None:
        self.frame(seconds)
        pygame.display.flip()

    @staticmethod
    def preload() -> None:
        """Import all pages, collect garbage and freeze what remains: later it would take frames.

        What was frozen before and has been replaced since is garbage, too.
        """
        preload()
        gc.unfreeze()
        gc.collect()
        gc.freeze()
        gc.enable()

    @property
    def _busy(self) -> bool:
        playing = self.session is not None and self.session.playing
        playing = playing or self.panels.home.preview.playing
        return playing or self._quiet < QUIET or self.workers.running or self.advising.running

    def frame(self, seconds: float) -> None:
        """Handle events, advance by some time [s], and draw."""
        begun, side, self._stepped = perf_counter(), self.panels.side, 0.0
        kind = side.due_part(seconds) if side is not None else ""
        with self.hold_up.watched():
            self._advance(seconds, self._allowance.of(kind))
        self._draw(seconds)
        if self._stepped:
            self._allowance.note(kind, perf_counter() - begun - self._stepped)

    def _advance(self, seconds: float, allowed: float) -> None:
        """Handle events, and advance by some time [s]; steps may take the allowed time [s]."""
        for event in self._new_events(seconds):
            self._events.handle(event)
        self.apply_preferences()
        if self._watch.changed(self.path, seconds) and self.path is not None:
            self.reload_changed(self.path)
        if self.session is not None:
            self.advising.follow(self.session)
        self.panels.offer_rate(self.advised)
        self.panels.update(seconds)
        self.banner.update(seconds)
        if self.session is not None:
            self._events.leave_fields()
            self.session.book(self.panels.side is not None and self.panels.side.books)
            self.undoing.follow(self.session, seconds)
            self._play(self.session, seconds, allowed)
            for text in self.workers.follow(self.session, seconds, self.panels.page):
                self.banner.write(text)
                self.panels.mark_stars()  # some may have been earned
            self.follow(self.session)
        if self.panels.home.open:
            self.panels.follow_home()
            if not self.comfort.chosen.reduced:
                self.panels.home.play(seconds)

    def _new_events(self, seconds: float) -> Sequence[pygame.Event]:
        """Return the events since the last frame; release memory once when the window gets idle."""
        events, before = self.hold_up.events(), self._quiet
        self._quiet = 0.0 if events else before + seconds
        if before < QUIET <= self._quiet:
            give_back_gaps()
        return events

    def _play(self, session: Session, seconds: float, allowed: float) -> None:
        """Advance the run by some time [s], and measure the computing time."""
        world, hooks, begun = session.world, session.world.kicks.seconds, perf_counter()
        steps, seeking = world.steps, session.sought is not None
        session.update(seconds, allowed)
        if session.playing:
            self._stepped = perf_counter() - begun
            self.load.note_steps(self._stepped, world.kicks.seconds - hooks)
        if self.comfort.chosen.sound and not seeking:
            self._sounds.play(session.run.blows.since(steps), session.world, seconds)

    def _draw(self, seconds: float) -> None:
        """Draw, and measure the time that it takes."""
        begun = perf_counter()
        if self.panels.side is not None:
            self.panels.side.update(seconds)
        self.panels.controls.update(self.session, self.stage.shown)
        paint(self)
        self.load.note_drawing(perf_counter() - begun)

    def close(self) -> None:
        """Stop all background work."""
        self.cancel()
