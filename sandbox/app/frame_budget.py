"""The time of a frame: how it is spent, and how much is left for steps."""

from collections import defaultdict, deque
from dataclasses import dataclass

FRAME = 1 / 60  # s
SMOOTHING = 0.1
"""The weight of the last frame in the averages."""

LEAST, MOST = 0.005, 0.013
"""The least and the most time for steps in a frame that is on time [s]. If less than the least is
left, the frame is planned to be late."""

SPARE = 0.0007
"""The reserve at the end of a frame [s]."""

MEMORY = 20
"""The number of frames of each kind that are kept."""

ALMOST = 0.85
"""The quantile of these frames that is planned for; slower ones count as outliers."""


@dataclass(slots=True)
class Load:
    """The time that frames take, as a moving average [s]."""

    physics: float = 0.0
    """The time of steps without their Python callbacks, and of reading the results."""
    hooks: float = 0.0
    """The time of the Python callbacks of steps: force laws and joints."""
    drawing: float = 0.0
    """The time of drawing panels and stage."""

    def note_steps(self, seconds: float, hooks: float) -> None:
        """Record the time of a frame's steps, and of the hooks in them [s]."""
        self.physics += SMOOTHING * (seconds - hooks - self.physics)
        self.hooks += SMOOTHING * (hooks - self.hooks)

    def note_drawing(self, seconds: float) -> None:
        """Record the time of drawing a frame [s]."""
        self.drawing += SMOOTHING * (seconds - self.drawing)

    @property
    def shares(self) -> dict[str, float]:
        """Each part as a fraction of a frame."""
        parts = {"physics": self.physics, "hooks": self.hooks, "drawing": self.drawing}
        return {name: seconds / FRAME for name, seconds in parts.items()}


class FrameBudget:
    """Measures the time of frames besides their steps, separately for each kind of frame.

    While the run plays, one frame in six updates the page, and the next one the footer.
    """

    def __init__(self) -> None:
        self._last: defaultdict[str, deque[float]] = defaultdict(lambda: deque(maxlen=MEMORY))

    def note(self, kind: str, seconds: float) -> None:
        """Record the time of a frame of some kind besides its steps [s]."""
        self._last[kind].append(seconds)

    def of(self, kind: str) -> float:
        """Return the time for steps in a frame of some kind [s]."""
        recent = sorted(self._last[kind])
        rest = recent[int(ALMOST * (len(recent) - 1))] if recent else FRAME / 2
        left = FRAME - SPARE - rest
        return min(left, MOST) if left >= LEAST else _late(rest)


def _late(rest: float) -> float:
    """Return the time for steps in a late frame, given the time of the rest [s].

    Steps get as much time as the rest, but no more than keeps 30 frames per second. They always get
    at least half as much as the rest, and never more than two frames.
    """
    return min(rest, max(2 * FRAME - SPARE - rest, rest / 2), 2 * FRAME)
