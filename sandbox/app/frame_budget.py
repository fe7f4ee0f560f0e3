"""What a frame can spend on steps, so that it is in time all the same."""

from collections import defaultdict, deque

from sandbox.app.frame_load import FRAME

LEAST, MOST = 0.005, 0.013
"""s, of a frame that is in time for steps; where less would be left, it is late anyway."""

SPARE = 0.0007
"""s, that are left over."""

MEMORY = 20
"""Frames of a kind that are remembered."""

ALMOST = 0.85
"""The share of them that shall be in time; the rest is held up by who knows what."""


class Allowance:
    """Learns what frames take beside their steps, each kind for itself.

    While time runs, one frame in six brings a page up to date, and the next what stands below it.
    """

    def __init__(self) -> None:
        self._last: defaultdict[str, deque[float]] = defaultdict(lambda: deque(maxlen=MEMORY))

    def note(self, kind: str, seconds: float) -> None:
        """Note what a frame of some kind took beside its steps [s]."""
        self._last[kind].append(seconds)

    def of(self, kind: str) -> float:
        """Return what a frame of some kind has for steps [s]."""
        known = sorted(self._last[kind])
        rest = known[int(ALMOST * (len(known) - 1))] if known else FRAME / 2
        left = FRAME - SPARE - rest
        return min(left, MOST) if left >= LEAST else _late(rest)


def _late(rest: float) -> float:
    """Return what steps have of a frame that cannot be in time, beside the rest of it [s].

    It is as much as the rest, within 30 frames a second; a third, where that cannot be; and never
    more than two frames in time would take.
    """
    return min(rest, max(2 * FRAME - SPARE - rest, rest / 2), 2 * FRAME)
