"""The limits on a run's time and memory at which the window pauses with a message.

Such a run is still valid, so the user may continue it. The window handles events between steps.
"""

from sandbox.app.words import formatting
from sandbox.app.words.language import later, say
from sandbox.physics.measuring.recording import Recorder
from sandbox.physics.stepping.time_limit import TimeLimit

SLOW = 1.0
"""The longest time of a step [s], since a frame waits for it."""


class TimeAndMemoryLimits:
    """Watches one run."""

    recorder: Recorder

    def __init__(self) -> None:
        self.message = ""
        """Why the run is to pause; empty if it is within the limits."""
        self._patience: TimeLimit | None = TimeLimit(SLOW)
        self._room = True  # until the user has been told

    def stepped(self, seconds: float) -> None:
        """Record a step with the time that it took [s]."""
        if self._patience and self._patience.lost(seconds):
            message = later("A step takes {time}; the window waits for each")
            self.message = say(message, time=formatting.seconds(seconds))
            self._patience = None  # the user has been told
        elif self._room and self.recorder.is_full:
            self.message = say(
                "{count:,} instants are recorded, the most possible: checks ignore later ones",
                count=len(self.recorder),
            )
            self._room = False
        else:
            self.message = ""

    def continue_run(self) -> None:
        """Continue the run, and clear the message."""
        self.message = ""
