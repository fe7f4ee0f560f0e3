"""The page of the forces on a body."""

from sandbox.app.pages.forces.component_axes import Axes
from sandbox.app.pages.forces.panel import ForcesPage
from sandbox.app.pages.page import Page

PAGE = Page(
    name="forces",
    caption="Forces",
    key="j",
    text="all forces on a body, and their sum",
    panel=ForcesPage,
    worker=Axes,
    overlay="forces",
)
