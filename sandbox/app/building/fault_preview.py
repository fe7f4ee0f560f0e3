"""Marks what could not run while it is still being drawn or dragged."""

from time import perf_counter

import pygame

from sandbox.app.building import editor_painting
from sandbox.app.building.edited_level import EditedLevel
from sandbox.app.building.partial_level import parts_of
from sandbox.app.building.tools.tool import Tool
from sandbox.app.drawing.text import Pen
from sandbox.app.words.language import say
from sandbox.editing.foreseen_faults import ForeseenFaults, Foresight
from sandbox.model.errors import SandboxError

PATIENCE = 3
"""The pause between two looks ahead, as a multiple of the time of the last: a quarter of a core."""


class FaultPreview:
    """Looks ahead at what the tool in hand would make.

    Attributes
    ----------
    found
        What it would make, and its faults; None if it would make nothing, or too much.
    """

    def __init__(self) -> None:
        self._foresight: Foresight | None = None
        self._version: object = None  # of the level that it is for
        self._seen: object = None  # the place of the mouse that was looked at
        self._pause_ends = 0.0
        self.found: ForeseenFaults | None = None

    def update(self, work: EditedLevel, hand: Tool, mouse: object) -> None:
        """Find the faults of what the tool would make with the mouse at a place."""
        seen = work.version, hand, mouse
        if seen == self._seen or perf_counter() < self._pause_ends:
            return
        begun, proposed = perf_counter(), hand.proposed
        self._seen, self.found = seen, None
        if proposed is not None and (foresight := self._foresight_of(work)):
            self.found = foresight.of(proposed)
            self._pause_ends = begun + (1 + PATIENCE) * (perf_counter() - begun)

    def clear(self) -> None:
        """Forget what was found, as nothing would be made now."""
        self._seen, self.found = None, None

    def _foresight_of(self, work: EditedLevel) -> Foresight | None:
        if self._version is not work.version:
            self._version = work.version
            try:
                self._foresight = Foresight(work.document, work.level)
            except SandboxError:  # the last edit made an invalid level, and will be undone
                self._foresight = None
        return self._foresight

    def draw(self, surface: pygame.Surface, pen: Pen, work: EditedLevel) -> bool:
        """Mark the parts that could not be together, where they would be, and say why.

        Return whether there are any.
        """
        found = self.found
        if found is None or not found.faults:
            return False
        names = frozenset[str]().union(*(fault.names for fault in found.faults))
        if found.changed is not None:
            changed = parts_of(found.changed)
            editor_painting.draw_culprits(surface, changed, names, work.camera)
            names -= changed.bodies.keys() | changed.joints.keys()
        editor_painting.draw_culprits(surface, work.sketch, names, work.camera)
        editor_painting.draw_hint(surface, pen, say(found.faults[0].reason), refused=True)
        return True
