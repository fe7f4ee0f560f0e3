"""The page of graphs."""

from sandbox.app.pages.graph.chosen_quantities import Choice
from sandbox.app.pages.graph.panel import GraphPage
from sandbox.app.pages.page import Page

PAGE = Page(
    name="graph",
    caption="Graph",
    key="d",
    text="graphs of any quantity against any other",
    recalls=True,
    panel=GraphPage,
    worker=Choice,
)
