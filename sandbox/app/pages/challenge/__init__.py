"""The page of a level's challenge."""

from sandbox.app.pages.page import Page, imported

PAGE = Page(
    name="challenge",
    caption="Challenge",
    key="k",
    text="the challenge: its goals, its stars, hints",
    card=imported("sandbox.app.pages.challenge.card", "challenge"),
    panel=imported("sandbox.app.pages.challenge.panel", "ChallengePage"),
    worker=imported("sandbox.app.pages.challenge.judge", "Judge"),
    suits_level=lambda level: level.challenge is not None,
)
