"""The page of values as a table."""

from sandbox.app.pages.page import Page, imported

PAGE = Page(
    name="table",
    caption="Table",
    key="1",
    text="table of what is graphed, by time; stopwatch",
    panel=imported("sandbox.app.pages.table.panel", "TablePage"),
    worker=imported("sandbox.app.pages.table.stopwatch", "Stopwatch"),
)
