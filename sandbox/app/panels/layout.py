"""How the window is divided."""

from collections.abc import Mapping
from dataclasses import dataclass

from pygame import Rect

BAR = 60  # px, the height of the controls
ROOM: Mapping[str, int] = {"levels": 860, "side": 700}
"""The window's width from which on there is room for each of the columns [px]."""


@dataclass(frozen=True, slots=True)
class Layout:
    """The parts of the window; hidden columns have no width."""

    levels: Rect
    stage: Rect
    side: Rect
    controls: Rect


def divide(size: tuple[int, int], levels: bool, side: bool) -> Layout:
    """Divide a window; the columns are narrower in a small one, and make way for the stage."""
    width, height = max(size[0], 480), max(size[1], 300)
    left = min(max(width * 19 // 100, 210), 290) if levels and width >= ROOM["levels"] else 0
    right = min(max(width // 4, 320), 400) if side and width >= ROOM["side"] else 0
    upper = height - BAR
    return Layout(
        levels=Rect(0, 0, left, upper),
        stage=Rect(left, 0, width - left - right, upper),
        side=Rect(width - right, 0, right, upper),
        controls=Rect(0, upper, width, BAR),
    )
