"""The base of the editor's tools, and what each declares."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

import pygame

from sandbox.app.building.partial_level import Sketch
from sandbox.app.building.pointer import Part, Snapped, Spot
from sandbox.app.drawing.camera import Camera
from sandbox.app.drawing.text import Pen
from sandbox.editing.edits.edit_result import Made
from sandbox.model.level import Level
from sandbox.model.shapes import XY

STILL = 4.0  # px; who moves less between press and release has clicked


class Bench(Protocol):
    """What a tool works on.

    Attributes
    ----------
    camera
        The camera of the stage.
    sketch
        The level as it is drawn.
    selected
        The parts that are selected, the last one chosen at the end.
    ignored
        The bodies to which nothing snaps: those that are moved.
    """

    camera: Camera
    sketch: Sketch
    selected: tuple[Part, ...]
    ignored: frozenset[str]

    def make(self, said: str, edit: Callable[[str, Level], Made], family: str = "bodies") -> bool:
        """Put something new into the level and select it; return whether that was possible."""
        ...

    def change(self, said: str, edit: Callable[[str, Level], str]) -> bool:
        """Change the level, and return whether that was possible."""
        ...

    def tell(self, text: str) -> None:
        """Show a message in the banner."""
        ...

    def select(self, parts: Sequence[Part]) -> None:
        """Select parts, in place of those that are."""
        ...

    def with_group(self, part: Part) -> tuple[Part, ...]:
        """Return what is selected with a part: the bodies of its group, or it alone."""
        ...

    def part_at(self, pixel: XY) -> Part | None:
        """Return the body or joint at a pixel; what is on top comes first."""
        ...

    def snapped_by(self, names: Sequence[str], by: XY) -> Snapped:
        """Return by how much to move bodies so that they touch what they come near [m]."""
        ...


class Tool(Protocol):
    """What the mouse does on the stage while the tool is in hand."""

    @property
    def busy(self) -> bool:
        """Whether something has been begun that is not done yet."""
        ...

    @property
    def hint(self) -> str:
        """What to do next, in a few words."""
        ...

    def press(self, spot: Spot) -> None:
        """Begin, or set one more point."""
        ...

    def move(self, spot: Spot) -> None:
        """Show what there would be."""
        ...

    def release(self, spot: Spot) -> None:
        """Be done with it, if it was dragged."""
        ...

    def finish(self) -> None:
        """Be done with what is set by several clicks."""
        ...

    def cancel(self) -> None:
        """Cancel what was begun, or its last part."""
        ...

    def draw(self, surface: pygame.Surface, pen: Pen) -> None:
        """Draw what there would be."""
        ...


@dataclass(frozen=True, slots=True)
class Kind:
    """A tool as the palette shows it."""

    name: str
    caption: str
    key: str
    """a digit, while the page is open"""
    text: str
    """what it does, for the tool tip and the help"""
    make: Callable[[Bench], Tool]
