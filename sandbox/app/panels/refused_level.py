"""The page of a level that cannot be opened: each mistake at its place in the text."""

from pathlib import Path

import pygame
from pygame_gui import UIManager

from sandbox.app.cards import mistakes
from sandbox.app.cards.text_column import TextColumn
from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.widgets.scrolling_area import Sheet, below
from sandbox.app.widgets.widget_states_and_scrolling import scroll_position, scroll_to
from sandbox.app.words.language import plural, say
from sandbox.model.errors import LevelError, SandboxError
from sandbox.model.loading import read

TOP = 12  # px
GAP = 10  # px, between two excerpts
FOOT = 64  # px, the room for an offer
WIDEST = 1000  # px, since longer lines are hard to read


def in_brief(path: Path, error: SandboxError) -> str:
    """Say in a line why a file cannot be opened."""
    if not isinstance(error, LevelError):  # which names the file
        return say(error.message)
    reason = error.mistakes[0].rule
    return say("{file} cannot be opened: {reason}", file=path.name, reason=reason)


class RefusedLevel:
    """A page in place of the stage, which scrolls if necessary."""

    def __init__(
        self, manager: UIManager, pen: Pen, stage: pygame.Rect, error: SandboxError
    ) -> None:
        self.text = say(error.message)
        """The full message, as on the command line."""
        area = pygame.Rect(0, stage.y + TOP, min(stage.width, pen.px(WIDEST)), 0)
        area.height = max(stage.height - TOP - pen.px(FOOT), 1)
        area.centerx = stage.centerx
        sheet = self._sheet = Sheet(manager, pen, area)
        found = error.mistakes if isinstance(error, LevelError) else ()
        lines = _lines(found[0].source) if found else []
        y = below(sheet.image(_head(pen, sheet.width, error, mendable=bool(lines)), 0))
        for group in mistakes.groups(found):
            drawn = mistakes.excerpt(pen, sheet.width, lines, group)
            y = below(sheet.image(drawn, y + GAP))
        sheet.set_content_height(y + GAP)

    def scroll_pages(self, pages: float) -> None:
        """Scroll by a multiple of the visible height."""
        container = self._sheet.container
        scroll_to(container, scroll_position(container) + pages * container.rect.height)


def _head(pen: Pen, width: int, error: SandboxError, *, mendable: bool) -> pygame.Surface:
    card = TextColumn(pen, width)
    card.text(say("This level cannot be opened"), 20, theme.FAILED, bold=True)
    card.y += 4
    way_out = say("Choose another level.")
    if isinstance(error, LevelError):
        card.text(error.mistakes[0].source, 13, theme.DIM)
        count = len(error.mistakes)
        if mendable:
            way_out = plural(
                "{count} mistake: correct the file; this page is updated until the level opens.",
                "{count} mistakes: correct the file; this page is updated until the level opens.",
                count,
            )
    else:
        card.text(say(error.message))
    card.text(way_out, 13, theme.DIM)
    return card.drawn(theme.STAGE)


def _lines(source: str) -> list[str]:
    """Return the lines of a file; none if it cannot be read."""
    try:
        return read(Path(source)).split("\n")
    except (SandboxError, ValueError):
        return []
