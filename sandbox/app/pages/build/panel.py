"""The page Build: the tools, the pending decisions, and the fields."""

import os
from collections.abc import Callable, Collection, Sequence
from typing import TYPE_CHECKING

import pygame
from pygame_gui import UI_BUTTON_PRESSED, UI_TEXT_ENTRY_CHANGED, UI_TEXT_ENTRY_FINISHED
from pygame_gui.elements import UIButton

from sandbox.app.building import inspected_fields
from sandbox.app.building.button_action import ButtonAction
from sandbox.app.building.editable_fields import Row
from sandbox.app.building.editor import Editor
from sandbox.app.pages.build import mistakes_suggestions_and_effects
from sandbox.app.pages.build.inspector import Inspector, Line
from sandbox.app.pages.build.mistakes_suggestions_and_effects import Block
from sandbox.app.pages.build.toolbar import Toolbar
from sandbox.app.pages.build.widget_column import GAP, HEIGHT, WidgetColumn
from sandbox.app.pages.page import Desk
from sandbox.app.widgets.scrolling_area import Sheet
from sandbox.app.widgets.widget_states_and_scrolling import scroll_to, show_pressed
from sandbox.app.words.language import say
from sandbox.model import json_positions

if TYPE_CHECKING:
    from sandbox.app.widgets.text_field import TextField

Blocks = tuple[Sequence[Block], Sequence[Block]]


class BuildPage:
    """The panel that shows and sets the parts of the edited level."""

    def __init__(self, sheet: Sheet, desk: Desk) -> None:
        self._sheet, self._session = sheet, desk.session
        self._editor = desk.worker(Editor)
        self._column = WidgetColumn(sheet)
        self.palette = Toolbar(sheet, self._editor, desk.session)
        """The tools."""
        self.inspector = Inspector(sheet, self._column)
        """The fields."""
        self._buttons: list[UIButton] = []
        self._acts: list[tuple[UIButton, ButtonAction]] = []
        self._name: TextField | None = None
        self._offered: dict[json_positions.Path, list[str]] = {}
        self._refused: dict[json_positions.Path, str] = {}
        self._selected: object = None
        self._version: object = None
        self._shape: object = None
        sheet.typed = self
        self._editor.complete = self.complete
        self.update()

    def button(self, caption: str) -> UIButton:
        """Return a button below the tools by its caption."""
        return next(button for button, act in self._acts if act.caption == caption)

    # events

    def process(self, event: pygame.event.Event) -> str | None:
        """Handle a click or a typed text; the editor shows its message."""
        for line in self.inspector.left_lines():
            self._set(line)
        if event.type == UI_BUTTON_PRESSED:
            if not self._press(event.ui_element):
                return None
            show_pressed(event.ui_element, False)  # a click changes the look; `update` sets it
            return ""
        if event.type == UI_TEXT_ENTRY_FINISHED:
            return "" if self._enter(event.ui_element) else None
        if event.type == UI_TEXT_ENTRY_CHANGED:
            return "" if self._offer(event.ui_element) else None
        return None

    def _offer(self, element: object) -> bool:
        """Update the names offered for a typed text, and return whether they have changed."""
        line = self.inspector.line(element)
        if line is None or line.field is None:  # from before the page was rebuilt
            return False
        names = inspected_fields.completions(self._editor.bench, line.entry, line.field.get_text())
        before, self._offered = self._offered, {line.entry.path: names} if names else {}
        return before != self._offered

    def _press(self, element: object) -> bool:
        line = self.inspector.line(element)
        if line is not None:
            self._choose(line, element)
            return True
        act = next((act for button, act in self._acts if button is element), None)
        if act is not None:
            self._editor.trying.read_run_state(self._session)
            self._at_present(act)()
            return True
        return self.palette.press(element) or self.inspector.toggle_section(element)

    def _at_present(self, act: ButtonAction) -> Callable[[], object]:
        """Return what an action does to the present level.

        A key may have changed the level since the page was drawn. Then it is the action of the same
        caption now; if that is missing, or one of several, nothing is done.
        """
        if self._version is self._editor.bench.version:
            return act.do
        alike = [one.caption for _, one in self._acts].count(act.caption)
        self.update()
        now = [new.do for _, new in self._acts if new.caption == act.caption]
        return now[0] if alike == len(now) == 1 else lambda: None

    def _choose(self, line: Line, element: object) -> None:
        if element is line.slider:
            inspected_fields.parametrise(self._editor.bench, line.entry)
            return
        means = next(means for button, means in line.choices.items() if button is element)
        self._assign(line, means)

    def _enter(self, element: object) -> bool:
        """Apply a typed text, after which the keys act on the tools again."""
        if element is self._name:
            self._save_here()
            return True
        line = self.inspector.line(element)
        if line is None:
            return False
        if self._set(line):
            self._sheet.manager.set_focus_set(None)
        return True

    def _set(self, line: Line) -> bool:
        """Set an entry to the text of its field, and return whether that was possible."""
        assert line.field is not None
        line.shown = line.field.get_text()
        return self._assign(line, line.shown)

    def _assign(self, line: Line, typed: str) -> bool:
        self._editor.trying.read_run_state(self._session)
        entry, work = line.entry, self._editor.bench
        self._offered.clear()
        why = inspected_fields.assign(work, line.row, entry, typed)
        self._refused.pop(entry.path, None)
        if why:
            self._refused[entry.path] = why
            work.show_message(f"{entry.label}: {why}")
            self._editor.bench.show()
        return not why

    def _save_here(self) -> None:
        assert self._name is not None
        typed = os.path.expanduser(self._name.get_text().strip())  # an unknown ~name stays
        path = self._editor.saving.proposed.parent / typed
        self._editor.saving.save(path if path.suffix else path.with_suffix(".json"))

    # fields, as the window uses them

    def complete(self) -> bool:
        """Accept the first name offered, and return whether there is one."""
        completed = self.inspector.complete()
        if completed:
            self._offered.clear()
            self.update()
        return completed

    def revert(self) -> None:
        """Reset all fields to the present values, and stop asking for a name."""
        self._refused.clear()
        self.inspector.revert()
        if self._name is not None and self._name.is_focused:
            self._editor.saving.stop_naming()
        self._editor.bench.show()

    # display

    def update(self) -> None:
        """Update the page, with new widgets only if needed."""
        bench = self._editor.bench
        self._version, selected = bench.version, (bench, bench.selected)
        another, self._selected = selected != self._selected, selected
        if another:
            self._refused.clear()
            self._offered.clear()
        self.palette.update()
        rows = inspected_fields.rows(self._editor.bench)
        numbers = inspected_fields.numbers(self._editor.bench)
        blocks = self._blocks()
        shape = (
            selected, self._editor.saving.naming,
            [block.shape for part in blocks for block in part],
            self.inspector.shape(rows, numbers), dict(self._refused), dict(self._offered),
        )  # fmt: skip
        if shape != self._shape:
            self._shape = shape
            self._build(blocks, rows, numbers)
        self._refresh(blocks)
        self.inspector.refresh(rows)
        if another:
            scroll_to(self._sheet.container, 0)

    def _blocks(self) -> Blocks:
        """Return the blocks above and below the field for a file name."""
        editor = self._editor
        below = mistakes_suggestions_and_effects.subject(editor)
        if editor.saving.naming:
            save_here = ButtonAction(
                say("Save here"), say("write the file (Enter)"), self._save_here
            )
            leave = ButtonAction(
                say("Do not save"), say("continue without saving (Esc)"), editor.saving.stop_naming
            )
            below.insert(0, Block("", actions=(save_here, leave)))
        return mistakes_suggestions_and_effects.mistakes_and_choices(editor, self._session), [
            *below,
            *mistakes_suggestions_and_effects.arranging(editor),
        ]

    def _build(
        self, blocks: Blocks, rows: Sequence[Row], numbers: Collection[json_positions.Path]
    ) -> None:
        above, below = blocks
        self.inspector.store_typed_texts()
        self._column.clear()
        self._buttons = []
        self._put(above)
        self._put_name()
        self._put(below)
        self._column.y += 2 * self._sheet.px(GAP)
        self.inspector.build(rows, numbers, self._refused, dict(self._offered))
        self._sheet.set_content_height(self._column.y + self._sheet.px(GAP))

    def _put(self, blocks: Sequence[Block]) -> None:
        for block in blocks:
            self._column.y += self._sheet.px(GAP)
            if block.heading:
                self._column.heading(block.text)
            elif block.text:
                self._column.text(block.text, block.color)
            self._buttons += self._column.buttons(block.actions)

    def _put_name(self) -> None:
        """Make the field for a file name, if one is asked for."""
        before, self._name = self._name, None
        if self._editor.saving.naming:
            typed = before.get_text() if before is not None else str(self._editor.saving.proposed)
            self._name = self._column.field(0, self._sheet.width, typed, tip=say("a file's name"))
            self._column.y += self._sheet.px(HEIGHT) + self._sheet.px(GAP)
            self._sheet.manager.set_focus_set(self._name.get_focus_set())

    def _refresh(self, blocks: Blocks) -> None:
        """Connect the buttons to the present actions."""
        shown = [block for part in blocks for block in part]
        acts = [act for block in shown for act in block.actions]
        pressed = [act.caption in block.pressed for block in shown for act in block.actions]
        self._acts = list(zip(self._buttons, acts, strict=True))
        for button, on in zip(self._buttons, pressed, strict=True):
            show_pressed(button, on)
