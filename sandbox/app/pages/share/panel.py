"""The page Share, which saves pictures, films, tables, runs and levels."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

import pygame
from pygame_gui import UI_BUTTON_PRESSED
from pygame_gui.elements import UIButton

from sandbox.app.cards.text_column import TextColumn, titled_note
from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.files import save_folder
from sandbox.app.pages.page import Desk
from sandbox.app.pages.share import saving
from sandbox.app.pages.share.background_film import FilmWorker
from sandbox.app.runs.session import Session
from sandbox.app.widgets.scrolling_area import Sheet, below
from sandbox.app.words.language import later, say

BUTTON = 104, 28  # px
ROW = 52  # px, the least height of a row
GAP = 8  # px, between the images of two rows

KINDS: tuple[tuple[str, str, Callable[[Session], Path]], ...] = (
    (later("Picture"), later("the window as a PNG"), saving.screenshot),
    (later("Table"), later("what the checks measure at each step, as a CSV"), saving.table),
    (later("Run"), later("to replay the run to the last bit: sandbox replay"), saving.run),
    (later("Level"), later("a copy with the present values of its parameters"), saving.level),
)


class SharePage:
    """A button for each thing that can be saved."""

    def __init__(self, sheet: Sheet, desk: Desk) -> None:
        self._sheet, self._session = sheet, desk.session
        self._filming = desk.worker(FilmWorker)
        y = below(sheet.image(_intro(sheet.pen, sheet.width), sheet.margin // 2)) + 8
        self._actions: dict[UIButton, Callable[[], str]] = {}
        for caption, text, save in KINDS:
            y = self._row(y, say(caption), say(text), partial(self._save, save))
        small = say("the run so far, in small, for a page or a message")
        y = self._row(y, "GIF", small, partial(self._filming.begin, self._session, "gif"))
        large = say("the run so far, 1280 x 720")
        y = self._row(y, "MP4", large, partial(self._filming.begin, self._session, "mp4"))
        self._state = sheet.image(self._drawn(), y)
        self.update()

    def _row(self, y: int, caption: str, text: str, act: Callable[[], str]) -> int:
        """Make a button and a description beside it, and return the height of the next row [px]."""
        sheet = self._sheet
        button = sheet.button(
            pygame.Rect((0, y), self._sheet.scaled(BUTTON)), caption, say("save: {what}", what=text)
        )
        self._actions[button] = act
        card = TextColumn(sheet.pen, sheet.width - self._sheet.px(BUTTON[0]) - 12)
        card.text(text, 13, theme.DIM)
        place = pygame.Rect(self._sheet.margin + self._sheet.px(BUTTON[0]) + 12, y + 4, 0, 0)
        image = card.drawn()
        sheet.image(image, y + 4).set_relative_position(place.topleft)
        return y + max(sheet.px(ROW), image.height + 4 + sheet.px(GAP))

    def button(self, caption: str) -> UIButton:
        """Return the button with a caption."""
        return next(button for button in self._actions if button.text == caption)

    def process(self, event: pygame.event.Event) -> str | None:
        """Save the file of a button, and return the message about its path."""
        if event.type != UI_BUTTON_PRESSED or event.ui_element not in self._actions:
            return None
        return self._actions[event.ui_element]()

    def update(self) -> None:
        """Show the progress of a film, and its path once it is saved."""
        self._sheet.replace(self._state, self._drawn())
        self._sheet.set_content_height(below(self._state) + 8)

    def _save(self, save: Callable[[Session], Path]) -> str:
        return say("saved {path}", path=save(self._session))

    def _drawn(self) -> pygame.Surface:
        card = TextColumn(self._sheet.pen, self._sheet.width)
        if self._filming.running:
            message = say("Filming: {share:.0%}", share=self._filming.done)
            card.text(message, 14, theme.NOTICE)
        elif self._filming.message:
            card.text(self._filming.message, 13, theme.DIM)
        card.y = max(card.y, self._sheet.pen.height(14))  # at least one line
        return card.drawn()


def _intro(pen: Pen, width: int) -> pygame.Surface:
    text = say("Files go to {folder}", folder=save_folder.folder())
    return titled_note(pen, width, say("Take away"), text)
