"""The strip above the cards: unsaved drafts and runs that can be continued."""

from time import localtime, strftime

import pygame

from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen, legible
from sandbox.app.runs.crash_recovery import LeftRun, left_runs
from sandbox.app.words.language import later, say
from sandbox.editing.draft_recovery import Recoverable, recoverable
from sandbox.editing.edits.automatic_title import is_untitled

Unsaved = Recoverable | LeftRun

MOST = 3
"""The largest number of rows, the newest; the page Build lists the other drafts."""
ROW = 34  # px, the height of a row
MARGIN = 24  # px, left and right of a row
GAP = 6  # px, above and below a row
PADDING = 12  # px, beside the text


class UnfinishedWorkStrip:
    """Rows of drafts and runs that can be clicked."""

    def __init__(self, pen: Pen) -> None:
        self._pen = pen
        self._rows: list[Unsaved] = []
        self._area = pygame.Rect(0, 0, 0, 0)
        self.hovered: Unsaved | None = None
        """The draft or run under the mouse, or None."""

    def refresh(self) -> None:
        """Look for what windows that have ended left behind."""
        self._rows, self.hovered = unsaved(), None

    def take_room(self, area: pygame.Rect) -> pygame.Rect:
        """Take the top of an area, and return the rest."""
        height = len(self._rows) * self._pen.px(ROW + GAP) + bool(self._rows) * self._pen.px(GAP)
        self._area = pygame.Rect(area.topleft, (area.width, min(height, area.height)))
        rest = area.height - self._area.height
        return pygame.Rect(area.x, self._area.bottom, area.width, rest)

    def rect_of(self, index: int) -> pygame.Rect:
        """Return the rectangle of a row in the window [px]."""
        px, (x, y) = self._pen.px, self._area.topleft
        top = y + px(GAP) + index * px(ROW + GAP)
        return pygame.Rect(x + px(MARGIN), top, self._area.width - 2 * px(MARGIN), px(ROW))

    def follow(self, pixel: tuple[int, int]) -> bool:
        """Update the hovered row, and return whether the mouse is over the strip."""
        places = {i: self.rect_of(i).collidepoint(pixel) for i in range(len(self._rows))}
        self.hovered = next((self._rows[i] for i, over in places.items() if over), None)
        return self._area.collidepoint(pixel)

    def draw(self, surface: pygame.Surface) -> None:
        """Draw the rows."""
        surface.fill(theme.STAGE, self._area.clip(surface.get_rect()))
        for i, left in enumerate(self._rows):
            place, pad = self.rect_of(i), self._pen.px(PADDING)
            lit = left is self.hovered
            pygame.draw.rect(surface, theme.RAISED if lit else theme.PANEL, place, border_radius=6)
            pygame.draw.rect(surface, theme.NOTICE, place, 1, border_radius=6)
            text = self._pen.shorten(summary(left), place.width - 2 * pad, 14)
            image = self._pen.write(text, 14, theme.TEXT)
            surface.blit(image, image.get_rect(midleft=(place.x + pad, place.centery)))


def unsaved() -> list[Unsaved]:
    """Return what windows that have ended left behind, the newest first."""
    found: list[Unsaved] = [*recoverable(), *left_runs(MOST)]
    return sorted(found, key=lambda one: -one.when)[:MOST]


def notice(left: Unsaved) -> str:
    """Return the text that tells of a draft or a run where the strip is not shown."""
    message = later("Not saved when a window ended: {name}, {when}. F2 offers to go on with it.")
    return say(message, name=_name(left), when=_when(left))


def _name(left: Unsaved) -> str:
    if is_untitled({"title": left.title}):
        return say("a level without a name")
    return legible(left.title) or say("a level without a name")


def _when(left: Unsaved) -> str:
    return strftime("%Y-%m-%d %H:%M", localtime(left.when))


def summary(left: Unsaved) -> str:
    """Return the text that describes a draft or a run."""
    name, when = _name(left), _when(left)
    if isinstance(left, LeftRun):
        message = later("Not saved: the run of {name}, {when}. Click to go on with it.")
        return say(message, name=name, when=when)
    name = left.path.name if left.path else name
    return say(
        "Not saved: {name}, drawn {when}. Click to go on with it (or B).", name=name, when=when
    )
