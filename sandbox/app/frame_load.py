"""How a frame's time is spent."""

from dataclasses import dataclass

FRAME = 1 / 60  # s
SMOOTHING = 0.1
"""The weight of the last frame."""


@dataclass(slots=True)
class Load:
    """The time that a frame takes, smoothed over some [s].

    Attributes
    ----------
    physics
        The steps without the calls of Python in them, and reading what has come of them.
    hooks
        The calls of Python in the steps: force laws and joints.
    drawing
        Panels and stage.
    """

    physics: float = 0.0
    hooks: float = 0.0
    drawing: float = 0.0

    def stepped(self, seconds: float, hooks: float) -> None:
        """Note what a frame has spent on its steps, and of that on the hooks in them [s]."""
        self.physics += SMOOTHING * (seconds - hooks - self.physics)
        self.hooks += SMOOTHING * (hooks - self.hooks)

    def drew(self, seconds: float) -> None:
        """Note what a frame has spent on drawing [s]."""
        self.drawing += SMOOTHING * (seconds - self.drawing)

    @property
    def shares(self) -> dict[str, float]:
        """The shares of a frame."""
        parts = {"physics": self.physics, "hooks": self.hooks, "drawing": self.drawing}
        return {name: seconds / FRAME for name, seconds in parts.items()}
