"""The tool that deletes bodies and joints."""

import pygame

from sandbox.app.building.edited_level import EditedLevel
from sandbox.app.building.mouse_position import MousePosition, Part
from sandbox.app.building.tools.tool import Tool
from sandbox.app.drawing import lines, theme
from sandbox.app.drawing.text import Pen
from sandbox.app.words.language import later, say
from sandbox.editing.edits import bodies
from sandbox.model.level import Level

CROSS = 6.0  # px


class DeleteTool(Tool):
    """Deletes the part that is clicked on."""

    hint = later("Click what to delete; a body takes its joints along")

    def __init__(self, bench: EditedLevel) -> None:
        super().__init__(bench)
        self._under: Part | None = None
        self._spot: MousePosition | None = None

    def press(self, mouse: MousePosition) -> None:
        """Delete the part there."""
        part = self._bench.part_at(mouse.pixel)
        if part is not None:
            name = part[1]

            def edit(text: str, level: Level) -> str:
                return bodies.remove_parts(text, level, [name])

            self._bench.change(say("delete {names}", names=name), edit)
        self._under = None

    def move(self, mouse: MousePosition) -> None:
        """Find the part that would be deleted."""
        self._spot, self._under = mouse, self._bench.part_at(mouse.pixel)

    def draw(self, surface: pygame.Surface, pen: Pen) -> None:
        """Mark the part that would be deleted."""
        if self._under is None or self._spot is None:
            return
        x, y = self._spot.pixel
        for a, b in (((-1, -1), (1, 1)), ((-1, 1), (1, -1))):
            start, end = (x + CROSS * a[0], y + CROSS * a[1]), (x + CROSS * b[0], y + CROSS * b[1])
            lines.stroke(surface, theme.FAILED, start, end, 2)
        text = pen.outlined(self._under[1])
        surface.blit(text, text.get_rect(midbottom=(round(x), round(y) - 10)))
