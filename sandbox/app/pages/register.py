"""The pages of the side panel: one list, from which tabs, keys, help and commands are derived."""

from collections.abc import Sequence

from sandbox.app.pages import accuracy, effects, level, race
from sandbox.app.pages.page import Page, Row
from sandbox.app.session import Session

PAGES: tuple[Page, ...] = (level.PAGE, effects.PAGE, race.PAGE, accuracy.PAGE)
"""In the order of their tabs; the first is shown first."""


def page(command: str) -> Page:
    """Return the page that a command opens."""
    return next(page for page in PAGES if page.command == command)


def runs_beside(session: Session) -> tuple[Page | None, Sequence[Row]]:
    """Return which page lets other runs go over the one that is played, and their rows."""
    found = ((page, rows) for page in PAGES if (rows := page.runs(session)))
    return next(found, (None, ()))
