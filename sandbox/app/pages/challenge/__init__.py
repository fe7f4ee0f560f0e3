"""The page of a level's challenge."""

from sandbox.app.pages.challenge.card import challenge
from sandbox.app.pages.challenge.judge import Judge
from sandbox.app.pages.challenge.panel import ChallengePage
from sandbox.app.pages.page import Page

PAGE = Page(
    name="challenge",
    caption="Challenge",
    key="k",
    text="the challenge: its goals, its stars, hints",
    card=challenge,
    panel=ChallengePage,
    worker=Judge,
    suits=lambda level: level.challenge is not None,
)
