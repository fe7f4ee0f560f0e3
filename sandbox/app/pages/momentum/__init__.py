"""The page of the momentum."""

from sandbox.app.pages.momentum.card import momentum
from sandbox.app.pages.page import Page

PAGE = Page(
    name="momentum",
    caption="Momentum",
    key="m",
    text="momentum of each body and of all together",
    card=momentum,
    books=True,
)
