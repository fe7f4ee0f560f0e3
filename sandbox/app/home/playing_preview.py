"""The preview that plays on a card while the mouse rests on it, unless the level is expensive.

It is computed within the window's own frames, in a few milliseconds of each. A level is expensive
if it has many parts, asks for an accuracy, or if its steps or pictures take too long. Its card then
keeps its still picture.
"""

from pathlib import Path
from time import thread_time

import pygame

from sandbox.app.drawing.text import Pen
from sandbox.app.home.picture_cache import DRAWN
from sandbox.app.runs.session import Session
from sandbox.app.stage.stage import Stage
from sandbox.model.errors import SandboxError
from sandbox.model.level import Level
from sandbox.model.loading import MAX_BYTES, load

AFTER = 0.4  # s, the time that the mouse must rest on a card
LASTING = 6.0  # s, the part of the run that is shown
BUDGET = 0.003  # s, the time for steps in a frame
MOST = 0.010  # s, the processor time for steps and picture in a frame, on average
SMOOTHING = 0.2
"""The weight of the last frame in the average."""
PARTS = 16
"""The largest number of bodies and joints of a level that is previewed."""
LARGEST = min(20_000, MAX_BYTES)
"""The largest level file that is previewed [bytes]; a larger one takes too long to read in a
frame."""


class PlayingPreview:
    """Plays the level under the mouse on its card."""

    def __init__(self) -> None:
        self.path: Path | None = None
        """The level whose card is under the mouse, or None."""
        self._rested = 0.0  # s
        self._session: Session | None = None
        self._dear: set[Path] = set()
        self._cost = 0.0  # s

    @property
    def playing(self) -> bool:
        """Whether a preview is playing, or will start soon."""
        waits = self.path is not None and self.path not in self._dear and self._session is None
        return waits or (self._session is not None and self._session.playing)

    def stop(self) -> None:
        """Stop the preview."""
        self.path, self._session = None, None

    def follow(self, path: Path | None, seconds: float) -> None:
        """Advance by some time [s], with the mouse on a level's card or on none."""
        if path != self.path:
            self.path, self._rested, self._session = path, 0.0, None
        if path is None or path in self._dear:
            return
        self._rested += seconds
        if self._session is not None:
            self._play(self._session, path, seconds)
        elif self._rested >= AFTER:
            self._begin(path)

    def _begin(self, path: Path) -> None:
        """Start a level, unless it is expensive."""
        self._cost = 0.0
        try:
            level = load(path) if path.stat().st_size <= LARGEST else None
            if level is None or is_expensive(level):
                self._dear.add(path)
                return
            session = Session(level, patient=False)
        except (SandboxError, OSError):
            self._dear.add(path)  # the reason is shown when the level is opened
            return
        if session.waiting:
            self._dear.add(path)
            return
        self._session, session.playing = session, True
        self._stage, self._drawn = Stage(Pen(), DRAWN, plain=True), pygame.Surface(DRAWN)
        self._stage.use(session.world)
        for overlay in self._stage.shown:
            self._stage.shown[overlay] = overlay in ("trail", "flashes")
        self._stage.fit()

    def _play(self, session: Session, path: Path, seconds: float) -> None:
        """Take the steps that are due and draw the result; stop a level that takes too long."""
        if not session.playing:
            return
        begun = thread_time()
        session.update(seconds, BUDGET)
        if session.t >= LASTING:
            session.pause()
        self._stage.view.flashes = session.flashes
        self._stage.draw(self._drawn, session.trail)
        self._cost += SMOOTHING * (thread_time() - begun - self._cost)
        if self._cost > MOST or session.failure is not None:
            self._dear.add(path)
            self._session = None

    def picture(self, path: Path, size: tuple[int, int]) -> pygame.Surface | None:
        """Return the current picture of a level in a size [px]; None if it is not played."""
        if path != self.path or self._session is None or not self._session.world.steps:
            return None
        return pygame.transform.smoothscale(self._drawn, size)


def is_expensive(level: Level) -> bool:
    """Whether a level has too many parts for a preview, or asks for an accuracy."""
    return len(level.bodies) + len(level.joints) > PARTS or level.stepping.accuracy is not None
