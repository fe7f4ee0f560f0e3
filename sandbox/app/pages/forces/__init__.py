"""The page of the forces on a body."""

from sandbox.app.pages.page import Desk, Page, PageCommand, imported


def _next_body(desk: Desk) -> None:
    desk.session.looking.select_next(desk.session.level)


PAGE = Page(
    name="forces",
    caption="Forces",
    key="j",
    text="all forces on a body, and their sum",
    panel=imported("sandbox.app.pages.forces.panel", "ForcesPage"),
    worker=imported("sandbox.app.pages.forces.component_axes", "Axes"),
    overlay="forces",
    commands=(PageCommand("next body", "9", "select the next body", _next_body),),
)
