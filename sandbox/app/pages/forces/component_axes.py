"""The axes of the components of forces: those of the plane, or those of a surface."""

from math import hypot

from sandbox.app.pages.page import IdleWorker
from sandbox.model.shapes import XY
from sandbox.physics.measuring.free_body import FreeBody

ALONG_X: XY = (1.0, 0.0)


class Axes(IdleWorker):
    """Keeps the choice of axes while the window is open."""

    def __init__(self) -> None:
        super().__init__()
        self.inclined = False
        """If true, the first axis is along the surface that presses hardest on the body, or along
        its velocity if none does. If false, it is x."""

    def switch(self) -> None:
        """Switch to the other axes."""
        self.news, self.inclined = object(), not self.inclined

    def first(self, found: FreeBody, velocity: XY) -> XY:
        """Return the first axis, a unit vector; the second is a quarter turn counter-clockwise."""
        if not self.inclined:
            return ALONG_X
        if found.surface_directions:
            x, y = found.surface_directions[0]
            return (-x, -y) if x < 0 else (x, y)
        speed = hypot(*velocity)
        return (velocity[0] / speed, velocity[1] / speed) if speed else ALONG_X


def components(vector: XY, first: XY) -> XY:
    """Return the components of a vector along an axis, and a quarter turn counter-clockwise."""
    (x, y), (u, v) = vector, first
    return x * u + y * v, y * u - x * v
