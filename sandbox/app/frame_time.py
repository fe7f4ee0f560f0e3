"""The time of a frame: how it is spent, and how much of it is left for steps."""

from collections import defaultdict, deque
from dataclasses import dataclass

FRAME = 1 / 60  # s
SMOOTHING = 0.1
"""The weight of the last frame in the averages."""

LEAST, MOST = 0.005, 0.013
"""Bounds on the part of a frame in time that steps may take [s]; with less left, it is late."""

SPARE = 0.0007
"""The reserve at the end of a frame [s]."""

MEMORY = 20
"""How many frames of each kind are remembered."""

ALMOST = 0.85
"""The share of those frames that must be in time; the others were held up by something else."""


@dataclass(slots=True)
class Load:
    """The time that frames take, as a moving average [s].

    Attributes
    ----------
    physics
        Steps without their Python callbacks, and reading their results.
    hooks
        The Python callbacks of steps: force laws and joints.
    drawing
        Panels and stage.
    """

    physics: float = 0.0
    hooks: float = 0.0
    drawing: float = 0.0

    def stepped(self, seconds: float, hooks: float) -> None:
        """Note how long the steps of a frame took, and the hooks within them [s]."""
        self.physics += SMOOTHING * (seconds - hooks - self.physics)
        self.hooks += SMOOTHING * (hooks - self.hooks)

    def drew(self, seconds: float) -> None:
        """Note how long drawing a frame took [s]."""
        self.drawing += SMOOTHING * (seconds - self.drawing)

    @property
    def shares(self) -> dict[str, float]:
        """Each part as a share of a frame."""
        parts = {"physics": self.physics, "hooks": self.hooks, "drawing": self.drawing}
        return {name: seconds / FRAME for name, seconds in parts.items()}


class Allowance:
    """Learns how long frames take besides their steps, separately for each kind of frame.

    While time runs, one frame in six brings a page up to date, and the next what stands below it.
    """

    def __init__(self) -> None:
        self._last: defaultdict[str, deque[float]] = defaultdict(lambda: deque(maxlen=MEMORY))

    def note(self, kind: str, seconds: float) -> None:
        """Note how long a frame of some kind took besides its steps [s]."""
        self._last[kind].append(seconds)

    def of(self, kind: str) -> float:
        """Return how long the steps of a frame of some kind may take [s]."""
        known = sorted(self._last[kind])
        rest = known[int(ALMOST * (len(known) - 1))] if known else FRAME / 2
        left = FRAME - SPARE - rest
        return min(left, MOST) if left >= LEAST else _late(rest)


def _late(rest: float) -> float:
    """Return how long steps may take in a frame that cannot be in time, beside the rest of it [s].

    It is as much as the rest, within 30 frames a second; a third, where that cannot be; and never
    more than two frames in time would take.
    """
    return min(rest, max(2 * FRAME - SPARE - rest, rest / 2), 2 * FRAME)
