"""What is told in words and numbers about a run; a file a page."""

from sandbox.app.cards.card import Card, heading, label
from sandbox.app.cards.checks import checks, unjudged
from sandbox.app.cards.effects import compared, effects_intro, unchanged
from sandbox.app.cards.energy import energy, ledger
from sandbox.app.cards.level import clock, header, settings
from sandbox.app.cards.race import lanes, race_intro

__all__ = [
    "Card",
    "checks",
    "clock",
    "compared",
    "effects_intro",
    "energy",
    "header",
    "heading",
    "label",
    "lanes",
    "ledger",
    "race_intro",
    "settings",
    "unchanged",
    "unjudged",
]
