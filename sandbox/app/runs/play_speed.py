"""The speed of play, and whether the machine keeps up."""

from collections import deque

SPEEDS = (0.05, 0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0)
"""Simulated seconds per second."""

MEMORY = 0.5  # s


class PlaySpeed:
    """Measures the pace of the simulation, and dropped steps, over the last `MEMORY` seconds."""

    def __init__(self) -> None:
        self._frames: deque[tuple[float, float, int]] = deque()

    def note(self, seconds: float, simulated: float, dropped: int) -> None:
        """Add a frame: its duration and simulated time [s], and the number of dropped steps."""
        self._frames.append((seconds, simulated, dropped))
        while sum(frame[0] for frame in self._frames) > MEMORY and len(self._frames) > 1:
            self._frames.popleft()

    @property
    def reduced(self) -> float | None:
        """The simulated seconds per second, if steps were dropped; else None."""
        if not any(dropped for _, _, dropped in self._frames):
            return None
        real = sum(seconds for seconds, _, _ in self._frames)
        return sum(simulated for _, simulated, _ in self._frames) / real if real else None


def faster(speed: float) -> float:
    """Return the next higher speed, or the highest."""
    return next((other for other in SPEEDS if other > speed), SPEEDS[-1])


def slower(speed: float) -> float:
    """Return the next lower speed, or the lowest."""
    return next((other for other in SPEEDS[::-1] if other < speed), SPEEDS[0])
