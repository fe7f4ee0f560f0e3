"""A column of widgets that can be removed together."""

from collections.abc import Sequence

import pygame
from pygame_gui.core import ObjectID, UIElement
from pygame_gui.elements import UIButton

from sandbox.app.building.button_action import ButtonAction
from sandbox.app.cards.text_column import TextColumn, heading
from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color
from sandbox.app.widgets.scrolling_area import Sheet, in_rows
from sandbox.app.widgets.text_field import TextField

HEIGHT = 24  # px, of a button or a field
GAP = 4  # px, between two
SMALL = "@small"
"""The style of these buttons, and of their fields."""
SIZE = 12  # of their captions, as in widgets.json
PADDING = 14  # px, beside a caption, left and right together


def side_by_side(pen: Pen, captions: Sequence[str], width: int) -> list[pygame.Rect]:
    """Return the places of buttons side by side, as many on a line as fit into a width [px]."""
    widths = (pen.write(caption, SIZE).width + pen.px(PADDING) for caption in captions)
    return list(in_rows(widths, width, pen.px(HEIGHT), pen.px(GAP)))


class WidgetColumn:
    """The widgets of a sheet, from top to bottom."""

    def __init__(self, sheet: Sheet) -> None:
        self._sheet = sheet
        self._widgets: list[UIElement] = []
        self.y = sheet.margin // 2
        """The height of the next widget [px]."""

    def clear(self) -> None:
        """Remove all widgets, and start at the top again."""
        for widget in self._widgets:
            widget.kill()  # type: ignore[no-untyped-call]
        self._widgets.clear()
        self.y = self._sheet.margin // 2

    def heading(self, text: str) -> None:
        """Add a heading under a line."""
        self._put_picture(heading(self._sheet.pen, self._sheet.width, text))

    def text(self, text: str, color: Color | None = None, x: int = 0) -> None:
        """Add a wrapped paragraph."""
        card = TextColumn(self._sheet.pen, self._sheet.width - x)
        card.text(text, SIZE, color or theme.DIM)
        self._put_picture(card.drawn(), x)

    def _put_picture(self, picture: pygame.Surface, x: int = 0) -> None:
        image = self._sheet.image(picture, self.y)
        image.set_relative_position((self._sheet.margin + x, self.y))
        self._widgets.append(image)
        self.y += picture.height + self._sheet.px(GAP)

    def label(self, text: str, x: int, room: int, tip: str = "") -> None:
        """Add a label at the start of a line, shortened to its room [px]."""
        pen = self._sheet.pen
        picture = pen.write(pen.shorten(text, room, SIZE), SIZE, theme.DIM)
        image = self._sheet.image(picture, self.y)
        below = (self._sheet.px(HEIGHT) - picture.height) // 2
        image.set_relative_position((self._sheet.margin + x, self.y + below))
        if tip:
            image.set_tooltip(tip, delay=0.6)
        self._widgets.append(image)

    def field(
        self, x: int, width: int, text: str, placeholder: str = "", tip: str = ""
    ) -> TextField:
        """Add a field to the present line; `placeholder` is shown while it is empty."""
        field = TextField(
            pygame.Rect(self._sheet.margin + x, self.y, width, self._sheet.px(HEIGHT)),
            self._sheet.manager,
            container=self._sheet.container, initial_text=text, placeholder_text=placeholder,
            object_id=ObjectID(class_id=SMALL),
        )  # fmt: skip
        if tip:
            field.set_tooltip(tip, delay=0.6)
        self._widgets.append(field)
        return field

    def button(self, rect: pygame.Rect, caption: str, tip: str, kind: str = SMALL) -> UIButton:
        """Add a button, at a place relative to the present line."""
        button = self._sheet.button(rect.move(0, self.y), caption, tip, kind)
        self._widgets.append(button)
        return button

    def buttons(self, acts: Sequence[ButtonAction], x: int = 0) -> list[UIButton]:
        """Add rows of buttons, and continue below them."""
        places = side_by_side(self._sheet.pen, [act.caption for act in acts], self._sheet.width - x)
        made = [
            self.button(place.move(x, 0), act.caption, act.tip)
            for act, place in zip(acts, places, strict=True)
        ]
        self.y += places[-1].bottom + self._sheet.px(GAP) if places else 0
        return made
