"""The page of the forces on a body."""

from sandbox.app.pages.page import Page, imported

PAGE = Page(
    name="forces",
    caption="Forces",
    key="j",
    text="all forces on a body, and their sum",
    panel=imported("sandbox.app.pages.forces.panel", "ForcesPage"),
    worker=imported("sandbox.app.pages.forces.component_axes", "Axes"),
    overlay="forces",
)
