"""The limits on a run's time and memory at which the window pauses and says so.

Nothing is wrong with such a run, so that it goes on whenever somebody wants it to. The window
answers between any two steps.
"""

from sandbox.app.words import formatting
from sandbox.app.words.language import later, say
from sandbox.physics.measuring.recording import Recorder
from sandbox.physics.stepping.time_limit import Patience

SLOW = 1.0
"""s, how long a step may take, since a frame waits for it."""


class Limits:
    """Watches one run.

    Attributes
    ----------
    message
        Why the run is to pause; empty while nothing is the matter.
    recorder
        The recorder of the run.
    """

    recorder: Recorder

    def __init__(self) -> None:
        self.message = ""
        self._patience: Patience | None = Patience(SLOW)
        self._room = True  # as far as anybody has been told

    def stepped(self, seconds: float) -> None:
        """Take note of a step and how long it took [s]."""
        if self._patience and self._patience.lost(seconds):
            message = later("A step takes {time}; the window waits for each")
            self.message = say(message, time=formatting.seconds(seconds))
            self._patience = None  # somebody knows
        elif self._room and self.recorder.full:
            self.message = say(
                "{count:,} instants are recorded, the most there can be: checks see no more",
                count=len(self.recorder),
            )
            self._room = False
        else:
            self.message = ""

    def bear(self) -> None:
        """Go on all the same."""
        self.message = ""
