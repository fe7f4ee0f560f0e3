"""The mouse position on the stage, as the tools receive it."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from sandbox.model.shapes import XY

Part = tuple[str, str]
"""A body or a joint: `bodies` or `joints`, and its name."""


class Snapped(NamedTuple):
    """Where a point was caught, and what by."""

    point: XY
    """m"""
    by: str
    """such as `grid`, or what is touched; empty where nothing caught it"""


@dataclass(frozen=True)
class Spot:
    """Where the mouse is.

    Attributes
    ----------
    pixel
        On the stage [px].
    free
        In the plane, as the mouse says [m].
    shift
        Whether Shift is held.
    loose
        Whether Alt is held, so that nothing catches what is drawn or moved.
    catch
        What catches a point.
    """

    pixel: XY
    free: XY
    shift: bool
    loose: bool
    catch: Callable[[XY], Snapped]

    @cached_property
    def snapped(self) -> Snapped:
        """The same place, where the grid or a part of the scene has caught it."""
        return Snapped(self.free, "") if self.loose else self.catch(self.free)

    @property
    def point(self) -> XY:
        """Where a point is put that is set here [m]."""
        return self.snapped.point
