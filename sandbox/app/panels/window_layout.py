"""The division of the window into stage, columns and bars."""

from collections.abc import Mapping
from dataclasses import dataclass

from pygame import Rect

BAR = 60  # px, the height of the controls
ROOM: Mapping[str, int] = {"levels": 860, "side": 700}
"""The least window width with each column [px]."""
LEVELS = 210, 290  # px, the least and the largest width of the list, at scale 1
SIDE = 320, 400  # px, the same for the side panel
STAGE = 460, 300  # px, the least width of the stage with both columns, and with the side panel only


@dataclass(frozen=True, slots=True)
class WindowLayout:
    """The parts of the window; the width of a hidden column is 0."""

    levels: Rect
    stage: Rect
    side: Rect
    controls: Rect


def room(column: str, scale: float, *, beside: bool) -> int:
    """Return the least width of a window with a column, with or without the other [px]."""
    if column == "side":
        return ROOM["side"]
    other = round(SIDE[0] * scale) if beside else 0
    return max(ROOM["levels"], round(LEVELS[0] * scale) + other + STAGE[0])


def divide(size: tuple[int, int], levels: bool, side: bool, scale: float = 1.0) -> WindowLayout:
    """Divide a window; in a narrow one the columns are narrower, or hidden.

    At a larger scale they are wider, and the list is hidden before the side panel.
    """
    width, height = max(size[0], 480), max(size[1], 300)
    bar = round(BAR * scale)
    right = 0
    if side and width >= room("side", scale, beside=levels):
        right = _between(SIDE, scale, width // 4)
        right = min(right, width - STAGE[1])
    left = 0
    if levels and width >= room("levels", scale, beside=bool(right)):
        left = _between(LEVELS, scale, width * 19 // 100)
        left = min(left, width - right - STAGE[0])
    upper = height - bar
    return WindowLayout(
        levels=Rect(0, 0, left, upper),
        stage=Rect(left, 0, width - left - right, upper),
        side=Rect(width - right, 0, right, upper),
        controls=Rect(0, upper, width, bar),
    )


def _between(bounds: tuple[int, int], scale: float, wanted: int) -> int:
    """Return a width clamped to scaled bounds [px]."""
    least, most = (round(bound * scale) for bound in bounds)
    return min(max(wanted, least), most)
