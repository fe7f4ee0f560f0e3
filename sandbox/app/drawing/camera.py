"""The transformation between metres, y up, and pixels, y down: the only place where y flips."""

from collections.abc import Iterable

from sandbox.model.expressions import Values
from sandbox.model.shapes import XY, evaluate
from sandbox.model.view import View

ASPECT = 16 / 9
"""Width over height of the part of the plane in a level's view; a narrower picture shows only the
middle of it."""

LEAST, MOST = 1e-3, 1e5
"""Lower and upper bound of the scale [px/m]."""


class Camera:
    """The part of the plane that a surface shows."""

    def __init__(self, size: tuple[int, int]) -> None:
        self.size = size
        """The size of the surface [px]."""
        self.offset: XY = (0.0, 0.0)
        """How far the camera has moved with its observer [m]."""
        self._at: XY = (0.0, 0.0)  # the middle of the surface without that [m]
        self.scale = 50.0
        """The scale [px/m]."""
        self._width = self._middle = 10.0
        self.fitted = True
        """Whether it shows the level's view, rather than one chosen by the user."""

    @property
    def center(self) -> XY:
        """The point in the middle of the surface [m]."""
        return self._at[0] + self.offset[0], self._at[1] + self.offset[1]

    @center.setter
    def center(self, point: XY) -> None:
        self._at = point[0] - self.offset[0], point[1] - self.offset[1]

    def fit(self, view: View, values: Values) -> None:
        """Show a level's view."""
        self._at = evaluate(view.center, values)
        self._width = view.width(values)
        self._middle = self._width * view.middle
        self.fitted = True
        self._fill()

    def _fill(self) -> None:
        self.scale = min(self.size[0] / self._middle, self.size[1] * ASPECT / self._width)

    def resize(self, size: tuple[int, int]) -> None:
        """Set the size of the surface; a level's view is fitted again, else the scale stays."""
        self.size = size
        if self.fitted:
            self._fill()

    def to_screen(self, point: XY) -> XY:
        """Return the pixel of a point of the plane."""
        x = self.size[0] / 2 + (point[0] - self.center[0]) * self.scale
        y = self.size[1] / 2 - (point[1] - self.center[1]) * self.scale
        return x, y

    def path(self, points: Iterable[XY]) -> list[XY]:
        """Return the pixels of many points."""
        (width, height), (x, y), scale = self.size, self.center, self.scale
        return [(width / 2 + (px - x) * scale, height / 2 - (py - y) * scale) for px, py in points]

    def to_world(self, pixel: XY) -> XY:
        """Return the point of the plane under a pixel."""
        x = self.center[0] + (pixel[0] - self.size[0] / 2) / self.scale
        y = self.center[1] - (pixel[1] - self.size[1] / 2) / self.scale
        return x, y

    def pan(self, dx: float, dy: float) -> None:
        """Move the picture by some distance [px]."""
        self.center = self.center[0] - dx / self.scale, self.center[1] + dy / self.scale
        self.fitted = False

    def zoom(self, factor: float, pixel: XY | None = None) -> None:
        """Multiply the scale; the point under the pixel, by default the centre, stays in place."""
        pixel = pixel or (self.size[0] / 2, self.size[1] / 2)
        before = self.to_world(pixel)
        self.scale = min(max(self.scale * factor, LEAST), MOST)
        after = self.to_world(pixel)
        self.center = (
            self.center[0] + before[0] - after[0],
            self.center[1] + before[1] - after[1],
        )
        self.fitted = False

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """Left, bottom, right and top of the visible part of the plane [m]."""
        left, top = self.to_world((0, 0))
        right, bottom = self.to_world(self.size)
        return left, bottom, right, top
