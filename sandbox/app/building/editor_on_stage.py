"""The editor on the stage: it passes the mouse to the tools, and draws the level or the run."""

from functools import partial

import pygame

from sandbox.app.building import editor_painting
from sandbox.app.building.current_tool import FIRST, CurrentTool
from sandbox.app.building.edited_level import EditedLevel
from sandbox.app.building.fault_preview import FaultPreview
from sandbox.app.building.live_edits import EditableRun
from sandbox.app.building.mouse_position import MousePosition
from sandbox.app.building.rerun_after_edit import RerunAfterEdit
from sandbox.app.drawing.text import Pen
from sandbox.app.stage.stage import Stage
from sandbox.app.words.language import say
from sandbox.model.shapes import XY


class EditorOnStage:
    """Passes the mouse to the current tool, and draws the level with the preview of the tool."""

    def __init__(
        self, work: EditedLevel, live: EditableRun, tools: CurrentTool, applying: RerunAfterEdit
    ) -> None:
        self._work, self._live, self._tools, self._applying = work, live, tools, applying
        self._spot: MousePosition | None = None
        self._picture = editor_painting.CachedDrawing()
        self._foreseeing = FaultPreview()

    # the mouse

    def process(self, event: pygame.event.Event, area: pygame.Rect, stage: Stage) -> bool:
        """Pass a mouse event to the current tool, and return whether it was for it."""
        tools = self._tools
        tools.bench.camera = stage.camera
        if tools.bench is self._live:
            return self._change_run(event, area, stage)
        spot = self._spot = self._mouse_position((event.pos[0] - area.x, event.pos[1] - area.y))
        if event.type == pygame.MOUSEMOTION:
            tools.hand.move(spot)
            return False  # not used up: the same motion may move the view
        if event.button == 1 and event.type == pygame.MOUSEBUTTONUP:
            tools.hand.release(spot)
        elif event.button == 1 and area.collidepoint(event.pos):
            tools.hand.press(spot)
        return bool(event.button == 1)

    def _change_run(self, event: pygame.event.Event, area: pygame.Rect, stage: Stage) -> bool:
        """Let a tool change the run, with time stopped until it is done.

        The first tool, `FIRST`, only selects.
        """
        pixel, hand = (event.pos[0] - area.x, event.pos[1] - area.y), self._tools.hand
        pressed = event.type == pygame.MOUSEBUTTONDOWN and event.button == 1
        pressed = pressed and area.collidepoint(event.pos)
        if self._tools.tool == FIRST:
            if pressed:
                self._select_in_run(pixel, stage)
            return False
        if pressed:
            self._live.stop_time()
            self._live.read_state()
        spot = self._spot = self._mouse_position(pixel)
        if event.type == pygame.MOUSEMOTION:
            hand.move(spot)
        elif pressed:
            hand.press(spot)
        elif event.button == 1:
            hand.release(spot)
        self.resume_time()
        return event.type != pygame.MOUSEMOTION and bool(event.button == 1)

    def _select_in_run(self, pixel: XY, stage: Stage) -> None:
        live = self._live
        live.read_state()
        body = stage.body_at(pixel)
        part = ("bodies", body) if body else live.part_at(pixel)
        live.select([part] if part else ())

    def resume_time(self) -> None:
        """Let time run again unless something is being drawn into the run."""
        if not self._tools.hand.busy:
            self._live.let_time_run()

    def _mouse_position(self, pixel: XY) -> MousePosition:
        """Return the position of the mouse; while Alt is held it does not snap."""
        bench, modifiers = self._tools.bench, pygame.key.get_mods()
        free = bench.camera.to_world(pixel)
        shift, loose = bool(modifiers & pygame.KMOD_SHIFT), bool(modifiers & pygame.KMOD_ALT)
        catch = partial(bench.snapping.point, in_line=self._tools.tool == "join")
        return MousePosition(pixel, free, shift, loose, catch)

    # the picture

    def draw(self, surface: pygame.Surface, stage: Stage, pen: Pen) -> None:
        """Draw the level under edit."""
        work, tools, camera = self._work, self._tools, stage.camera
        surface.blit(self._picture.of(work, pen), (0, 0))
        self._foresee(surface, work)
        if not self._foreseeing.found:  # what is dragged is no longer where it was
            editor_painting.draw_culprits(surface, work.sketch, self._applying.culprits, camera)
        if self._spot is not None and tools.tool not in ("select", "delete"):
            editor_painting.caught(surface, camera, pen, self._spot.snapped)
        tools.hand.draw(surface, pen)
        self._draw_foreseen(surface, pen, say(tools.hand.hint))

    def _foresee(self, surface: pygame.Surface, bench: EditedLevel) -> None:
        """Preview the faults, unless the mouse is off the stage and nothing is begun."""
        hand, spot = self._tools.hand, self._spot
        if hand.busy or (spot is not None and surface.get_rect().collidepoint(spot.pixel)):
            self._foreseeing.update(bench, hand, spot)
        else:
            self._foreseeing.clear()

    def _draw_foreseen(self, surface: pygame.Surface, pen: Pen, hint: str) -> None:
        """Mark the faults of what the tool would make, or give a hint if there are none."""
        if not self._foreseeing.draw(surface, pen, self._tools.bench):
            editor_painting.draw_hint(surface, pen, hint)

    def draw_over(self, surface: pygame.Surface, stage: Stage, pen: Pen) -> None:
        """Draw the selection over the run, and the preview of what is added to it."""
        live, tools, view = self._live, self._tools, stage.view
        if tools.bench is not live:
            return
        for family, name in live.selected:
            if family == "bodies" and (outline := view.outlines.get(name)):
                corners = outline.placed(*view.state(outline))
                editor_painting.draw_around(surface, stage.camera, corners, closed=outline.closed)
        if tools.tool == FIRST:
            return
        if tools.hand.busy and self._spot is not None:
            editor_painting.caught(surface, stage.camera, pen, self._spot.snapped)
        if live.is_current:
            tools.hand.draw(surface, pen)
        self._foresee(surface, live)
        message = say("{hint}; time stands still until then", hint=say(tools.hand.hint))
        self._draw_foreseen(surface, pen, message)
