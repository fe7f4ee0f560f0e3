"""The mouse position on the stage, as the tools receive it."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from sandbox.model.shapes import XY

Part = tuple[str, str]
"""A body or a joint: `bodies` or `joints`, and its name."""


class SnappedPoint(NamedTuple):
    """A point after snapping, and what it snapped to."""

    point: XY
    """m, its position"""
    snapped_to: str
    """such as `grid`, or the bodies that are touched; empty if it did not snap"""


@dataclass(frozen=True)
class MousePosition:
    """The position of the mouse."""

    pixel: XY
    """Its position on the stage [px]."""
    unsnapped: XY
    """Its position in the plane, before snapping [m]."""
    shift: bool
    """Whether Shift is held."""
    is_snapping_off: bool
    """Whether Alt is held, which turns off snapping."""
    snap: Callable[[XY], SnappedPoint]
    """The function that snaps a point."""

    @cached_property
    def snapped(self) -> SnappedPoint:
        """The position after snapping to the grid or a part of the scene."""
        return (
            SnappedPoint(self.unsnapped, "") if self.is_snapping_off else self.snap(self.unsnapped)
        )

    @property
    def point(self) -> XY:
        """The position of a point that is set here [m]."""
        return self.snapped.point
