"""The page of graphs."""

from sandbox.app.pages.page import Page, imported

PAGE = Page(
    name="graph",
    caption="Graph",
    key="d",
    text="graphs of any quantity against any other",
    shows_recorded_states=True,
    panel=imported("sandbox.app.pages.graph.panel", "GraphPage"),
    worker=imported("sandbox.app.pages.graph.chosen_quantities", "Choice"),
)
