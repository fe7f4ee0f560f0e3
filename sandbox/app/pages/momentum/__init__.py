"""The page of the momentum."""

from sandbox.app.pages.page import Page, imported

PAGE = Page(
    name="momentum",
    caption="Momentum",
    key="m",
    text="momentum of each body and of all together",
    card=imported("sandbox.app.pages.momentum.card", "momentum"),
    books=True,
)
