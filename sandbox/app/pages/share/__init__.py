"""The page that saves pictures, films, tables, runs and levels."""

from sandbox.app.pages.page import Page, imported

PAGE = Page(
    name="share",
    caption="Share",
    key="w",
    text="save: picture, film, table, run, level",
    panel=imported("sandbox.app.pages.share.panel", "SharePage"),
    worker=imported("sandbox.app.pages.share.background_film", "FilmWorker"),
)
