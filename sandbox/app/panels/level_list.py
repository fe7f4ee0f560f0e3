"""The list of levels, by chapter, with a search field."""

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

import pygame
from pygame_gui import (
    UI_BUTTON_PRESSED,
    UI_TEXT_ENTRY_CHANGED,
    UI_TEXT_ENTRY_FINISHED,
    UIManager,
)
from pygame_gui.core import ObjectID, UIContainer, UIElement
from pygame_gui.elements import UIButton, UIImage, UIScrollingContainer

from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.files.challenge_stars import ChallengeStars
from sandbox.app.files.level_list_entries import Entry, entry
from sandbox.app.keymap import tip
from sandbox.app.widgets.text_field import LONGEST, TextField
from sandbox.app.widgets.widget_states_and_scrolling import (
    Row,
    scroll_position,
    scroll_to,
    show_pressed,
)
from sandbox.app.words.language import plural, say
from sandbox.model import level_catalog
from sandbox.model.atomic_file_writing import without_links

ROW = 28  # px
HEADING = 34  # px
MARGIN = 8  # px
FIELD = 28  # px
SCROLL_BAR = 22  # px
CAPTION = 14
"""The letter size of the buttons."""
STAR = "•"
"""Added to a title for each star that its challenge has earned."""


def entries() -> list[Entry]:
    """Return the levels of the catalogue."""
    found, folder = [], level_catalog.root()
    for name in level_catalog.names():
        path = without_links(folder / f"{name}.json")
        if path.is_file():  # it may be gone since it was listed
            found.append(entry(path, name.partition("/")[0]))
    return found


def rank(entry: Entry, words: Sequence[str]) -> tuple[int, int]:
    """Return the sort key of a level that contains all of some words; the least comes first.

    A match in the title precedes one in the summary, the whole phrase precedes single words, and a
    shorter title a longer one. Both the translated and the original title count.
    """
    titles = {entry.title.casefold(), entry.original.title.casefold()}
    return min(_rank(title, entry.words, words) for title in titles)


def _rank(title: str, text: str, words: Sequence[str]) -> tuple[int, int]:
    """Return the sort key for one title of a level, and the text by which it is found."""
    phrase = " ".join(words)
    if phrase in title:
        return 0, len(title)
    if all(word in title for word in words):
        return 1, len(title)
    return (2 if phrase in text else 3), 0


class LevelList:
    """A column of buttons, one for each level, below a search field.

    A button is made when its row becomes visible, and removed when the row is far away, since
    making all takes a tenth of a second and about 25 MB.
    """

    def __init__(
        self,
        manager: UIManager,
        pen: Pen,
        rect: pygame.Rect,
        levels: Sequence[Entry],
        search: str = "",
    ) -> None:
        self._pen, self._px = pen, pen.px
        px = self._px
        width = rect.width - 2 * px(MARGIN)
        self.column = UIContainer(rect, manager)
        """The container of all widgets."""
        self._commands = dict(self._make_links(manager, pen, width))
        self.field = TextField(
            pygame.Rect(px(MARGIN), 2 * px(MARGIN) + px(FIELD), width, px(FIELD)), manager,
            container=self.column,
            initial_text=search, placeholder_text=say("Find a level ( / )"),
        )  # fmt: skip
        """The search field."""
        self.field.set_forbidden_characters(["/"])  # the key that leads here
        self.field.set_text_length_limit(LONGEST)
        top = 2 * self._px(FIELD) + 3 * self._px(MARGIN)
        below = pygame.Rect(0, top, rect.width, max(rect.height - top, 1))
        self._container = UIScrollingContainer(
            below, manager, container=self.column, allow_scroll_x=False
        )
        self._width = width - self._px(SCROLL_BAR)
        self._none = self._image(manager, pen, say("No level matches."), theme.DIM, bold=False)
        self._headings: dict[str, UIImage] = {}
        self._levels = tuple(levels)
        self._tops: dict[Entry, int] = {}  # px, the heights of the rows found
        self.rows: dict[Entry, Row] = {}
        """The buttons made so far."""
        self._seen: float | None = None  # px, the scroll position when rows were last made
        self._chosen: Path | None = None
        self._progress = ChallengeStars()
        for chapter in dict.fromkeys(level.chapter for level in levels):
            title = say(chapter.capitalize())
            self._headings[chapter] = self._image(manager, pen, title, theme.ACCENT, bold=True)
        self._show()

    def _make_links(
        self, manager: UIManager, pen: Pen, width: int
    ) -> Iterator[tuple[UIButton, str]]:
        """Make the buttons that lead to other levels, and yield them with their commands.

        They share the room that their captions leave.
        """
        buttons = {"home": say("Home"), "new scene": say("New"), "open file": say("Open …")}
        needed = {command: pen.write(text, CAPTION).width for command, text in buttons.items()}
        gap = x = self._px(MARGIN)
        spare = (width - (len(buttons) - 1) * gap - sum(needed.values())) // len(buttons)
        for command, text in buttons.items():
            place = pygame.Rect(x, gap, needed[command] + spare, self._px(FIELD))
            x = place.right + gap
            yield (
                UIButton(place, text, manager, container=self.column, tool_tip_text=tip(command)),
                command,
            )

    def pressed(self, event: pygame.event.Event) -> str | None:
        """Return the command whose button was pressed, if one was."""
        return self._commands.get(event.ui_element) if event.type == UI_BUTTON_PRESSED else None

    def link_button(self, command: str) -> UIButton:
        """Return the button of a command."""
        return next(button for button, own in self._commands.items() if own == command)

    def _image(
        self, manager: UIManager, pen: Pen, text: str, color: theme.Color, *, bold: bool
    ) -> UIImage:
        image = pygame.Surface((self._width, self._px(HEADING)))
        image.fill(theme.PANEL)
        image.blit(pen.write(text, 13, color, bold), (self._px(10), self._px(12)))
        return UIImage(
            image.get_rect(x=self._px(MARGIN)), image, manager, container=self._container
        )

    def update(self, focused: UIElement | None = None) -> None:
        """Make the rows that have become visible, and remove distant ones except `focused`."""
        top, height = scroll_position(self._container), self._container.rect.height
        if top == self._seen:
            return
        self._seen = top
        self._make(self._between(top - self._px(ROW), top + height))
        near = set(self._between(top - height, top + 2 * height))
        for level in self.rows.keys() - near:
            if self.rows[level] is not focused and not self.rows[level].hovered:
                self.rows.pop(level).kill()  # type: ignore[no-untyped-call]

    def make_reachable_rows(self, element: UIElement | None) -> None:
        """Make the rows that Tab may reach from a widget: its neighbours, the first, the last."""
        listed = list(self._tops)
        at = next((listed.index(level) for level, row in self.rows.items() if row is element), 0)
        self._make(listed[max(at - 1, 0) : at + 2] + listed[:1] + listed[-1:])

    def complete(self) -> None:
        """Make all rows of the search result; the next scrolling removes distant ones."""
        self._make(self._tops)

    def _between(self, above: float, below: float) -> list[Entry]:
        """Return the levels whose rows begin between two heights [px]."""
        return [level for level, y in self._tops.items() if above < y < below]

    def _make(self, levels: Iterable[Entry]) -> None:
        """Make the missing rows of some levels."""
        for level in levels:
            if level not in self.rows:
                self.rows[level] = self._row(level)

    def _row(self, level: Entry) -> Row:
        """Return a new button at its place."""
        caption, tip = self._caption(level)
        place = self._px(MARGIN), self._tops[level], self._width, self._px(ROW)
        row = Row(
            pygame.Rect(place), caption, self._container.ui_manager, tool_tip_text=tip,
            container=self._container, object_id=ObjectID(class_id="@level"),
        )  # fmt: skip
        show_pressed(row, level.path == self._chosen)
        return row

    def _caption(self, level: Entry) -> tuple[str, str | None]:
        """Return the caption of a level's button, and its tooltip."""
        stars = self._progress.stars(level.original.title)
        mark = f"   {stars * STAR}" if stars else ""
        room = self._width - self._px(18) - self._pen.write(mark, 13).width
        shown = self._pen.shorten(level.title, room, 13)
        earned = plural("{count} star earned", "{count} stars earned", stars) if stars else None
        return shown + mark, earned if shown == level.title else level.title

    def mark_stars(self) -> None:
        """Show the stars earned so far in the rows."""
        self._progress = ChallengeStars()
        for level, row in self.rows.items():
            caption, row.tool_tip_text = self._caption(level)
            row.set_text(caption)

    def _show(self) -> None:
        """Place the rows of the search result, and hide others; headings only without a search."""
        found, self._tops, self._seen, y = self.matching_levels, {}, None, 0
        tops: dict[str, int] = {}  # px, the heights of the headings
        for level in found:
            if level.chapter not in tops and not self.search_text.strip():
                tops[level.chapter] = y
                y += self._px(HEADING)
            self._tops[level] = y
            y += self._px(ROW)
        self._put(self._none, None if found else 0)
        for chapter, heading in self._headings.items():
            self._put(heading, tops.get(chapter))
        for level, row in self.rows.items():
            self._put(row, self._tops.get(level))
        size = self._width + self._px(MARGIN), max(y, self._px(HEADING)) + self._px(MARGIN)
        self._container.set_scrollable_area_dimensions(size)
        scroll_to(self._container, 0)

    def _put(self, element: UIElement, y: int | None) -> None:
        """Show an element at a height [px], or hide it."""
        if y is not None:
            element.set_relative_position((self._px(MARGIN), y))
            element.show()  # type: ignore[no-untyped-call]
        elif element.visible:
            element.hide()  # type: ignore[no-untyped-call]

    @property
    def search_text(self) -> str:
        """The text of the search field."""
        return str(self.field.get_text())

    @property
    def matching_levels(self) -> list[Entry]:
        """The levels with most, if possible all words of the search, the likeliest first."""
        words = self.search_text.casefold().split()
        if not words:
            return list(self._levels)
        matches = [(e, [word for word in words if word in e.words]) for e in self._levels]
        most = max((len(contained) for _, contained in matches), default=0) or 1
        found = [each for each in matches if len(each[1]) == most]
        return [e for e, _ in sorted(found, key=lambda each: rank(*each))]

    def clear(self) -> None:
        """End the search."""
        if self.search_text:
            self.field.set_text("")
            self._show()
            self.choose(self._chosen)

    def choose(self, path: Path | None) -> None:
        """Mark a level as the one that is played, and scroll to it."""
        self._chosen = path
        for level, row in self.rows.items():
            show_pressed(row, level.path == path)
        for level, y in self._tops.items():
            if level.path == path:
                top, height = scroll_position(self._container), self._container.rect.height
                if not top <= y <= top + height - self._px(ROW):
                    scroll_to(self._container, y - height / 2)

    def process(self, event: pygame.event.Event) -> Path | None:
        """Return the level that was clicked on, or with Enter the first found; None if neither."""
        if event.type == UI_BUTTON_PRESSED:
            pressed = (e.path for e, row in self.rows.items() if row is event.ui_element)
            return next(pressed, None)
        if event.type == UI_TEXT_ENTRY_CHANGED and event.ui_element is self.field:
            self._show()
        if (
            event.type == UI_TEXT_ENTRY_FINISHED
            and event.ui_element is self.field
            and self.matching_levels
        ):
            return self.matching_levels[0].path
        return None

    def button(self, path: Path) -> UIButton:
        """Return the button of a level."""
        self.complete()
        return next(row for level, row in self.rows.items() if level.path == path)
