"""Paints a frame of the window: the stage or the home page, the columns, and the help."""

import pygame

from sandbox.app.drawing import theme
from sandbox.app.measuring import trail_probe
from sandbox.app.observing.earlier_runs import have_same_bodies
from sandbox.app.open_level_and_panels import OpenLevelAndPanels
from sandbox.app.pages.register import page, runs_beside
from sandbox.app.pages.table.stopwatch import Stopwatch
from sandbox.app.panels import stage_messages
from sandbox.app.runs.session import Session
from sandbox.app.stage import run_legend


def paint(space: OpenLevelAndPanels) -> None:
    """Draw a window on its surface."""
    layout, surface = space.panels.layout, space.surface
    area = layout.stage.clip(surface.get_rect())
    if space.panels.home.open:
        space.panels.home.draw(surface)
        space.banner.draw(surface, space.pen, area, None)
    elif space.session is not None and area:
        _paint_stage(space, surface.subsurface(area), space.session)
    else:
        surface.fill(theme.STAGE, layout.stage)
    for column in (layout.levels, layout.side):
        surface.fill(theme.PANEL, column)
    space.panels.controls.draw(surface, space.session)
    space.panels.manager.draw_ui(surface)
    if space.panels.side is not None:
        space.panels.side.draw_over(surface)
    space.panels.focus.draw(surface, space.panels.manager, layout)
    for x in (layout.stage.left, layout.stage.right - 1):
        surface.fill(theme.EDGE, (x, 0, 1, layout.stage.height))
    if space.help:
        rows = page(space.panels.page).own_keys() if space.stage_tool is not None else ()
        messages = rows or stage_messages.window_keys_and_mouse()
        space.sheets = stage_messages.draw_help(
            surface, space.pen, layout.stage, messages, space.help
        )


def _paint_stage(space: OpenLevelAndPanels, view: pygame.Surface, session: Session) -> None:
    """Draw the run, or a page's own picture in its place, with measurements and messages."""
    maker = space.stage_tool
    space.stage.camera.offset = 0.0, 0.0  # what a page draws is seen from the ground
    if maker is None or not maker.draw(view, space.stage, space.pen, session):
        _paint_run(space, view, session)
        if maker is not None:
            maker.draw_over(view, space.stage, space.pen)
    if space.hand.tape is not None:
        space.hand.tape.draw(view, space.stage.camera, space.pen)
    if (stopwatch := space.workers.made(Stopwatch)) is not None:
        stopwatch.draw(view, space.pen, session)
    below = space.banner.draw(view, space.pen, view.get_rect(), session)
    labels = [run.label(session.values) for run in session.earlier]
    runs = runs_beside(session)[1] or run_legend.earlier(labels)
    run_legend.draw(view, space.pen, runs, below, space.stage.view)


def _paint_run(space: OpenLevelAndPanels, view: pygame.Surface, session: Session) -> None:
    stage = space.stage
    recalled = session.recalled
    if stage.seen_from != session.looking.seen_from:
        stage.observe(session.looking.seen_from)
    stage.view.looking = None if recalled else session.looking
    stage.view.flashes = () if space.comfort.chosen.reduced else session.flashes
    stage.asked = page(space.panels.page).overlay if space.panels.side is not None else ""
    earlier = [run.trail for run in session.earlier if have_same_bodies(run.world, session.shown)]
    trail = recalled.trail if recalled else session.trail
    stage.draw(view, trail, session.milestones(), session.companions, earlier)
    x, y = pygame.mouse.get_pos()
    left, top = space.panels.layout.stage.topleft
    if not space.hand.pulling:  # a text would cover the body in the hand
        trail_probe.draw(view, stage.view, session, (x - left, y - top))
