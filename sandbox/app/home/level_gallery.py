"""The home page, which shows all levels as cards in place of the stage."""

from collections.abc import Sequence
from functools import cache, lru_cache
from pathlib import Path

import pygame

from sandbox.app.drawing import lines, theme
from sandbox.app.drawing.text import Pen
from sandbox.app.files.challenge_stars import ChallengeStars
from sandbox.app.files.level_list_entries import Entry
from sandbox.app.home.card_grid import HEADING, MARGIN, CardGrid, lay_out, sections
from sandbox.app.home.chapter_bar import ChapterBar
from sandbox.app.home.playing_preview import PlayingPreview
from sandbox.app.home.thumbnails import Thumbnails
from sandbox.app.home.unfinished_work_strip import UnfinishedWorkStrip, Unsaved
from sandbox.app.words.language import say
from sandbox.model import level_catalog

WHEEL = 90.0  # px, per notch
BAR = 5  # px, the width of the scroll bar
STARS = 3  # the most stars of a challenge
RADIUS = 6  # px, of a star
PADDING = 9  # px, beside a card's text
ROWS = 4, 23  # px, from the picture to the lines of text

Line = tuple[str, int, theme.Color]
"""A text, its font size, and its colour."""

_STEPS = {
    pygame.K_LEFT: (-1, 0), pygame.K_RIGHT: (1, 0), pygame.K_UP: (0, -1), pygame.K_DOWN: (0, 1),
}  # fmt: skip


class LevelGallery:
    """Cards of levels, which can be chosen by mouse and keyboard."""

    def __init__(self, pen: Pen) -> None:
        self._pen = pen
        self.open = False
        """Whether the page is shown."""
        self.chosen: Path | None = None
        """The level that was chosen last, until the window takes it."""
        self.recovered: Unsaved | None = None
        """The draft or run that was chosen last, until the window takes it."""
        self.strip = UnfinishedWorkStrip(pen)
        """The drafts and runs above the cards."""
        self.preview = PlayingPreview()
        """The level that plays on its card."""
        self.chapters = ChapterBar(pen)
        """The bar of chapters above the cards."""
        self.thumbnails = Thumbnails()
        """The pictures on the cards."""
        self._progress = ChallengeStars()
        self._area = pygame.Rect(0, 0, 1, 1)
        self._laid_out: object = None
        self._grid = lay_out(1, ())
        self._top = 0.0  # px, the height on the sheet at the area's upper edge
        self._focus = 0
        self._hovered: int | None = None
        self._pressed: int | None = None
        self._held: Unsaved | None = None  # the row on which the mouse was pressed
        self._here: Path | None = None  # the open level
        self._words = lru_cache(maxsize=600)(self._lines)

    def enter(self, path: Path | None) -> None:
        """Show the page, with up-to-date cards, scrolled to a level."""
        self.open, self._progress = True, ChallengeStars()
        self.thumbnails.forget()
        self._laid_out, self._here = None, path
        self.strip.refresh()

    def renew(self) -> None:
        """Lay out and draw everything again, in the current theme, scale and language."""
        self._words.cache_clear()
        self.thumbnails.cancel()
        self.thumbnails.forget()
        self.preview.stop()
        self._laid_out = None

    def leave(self) -> None:
        """Hide the page."""
        self.open = False
        self.preview.stop()
        self.thumbnails.cancel()

    @property
    def grid(self) -> CardGrid:
        """The layout of the cards on their sheet."""
        return self._grid

    @property
    def focus(self) -> Entry | None:
        """The level that Enter opens; None if there is none."""
        return self._grid.cards[self._focus][0] if self._grid.cards else None

    def card_rect(self, index: int) -> pygame.Rect:
        """Return the rectangle of a card in the window, which may be out of view [px]."""
        return self._grid.cards[index][1].move(self._area.x, self._area.y - round(self._top))

    def update(self, area: pygame.Rect, found: Sequence[Entry], search: str) -> None:
        """Lay out the levels that a search found in an area [px], and take in finished pictures."""
        area = self.strip.take_room(area)
        wanted = tuple(area), tuple(found), search.strip()
        if wanted != self._laid_out:
            self._lay_out(area, found, search, again=self._laid_out is not None)
            self._laid_out = wanted
        seen = [level.path for level, _ in self._seen()]
        self.thumbnails.follow(seen, [level.path for level, _ in self._grid.cards])

    def play(self, seconds: float) -> None:
        """Advance the preview of the level under the mouse by some time [s]."""
        over = None if self._hovered is None else self._grid.cards[self._hovered][0].path
        self.preview.follow(over, seconds)

    def _lay_out(
        self, area: pygame.Rect, found: Sequence[Entry], search: str, *, again: bool
    ) -> None:
        path = self.focus.path if again and self.focus is not None else self._here
        self._grid = lay_out(area.width, sections(found, search), self._pen.scale)
        self._area = self.chapters.take_room(area, self._grid.headings)
        self.thumbnails.resize(self._grid.picture)
        places = {level.path: i for i, (level, _) in enumerate(self._grid.cards)}
        self._focus = places.get(path, 0) if path is not None and not search.strip() else 0
        self._hovered = None
        self._top = self._chapter_of_focus()
        self._show_focus()

    def _chapter_of_focus(self) -> float:
        """Return the height on the sheet of the heading above the focused card [px]."""
        if not self._grid.cards:
            return 0.0
        y = self._grid.cards[self._focus][1].y
        return float(max(heading.y for heading in self._grid.headings if heading.y < y))

    def _show_focus(self) -> None:
        """Scroll until the focused card and the heading above it are in view."""
        if self._grid.cards:
            place = self._grid.cards[self._focus][1]
            highest = place.bottom + self._pen.px(MARGIN) - self._area.height
            self._scroll_to(min(max(self._top, highest), place.y - self._pen.px(HEADING)))

    def _scroll_to(self, top: float) -> None:
        self._top = min(max(top, 0.0), max(self._grid.height - self._area.height, 0.0))

    def _seen(self) -> list[tuple[Entry, pygame.Rect]]:
        """Return the levels whose cards are in view, with their rectangles in the window [px]."""
        placed = ((entry, self.card_rect(i)) for i, (entry, _) in enumerate(self._grid.cards))
        return [(entry, place) for entry, place in placed if place.colliderect(self._area)]

    def process(self, event: pygame.event.Event) -> bool:
        """Handle an event, and return whether it was meant for this page."""
        if event.type == pygame.KEYDOWN:
            return self._key(event)
        if event.type == pygame.MOUSEWHEEL:
            inside = self._area.collidepoint(pygame.mouse.get_pos())
            if inside:
                self._scroll_to(self._top - WHEEL * event.precise_y)
                self._point(pygame.mouse.get_pos())
            return inside
        if event.type not in (pygame.MOUSEMOTION, pygame.MOUSEBUTTONDOWN, pygame.MOUSEBUTTONUP):
            return False
        inside = self._point(event.pos)
        beside = self.strip.follow(event.pos) or self.chapters.follow(event.pos)
        if event.type == pygame.MOUSEMOTION:
            return False
        if event.button == 1:
            self._click(down=event.type == pygame.MOUSEBUTTONDOWN)
        return inside or beside

    def _point(self, pixel: tuple[int, int]) -> bool:
        """Update the hovered card, and return whether the mouse is over the cards."""
        inside = self._area.collidepoint(pixel)
        on = (pixel[0] - self._area.x, pixel[1] - self._area.y + self._top)
        self._hovered = self._grid.at(on) if inside else None
        return inside

    def _click(self, *, down: bool) -> None:
        """Choose the card on which the mouse was pressed and released."""
        if down:
            self._pressed, self._held = self._hovered, self.strip.hovered
            self._focus = self._focus if self._hovered is None else self._hovered
            if self.chapters.hovered is not None:
                self.show_chapter(self.chapters.hovered.text)
        elif self._hovered is not None and self._hovered == self._pressed:
            self.chosen = self._grid.cards[self._hovered][0].path
        elif self.strip.hovered is not None and self.strip.hovered is self._held:
            self.recovered = self.strip.hovered

    def show_chapter(self, text: str) -> None:
        """Scroll to the cards of a chapter, and focus its first card."""
        heading = next((each for each in self._grid.headings if each.text == text), None)
        if heading is not None:
            below = (i for i, (_, place) in enumerate(self._grid.cards) if place.y > heading.y)
            self._focus = next(below)
            self._scroll_to(heading.y)

    def _key(self, event: pygame.event.Event) -> bool:
        focus, page = self.focus, self._area.height * 0.8
        if event.mod & (pygame.KMOD_CTRL | pygame.KMOD_ALT | pygame.KMOD_META) or focus is None:
            return False
        if event.key in (pygame.K_RETURN, pygame.K_KP_ENTER, pygame.K_SPACE):
            self.chosen = focus.path
        elif event.key in _STEPS:
            self._focus_on(self._grid.beside(self._focus, *_STEPS[event.key]))
        elif event.key in (pygame.K_HOME, pygame.K_END):
            self._focus_on(0 if event.key == pygame.K_HOME else len(self._grid.cards) - 1)
        elif event.key in (pygame.K_PAGEDOWN, pygame.K_PAGEUP):
            self._scroll_to(self._top + (page if event.key == pygame.K_PAGEDOWN else -page))
        else:
            return False
        return True

    def _focus_on(self, index: int) -> None:
        self._focus = index
        self._show_focus()

    def draw(self, surface: pygame.Surface) -> None:
        """Draw the visible part, with the pictures that are ready."""
        self.strip.draw(surface)
        self.chapters.draw(surface, self._top)
        area = self._area.clip(surface.get_rect())
        if area.width == 0 or area.height == 0:
            return
        surface.set_clip(area)
        surface.fill(theme.STAGE, area)
        for heading in self._grid.headings:
            y = self._area.y + heading.y - round(self._top)
            if area.top - self._pen.px(HEADING) < y < area.bottom:
                self._draw_heading(surface, heading.text, heading.count, y)
        for i in range(len(self._grid.cards)):
            if self.card_rect(i).colliderect(area):
                self._draw_card(surface, i)
        self._draw_bar(surface)
        surface.set_clip(None)

    def _draw_heading(self, surface: pygame.Surface, text: str, count: int, y: int) -> None:
        title = self._pen.write(text, 17, theme.ACCENT, True)
        x = self._area.x + self._pen.px(MARGIN)
        surface.blit(title, (x, y + self._pen.px(12)))
        if count:
            count_text = self._pen.write(str(count), 13, theme.DIM)
            surface.blit(count_text, (x + title.width + 10, y + self._pen.px(16)))

    def _draw_card(self, surface: pygame.Surface, index: int) -> None:
        level, place = self._grid.cards[index][0], self.card_rect(index)
        lit = index == self._hovered
        pygame.draw.rect(surface, theme.RAISED if lit else theme.PANEL, place, border_radius=6)
        top = pygame.Rect(place.topleft, self._grid.picture)
        drawn = self.preview.picture(level.path, top.size) if lit else None
        drawn = drawn or self.thumbnails.of(level.path)
        if drawn is not None:
            surface.blit(drawn, top)
        else:
            surface.fill(theme.GRID, top)
            hopeless = self.thumbnails.hopeless(level.path)
            text = self._pen.write(say("no picture") if hopeless else "…", 13, theme.DIM)
            surface.blit(text, text.get_rect(center=top.center))
        self._draw_words(surface, level, pygame.Rect(top.x, top.bottom, place.width, 0))
        focused = index == self._focus
        rim = theme.ACCENT if focused else theme.AXIS if lit else theme.EDGE
        pygame.draw.rect(surface, rim, place, 2 if focused else 1, border_radius=6)

    def _draw_words(self, surface: pygame.Surface, level: Entry, below: pygame.Rect) -> None:
        earned = self._progress.stars(level.original.title)
        right = below.right - self._pen.px(PADDING)
        if earned or level.chapter == level_catalog.CHALLENGES:
            for i in reversed(range(STARS)):
                right -= 2 * self._pen.px(RADIUS) + 2
                color = theme.NOTICE if i < earned else theme.EDGE
                surface.blit(_star(color, self._pen.px(RADIUS)), (right, below.y + self._pen.px(8)))
            right -= self._pen.px(PADDING) // 2
        x, pen = below.x + self._pen.px(PADDING), self._pen
        rows = self._words(level, right - x, below.width - 2 * pen.px(PADDING))
        for (text, size, color), y in zip(rows, ROWS, strict=True):
            surface.blit(pen.write(text, size, color), (x, below.y + pen.px(y)))

    def _lines(self, level: Entry, room: int, whole: int) -> tuple[Line, Line]:
        """Return the two lines of a card: title and summary, or a long title on both.

        The first line may be as wide as `room`, the second as wide as `whole` [px].
        """
        pen, title = self._pen, level.title[:200]
        if pen.shorten(title, room, 14) == title:
            message = pen.shorten(level.summary[:200], max(whole, 1), 12)
            return (title, 14, theme.TEXT), (message, 12, theme.DIM)
        first, *others = pen.wrap(title, max(room, 1), 13)
        rest = pen.shorten(" ".join(others), max(whole, 1), 13)
        return (first, 13, theme.TEXT), (rest, 13, theme.TEXT)

    def _draw_bar(self, surface: pygame.Surface) -> None:
        area, height = self._area, self._grid.height
        if height > area.height:
            length = max(round(area.height * area.height / height), 24)
            y = area.y + round((area.height - length) * self._top / (height - area.height))
            bar = pygame.Rect(area.right - BAR - 4, y, BAR, length)
            pygame.draw.rect(surface, theme.AXIS, bar, border_radius=2)


@cache
def _star(color: theme.Color, radius: int) -> pygame.Surface:
    """Draw a five-pointed star, one point up; it is scaled down to smooth its edges."""
    large = 4 * radius
    drawn = pygame.Surface((2 * large, 2 * large), pygame.SRCALPHA)
    drawn.fill((*color, 0))
    pygame.draw.polygon(drawn, color, lines.star((large, large), large))
    return pygame.transform.smoothscale_by(drawn, 0.25)
