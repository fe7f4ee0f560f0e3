"""The page that saves pictures, films, tables, runs and levels."""

from sandbox.app.pages.page import Page
from sandbox.app.pages.share.background_film import Filming
from sandbox.app.pages.share.panel import SharePage

PAGE = Page(
    name="share",
    caption="Share",
    key="w",
    text="save: picture, film, table, run, level",
    panel=SharePage,
    worker=Filming,
)
