"""Sliders and number fields for a level's parameters."""

from collections.abc import Mapping
from dataclasses import dataclass

import pygame
from pygame_gui import UI_HORIZONTAL_SLIDER_MOVED, UI_TEXT_ENTRY_FINISHED, UIManager
from pygame_gui.elements import UIHorizontalSlider, UIImage, UIScrollingContainer

from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.widgets.round_slider_steps import rounded, step_size
from sandbox.app.widgets.text_field import TextField
from sandbox.app.words import formatting
from sandbox.app.words.level_translation import Say
from sandbox.app.words.typed_numbers import read
from sandbox.model.expression_compiler import ExpressionError
from sandbox.model.expressions import Values
from sandbox.model.level import Parameter
from sandbox.model.translatable_message import NOTHING, Message

ROW = 46  # px
FIELD = 68  # px
UNIT = 42  # px
LINE = 13  # px, between two lines of a label
LONGEST = 60  # characters in a field
ABOVE = 20  # the layer of a note, above all fields and sliders
PADDING = 7, 5  # px, around the text of a note


@dataclass(slots=True)
class Row:
    """A parameter with its widgets."""

    parameter: Parameter
    slider: UIHorizontalSlider
    field: TextField
    shown: str
    """the text of the field while nothing is typed"""


@dataclass(frozen=True, slots=True)
class Change:
    """A change of a parameter that the user asks for; without a `value`, it is refused."""

    name: str
    value: float | None
    refusal: Message = NOTHING
    with_shift: bool = False
    """whether Shift was held while dragging; see `otherwise` of `Session.change`"""


class ParameterSliders:
    """Rows of widgets, one for each parameter, at the top of an area of a container."""

    def __init__(
        self, manager: UIManager, pen: Pen, container: UIScrollingContainer,
        area: pygame.Rect, parameters: Mapping[str, Parameter], values: Values,
        words: Say = str,
    ) -> None:  # fmt: skip
        self._manager, self._words, self._values = manager, words, values
        self._rows: dict[str, Row] = {}
        self._pen, self._container, self._width = pen, container, area.width
        self._note: UIImage | None = None
        self.refusal = ""
        """The note beside a field about its refused value; empty if there is none."""
        height = pen.px(ROW)
        for i, (name, parameter) in enumerate(parameters.items()):
            row = pygame.Rect(area.x, area.y + i * height, area.width, height)
            self._rows[name] = self._row(pen, container, row, name, parameter, values[name])
        self.height = len(self._rows) * height

    def _row(
        self, pen: Pen, container: UIScrollingContainer, rect: pygame.Rect,
        name: str, parameter: Parameter, value: float,
    ) -> Row:  # fmt: skip
        manager, px = self._manager, pen.px
        room = rect.width - px(FIELD) - px(UNIT) - 8
        unit = "°" if parameter.unit == "deg" else parameter.unit
        box = pygame.Rect(rect.right - px(UNIT) - px(FIELD), rect.y, px(FIELD), px(26))
        label = self._words(parameter.label)
        symbol = pen.write(name if label else "", 13, theme.DIM)
        title = _title(pen, label or name, room - symbol.width - 8)
        texts = [(title, rect.x), (pen.write(unit, 14, theme.DIM), box.right + 6)]
        if symbol.width and name != label:
            texts.append((symbol, rect.x + title.width + 8))
        for image, x in texts:
            place = image.get_rect(midleft=(x, rect.y + px(13)))
            UIImage(place, image, manager, container=container)
        field = TextField(box, manager, container=container)
        field.set_text_length_limit(LONGEST)
        slider = UIHorizontalSlider(
            pygame.Rect(rect.x, rect.y + px(29), rect.width, px(13)), value,
            (parameter.min, parameter.max), manager, container=container,
        )  # fmt: skip
        text = formatting.setting(value)
        field.set_text(text)
        return Row(parameter, slider, field, text)

    def show(self, values: Values) -> None:
        """Show other values; parameters that no longer exist keep their values."""
        self._values = values
        for name, row in self._rows.items():
            if name not in values:
                continue
            text = formatting.setting(values[name])
            if text != row.shown or not row.field.is_focused:
                if row.field.get_text() != text:
                    row.field.set_text(text)
                row.shown = text
            if not row.slider.sliding_button or not row.slider.sliding_button.held:
                row.slider.set_current_value(values[name])

    def process(self, event: pygame.event.Event) -> Change | None:
        """Return the change that an event asks for, or None; a key or click ends a refusal."""
        if event.type in (pygame.KEYDOWN, pygame.MOUSEBUTTONDOWN):
            self.accept()
        for name, row in self._rows.items():
            if event.type == UI_HORIZONTAL_SLIDER_MOVED and event.ui_element is row.slider:
                return self._slider_change(name, row)
            if event.type == UI_TEXT_ENTRY_FINISHED and event.ui_element is row.field:
                return self._typed_change(name, row)
            if event.type == pygame.KEYDOWN and row.field.is_focused:
                return self._key_change(name, row, event)
        return None

    def left_field_change(self) -> Change | None:
        """Return the change typed into a field that has lost the focus, or None."""
        for name, row in self._rows.items():
            if not row.field.is_focused and row.field.get_text() != row.shown:
                return self._typed_change(name, row)
        return None

    def revert(self) -> None:
        """Reset the fields to the current values, selected for typing over."""
        for row in self._rows.values():
            row.field.set_text(row.shown)
            if row.field.is_focused:
                row.field.select_range = [0, len(row.shown)]

    def refuse(self, name: str, why: str) -> None:
        """Show beside the field of a parameter why its value was refused."""
        self.accept()
        self.refusal = why
        note, field = _note(self._pen, why, self._width), self._rows[name].field
        place = note.get_rect(topright=field.relative_rect.bottomright)
        place.right += self._pen.px(UNIT)
        if field.rect.bottom + place.height > self._container.rect.bottom:
            place.bottom = field.relative_rect.top
        self._note = UIImage(
            place, note, self._manager, container=self._container, starting_height=ABOVE
        )

    def accept(self) -> None:
        """Remove the note about a refused value."""
        if self._note is not None:
            self._note.kill()  # type: ignore[no-untyped-call]
            self._note, self.refusal = None, ""

    @property
    def selected(self) -> bool:
        """Whether the whole text of a field is selected, as when a value has been taken."""
        return any(row.field.is_focused and row.field.selected for row in self._rows.values())

    def row(self, name: str) -> Row:
        """Return the widgets of a parameter."""
        return self._rows[name]

    def _slider_change(self, name: str, row: Row) -> Change:
        """Return the change to the slider's value, rounded to a step."""
        value = rounded(row.parameter, row.slider.get_current_value())
        shifted = bool(pygame.key.get_mods() & pygame.KMOD_SHIFT)
        return Change(name, value, with_shift=shifted)

    def _typed_change(self, name: str, row: Row) -> Change:
        """Return the change to a typed number, which may have a unit and name other parameters."""
        text = row.field.get_text().strip()
        if "(" not in text:  # where a comma separates arguments
            text = text.replace(",", ".")
        try:
            value = read(text, row.parameter.unit, self._values)
        except ExpressionError as error:
            return Change(name, None, error.message)
        return Change(name, value)

    def _key_change(self, name: str, row: Row, event: pygame.event.Event) -> Change | None:
        """Return the change by one step, or by ten steps with Shift; None for other keys."""
        directions = {pygame.K_UP: 1, pygame.K_DOWN: -1}
        if event.key not in directions:
            return None
        base = self._typed_change(name, row).value
        if base is None:
            return None
        many = 10 if event.mod & pygame.KMOD_SHIFT else 1
        value = base + directions[event.key] * many * step_size(row.parameter)
        value = float(f"{min(max(value, row.parameter.min), row.parameter.max):.9g}")
        return Change(name, value)


def _note(pen: Pen, text: str, width: int) -> pygame.Surface:
    """Draw a note, on as many lines as it needs."""
    across, above = map(pen.px, PADDING)
    lines = [pen.write(line, 13) for line in pen.wrap(text, width - 2 * across, 13)]
    height = max(line.height for line in lines)
    wide = max(line.width for line in lines) + 2 * across
    note = pygame.Surface((wide, len(lines) * height + 2 * above))
    note.fill(theme.RAISED)
    pygame.draw.rect(note, theme.FAILED, note.get_rect(), 1)
    note.blits([(line, (across, above + i * height)) for i, line in enumerate(lines)])
    return note


def _title(pen: Pen, text: str, width: int) -> pygame.Surface:
    """Draw a label on one line, or in smaller letters on two, shortened if it does not fit."""
    if pen.shorten(text, width) == text:
        return pen.write(text, 14)
    first, *others = pen.wrap(text, width, 12)
    second = [pen.shorten(" ".join(others), width, 12)] if others else []
    rows = [pen.write(line, 12) for line in (first, *second)]
    size = max(row.width for row in rows), rows[0].height + pen.px(LINE) * len(second)
    title = pygame.Surface(size, pygame.SRCALPHA)
    title.blits([(row, (0, i * pen.px(LINE))) for i, row in enumerate(rows)])
    return title
