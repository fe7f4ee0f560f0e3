"""The page of the level itself."""

from sandbox.app.pages.level.panel import LevelPage, switch
from sandbox.app.pages.page import Page, PageCommand

PAGE = Page(
    name="level",
    caption="Level",
    key="o",
    text="the level: parameters and checks",
    panel=LevelPage,
    commands=(PageCommand("branch", "O", "parameters act from the start, or from now on", switch),),
)
