"""The level's own page."""

from sandbox.app.pages.level.panel import LevelPage
from sandbox.app.pages.page import Page

PAGE = Page(
    name="level",
    caption="Level",
    key="o",
    text="the level: parameters and checks",
    panel=LevelPage,
)
