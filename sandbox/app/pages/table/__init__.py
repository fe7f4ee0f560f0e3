"""The page of values as a table."""

from sandbox.app.pages.page import Page
from sandbox.app.pages.table.panel import TablePage
from sandbox.app.pages.table.stopwatch import Stopwatch

PAGE = Page(
    name="table",
    caption="Table",
    key="1",
    text="table of what is graphed, by time; stopwatch",
    panel=TablePage,
    worker=Stopwatch,
)
