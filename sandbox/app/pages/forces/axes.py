"""The axes along which forces are split: those of the plane, or those of a surface."""

from math import hypot

from sandbox.app.runs.session import Session
from sandbox.model.shapes import XY
from sandbox.physics.measuring.free_body import FreeBody

ALONG_X: XY = (1.0, 0.0)


class Axes:
    """Remembers the choice of axes, as long as the window is open.

    Attributes
    ----------
    news
        Another object whenever something else is chosen.
    inclined
        Whether axes lie along the surface that presses hardest on the body, or else along its way.
    """

    running = False

    def __init__(self) -> None:
        self.news, self.inclined = object(), False

    def turn(self) -> None:
        """Choose the other axes."""
        self.news, self.inclined = object(), not self.inclined

    def first(self, found: FreeBody, velocity: XY) -> XY:
        """Return a unit vector along the first axis; the second is a quarter turn on from it."""
        if not self.inclined:
            return ALONG_X
        if found.along:
            x, y = found.along[0]
            return (-x, -y) if x < 0 else (x, y)
        speed = hypot(*velocity)
        return (velocity[0] / speed, velocity[1] / speed) if speed else ALONG_X

    def follow(self, session: Session, seconds: float, *, watched: bool) -> str | None:
        """There is nothing to find out."""

    def cancel(self) -> None:
        """There is no work that could be ended."""


def components(vector: XY, first: XY) -> XY:
    """Return the components of a vector along an axis and a quarter turn on from it."""
    (x, y), (u, v) = vector, first
    return x * u + y * v, y * u - x * v
