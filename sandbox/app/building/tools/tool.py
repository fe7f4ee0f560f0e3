"""The base of the editor's tools, and their declaration."""

from collections.abc import Callable
from dataclasses import dataclass

import pygame

from sandbox.app.building.edited_level import EditedLevel
from sandbox.app.building.mouse_position import MousePosition
from sandbox.app.drawing.text import Pen
from sandbox.editing.edits.edit_result import EditResult
from sandbox.editing.foreseen_faults import Proposed

STILL = 4.0  # px, the distance between press and release below which it is a click


class Tool:
    """The use of the mouse on the stage while it is the current tool; by default, none."""

    def __init__(self, bench: EditedLevel) -> None:
        self._bench = bench

    @property
    def busy(self) -> bool:
        """Whether something is being drawn or dragged."""
        return False

    @property
    def hint(self) -> str:
        """A hint at what to do next."""
        return ""

    @property
    def proposed(self) -> Proposed[str | EditResult] | None:
        """The edit that letting go or a click would make here; None if that makes none."""

    def press(self, mouse: MousePosition) -> None:
        """Start, or set the next point."""

    def move(self, mouse: MousePosition) -> None:
        """Update the preview."""

    def release(self, mouse: MousePosition) -> None:
        """Finish a drag."""

    def finish(self) -> None:
        """Finish a shape that takes several clicks."""

    def cancel(self) -> None:
        """Cancel what is being drawn, or remove its last point."""

    def draw(self, surface: pygame.Surface, pen: Pen) -> None:
        """Draw the preview."""


@dataclass(frozen=True, slots=True)
class ToolDeclaration:
    """The declaration of a tool, as the palette shows it."""

    name: str
    caption: str
    key: str
    """a digit, which chooses the tool while the page is open"""
    text: str
    """its description, for the tooltip and the help"""
    make: Callable[[EditedLevel], Tool]
