"""The protocol of the editor's tools, and their declaration."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

import pygame

from sandbox.app.building.partial_level import Sketch
from sandbox.app.building.pointer import Part, Snapped, Spot
from sandbox.app.drawing.camera import Camera
from sandbox.app.drawing.text import Pen
from sandbox.editing.edits.edit_result import Made
from sandbox.editing.foreseen import Proposed
from sandbox.model.level import Level
from sandbox.model.shapes import XY

STILL = 4.0  # px, the distance between press and release below which it is a click


class Bench(Protocol):
    """The level or the run, as a tool uses it."""

    camera: Camera
    """The camera of the stage."""
    sketch: Sketch
    """The drawing of the level."""
    selected: tuple[Part, ...]
    """The selected parts, the latest last."""
    ignored: frozenset[str]
    """The bodies to which nothing snaps, since they are being moved."""

    def make(self, said: str, edit: Callable[[str, Level], Made], family: str = "bodies") -> bool:
        """Add parts to the level and select them, and return whether that was possible."""

    def change(self, said: str, edit: Callable[[str, Level], str]) -> bool:
        """Change the level, and return whether that was possible."""

    def tell(self, text: str) -> None:
        """Show a message in the banner."""

    def select(self, parts: Sequence[Part]) -> None:
        """Replace the selection."""

    def with_group(self, part: Part) -> tuple[Part, ...]:
        """Return a part, with the other bodies of its group if it has one."""

    def part_at(self, pixel: XY) -> Part | None:
        """Return the topmost body or joint at a pixel; None if there is none."""

    def snapped_by(self, names: Sequence[str], by: XY) -> Snapped:
        """Return the displacement with which bodies touch what they come near [m]."""


class Tool(Protocol):
    """A tool: the use of the mouse on the stage while it is the current one."""

    @property
    def busy(self) -> bool:
        """Whether something is being drawn or dragged."""

    @property
    def hint(self) -> str:
        """A hint at what to do next."""

    @property
    def proposed(self) -> Proposed[str | Made] | None:
        """The edit that letting go or a click would make here; None if that makes none."""

    def press(self, spot: Spot) -> None:
        """Start, or set the next point."""

    def move(self, spot: Spot) -> None:
        """Update the preview."""

    def release(self, spot: Spot) -> None:
        """Finish a drag."""

    def finish(self) -> None:
        """Finish a shape that takes several clicks."""

    def cancel(self) -> None:
        """Cancel what is being drawn, or remove its last point."""

    def draw(self, surface: pygame.Surface, pen: Pen) -> None:
        """Draw the preview."""


@dataclass(frozen=True, slots=True)
class Kind:
    """The declaration of a tool, as the palette shows it."""

    name: str
    caption: str
    key: str
    """a digit, which chooses the tool while the page is open"""
    text: str
    """its description, for the tooltip and the help"""
    make: Callable[[Bench], Tool]
