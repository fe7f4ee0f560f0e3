"""The inspector: fields, choices and switches of the selected part (see `inspected_fields`)."""

import dataclasses
from collections.abc import Collection, Iterator, Mapping, Sequence

import pygame
from pygame_gui.elements import UIButton

from sandbox.app.building.button_action import ButtonAction
from sandbox.app.building.editable_fields import EditableField, Row, Section, caption_of
from sandbox.app.drawing import theme
from sandbox.app.pages.build.widget_column import GAP, HEIGHT, WidgetColumn
from sandbox.app.widgets.scrolling_area import Sheet
from sandbox.app.widgets.text_field import TextField
from sandbox.app.widgets.widget_states_and_scrolling import show_pressed
from sandbox.app.words.language import later, say
from sandbox.model.json_positions import Path

LABEL = 98  # px
UNIT = 44  # px
SLIDER = 44  # px
INDENT = 10  # px, of the rows of a section
MOST = 300
"""The largest number of characters of a text that is edited in a field."""
TOO_LONG = later("too long for one line: edit it in the file")
SWITCHED: Mapping[str, str] = {later("no"): "false", later("yes"): "true"}


@dataclasses.dataclass(slots=True)
class Line:
    """An entry with its widgets."""

    entry: EditableField
    row: Sequence[EditableField]
    """the entries of its row, such as both coordinates of a point"""
    field: TextField | None = None
    shown: str = ""
    """the text of the field before typing"""
    choices: dict[UIButton, str] = dataclasses.field(default_factory=dict)
    slider: UIButton | None = None


class Inspector:
    """The rows of entries and sections, one below the other."""

    def __init__(self, sheet: Sheet, column: WidgetColumn) -> None:
        self._sheet, self._column = sheet, column
        self._lines: dict[Path, Line] = {}
        self._headings: dict[UIButton, Path] = {}
        self._turned: set[Path] = set()
        self._numbers: Collection[Path] = ()
        self._refused: Mapping[Path, str] = {}
        self._offered: Mapping[Path, Sequence[str]] = {}
        self._kept: dict[Path, tuple[str, str]] = {}
        self._focused: Path | None = None

    def shape(self, rows: Sequence[Row], numbers: Collection[Path]) -> tuple[object, ...]:
        """Return a key that changes whenever new widgets are needed."""
        found: list[object] = []
        for row in rows:
            if isinstance(row, Section):
                opened = self._opened(row.path)
                found.append((row.path, row.label, opened))
                found += self.shape(row.rows, numbers) if opened else ()
            else:
                found += [_form(entry, numbers) for entry in row]
        return tuple(found)

    def build(
        self, rows: Sequence[Row], numbers: Collection[Path], refused: Mapping[Path, str],
        offered: Mapping[Path, Sequence[str]],
    ) -> None:  # fmt: skip
        """Make all widgets.

        By path, `numbers` can be made parameters, `refused` says why typed texts were refused, and
        `offered` are the names that complete them.
        """
        self._offered = offered
        self._lines, self._headings = {}, {}
        self._numbers, self._refused = numbers, refused
        self._put_rows(rows, 0)
        self._restore_typed_text()
        self.refresh(rows)

    def _put_rows(self, rows: Sequence[Row], x: int) -> None:
        for row in rows:
            if isinstance(row, Section):
                self._put_section(row, x)
            else:
                for entry in row:
                    self._put(Line(entry, row), x)

    def _put_section(self, section: Section, x: int) -> None:
        opened, column = self._opened(section.path), self._column
        place = pygame.Rect(x, 0, self._sheet.width - x, self._sheet.px(HEIGHT))
        caption = f"{'−' if opened else '+'}  {section.label}"
        self._headings[column.button(place, caption, section.help, "@section")] = section.path
        column.y += self._sheet.px(HEIGHT) + self._sheet.px(GAP)
        if opened:
            self._put_rows(section.rows, x + self._sheet.px(INDENT))

    def _opened(self, path: Path) -> bool:
        """Return whether a section is open, as those of bodies and joints are at first."""
        return (path[0] in ("bodies", "joints")) is not (path in self._turned)

    def _put(self, line: Line, x: int) -> None:
        entry, column = line.entry, self._column
        self._lines[entry.path] = line
        column.label(entry.label, x, self._sheet.px(LABEL) - x, _tip(entry))
        if options := _options(entry):
            self._put_choices(line, options)
        elif len(entry.shown) > MOST:
            left = self._sheet.px(LABEL)
            column.label(say(TOO_LONG), left, self._sheet.width - left)
            column.y += self._sheet.px(HEIGHT) + self._sheet.px(GAP)
        else:
            self._put_field(line)
        if why := self._refused.get(entry.path):
            column.text(why, theme.FAILED, self._sheet.px(LABEL))

    def _put_choices(self, line: Line, options: Mapping[str, str]) -> None:
        acts = [ButtonAction(caption, line.entry.help, bool) for caption in options]
        buttons = self._column.buttons(acts, self._sheet.px(LABEL))
        line.choices = dict(zip(buttons, options.values(), strict=True))

    def _put_field(self, line: Line) -> None:
        entry, column = line.entry, self._column
        px, left = self._sheet.px, self._sheet.px(LABEL)
        room, adjustable = self._sheet.width - left, _adjustable(entry, self._numbers)
        if adjustable:
            room -= px(SLIDER) + px(GAP)
        if entry.input_kind == "number":
            room -= px(UNIT)
            column.label(entry.unit, left + room + px(GAP), px(UNIT) - px(GAP))
        line.field = column.field(left, room, entry.shown, entry.default, _tip(entry))
        line.shown = entry.shown
        if adjustable:
            place = pygame.Rect(self._sheet.width - px(SLIDER), 0, px(SLIDER), px(HEIGHT))
            tip = say(
                "make this a parameter: {field} gets a slider on the level's page",
                field=entry.label,
            )
            line.slider = column.button(place, say("slider"), tip)
        column.y += px(HEIGHT) + px(GAP)
        if names := self._offered.get(entry.path):
            self._put_choices(line, {name: name for name in names})

    def refresh(self, rows: Sequence[Row]) -> None:
        """Show the present values, except in fields where a text is being typed or was refused."""
        for row in self._entries(rows):
            for entry in row:
                line = self._lines[entry.path]
                line.entry, line.row = entry, row
                self._refresh_field(line)
                for button, means in line.choices.items():
                    show_pressed(button, (entry.shown or entry.default) == means)

    def _refresh_field(self, line: Line) -> None:
        field, shown = line.field, line.entry.shown
        if field is None or field.is_focused or line.entry.path in self._refused:
            return
        line.shown = shown
        if field.get_text() != shown:
            field.set_text(shown)

    def _entries(self, rows: Sequence[Row]) -> Iterator[Sequence[EditableField]]:
        """Yield the visible rows."""
        for row in rows:
            if not isinstance(row, Section):
                yield row
            elif self._opened(row.path):
                yield from self._entries(row.rows)

    # typed texts

    @property
    def _fields(self) -> list[tuple[Line, TextField]]:
        return [(line, line.field) for line in self._lines.values() if line.field is not None]

    def store_typed_texts(self) -> None:
        """Store texts that are being typed or were refused, before the widgets are rebuilt."""
        self._focused = next((li.entry.path for li, f in self._fields if f.is_focused), None)
        self._kept = {
            line.entry.path: (field.get_text(), line.shown)
            for line, field in self._fields
            if field.is_focused or line.entry.path in self._refused
        }

    def _restore_typed_text(self) -> None:
        for line, field in self._fields:
            if (typed := self._kept.get(line.entry.path)) is not None:
                text, line.shown = typed
                field.set_text(text)
            if line.entry.path == self._focused:
                self._sheet.manager.set_focus_set(field.get_focus_set())

    def left_lines(self) -> list[Line]:
        """Return the lines with a changed field that has lost the focus.

        Those with the mouse on a name that is offered are left out.
        """
        return [
            line
            for line, field in self._fields
            if not field.is_focused
            and field.get_text() != line.shown
            and not any(button.held or button.hovered for button in line.choices)
        ]

    def line(self, element: object) -> Line | None:
        """Return the line of a widget; None if there is none."""
        return next(
            (
                line
                for line in self._lines.values()
                if element in (line.field, line.slider, *line.choices)
            ),
            None,
        )

    def toggle_section(self, element: object) -> bool:
        """Open or close the section of a heading, and return whether the widget is a heading."""
        path = next((p for button, p in self._headings.items() if button is element), None)
        if path is not None:
            self._turned ^= {path}
        return path is not None

    def field(self, *path: str | int) -> TextField:
        """Return the field of a path."""
        found = self._lines[path].field
        assert found is not None
        return found

    def parametrise_button(self, *path: str | int) -> UIButton:
        """Return the button that makes the number at a path a parameter."""
        found = self._lines[path].slider
        assert found is not None
        return found

    def complete(self) -> bool:
        """Accept the first name offered for a field, and return whether there is one."""
        for line, field in self._fields:
            if field.is_focused and (names := self._offered.get(line.entry.path)):
                field.set_text(names[0])
                return True
        return False

    def revert(self) -> None:
        """Reset the fields to the present values."""
        for line, field in self._fields:
            line.shown = line.entry.shown
            field.set_text(line.shown)


def _options(entry: EditableField) -> Mapping[str, str]:
    """Return the options of a choice or a switch, by caption."""
    if entry.input_kind == "switch":
        return {say(caption): means for caption, means in SWITCHED.items()}
    return {say(caption_of(choice)): choice for choice in entry.choices}


def _tip(entry: EditableField) -> str:
    """Return the tooltip of an entry."""
    description = entry.help or entry.label
    if not entry.default:
        return description
    captions = (caption for caption, means in _options(entry).items() if means == entry.default)
    default = next(captions, entry.default)
    return say("{help}; {default} if left empty", help=description, default=default)


def _form(entry: EditableField, numbers: Collection[Path]) -> tuple[object, ...]:
    """Return a key on which the widgets of an entry depend."""
    return entry.path, entry.input_kind, _adjustable(entry, numbers), len(entry.shown) > MOST


def _adjustable(entry: EditableField, numbers: Collection[Path]) -> bool:
    """Return whether an entry is a number, given or by default, that can be made a parameter."""
    return bool(entry.shown or entry.default) and entry.path in numbers
