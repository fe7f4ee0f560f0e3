"""The palette of tools and of actions on the whole level, which does not scroll."""

from collections.abc import Callable, Iterator, Sequence
from functools import partial

import pygame
from pygame_gui.core import ObjectID
from pygame_gui.elements import UIButton

from sandbox.app.building.editor import Editor
from sandbox.app.building.tools.joining import kinds
from sandbox.app.building.tools.register import TOOLS
from sandbox.app.pages.build.widget_column import GAP, HEIGHT, SIZE, SMALL, side_by_side
from sandbox.app.runs.session import Session
from sandbox.app.widgets.scrolling_area import Sheet
from sandbox.app.widgets.widget_states_and_scrolling import (
    set_enabled,
    show,
    show_pressed,
    stretched,
)
from sandbox.app.words.language import later, say, say_in

ACROSS = 4
"""The number of tools in a row."""
TRY, STOP = later("Try it"), later("Back to building")


class Toolbar:
    """A button for each tool, and one for each joint while that tool is the current one."""

    def __init__(self, sheet: Sheet, editor: Editor, session: Session) -> None:
        self._sheet, self._editor, self._session = sheet, editor, session
        self._buttons: dict[str, UIButton] = {}
        self._acts: dict[UIButton, Callable[[], object]] = {}
        self._joints = kinds()
        y = self._put_tools(self._put_acts(0))
        whole = pygame.Rect(0, y, sheet.width, sheet.px(HEIGHT) + 2)
        tip = say("run the level, and come back (Space, Esc)")
        self._put(whole, TRY, say(TRY), tip, partial(editor.trying.toggle, session), "@main")
        self._without = whole.bottom + sheet.px(GAP)
        self._height = self._put_joints(self._without)
        self.update()

    def _put_acts(self, y: int) -> int:
        """Make the buttons for actions on the level, and return their lower end [px]."""
        editor, session = self._editor, self._session
        acts: tuple[tuple[str, str, Callable[[], object]], ...] = (
            (
                later("New"),
                say("an empty scene with only the ground (Ctrl N)"),
                partial(editor.new, session),
            ),
            (later("Undo"), "", partial(editor.trying.undo, session)),
            (later("Redo"), "", partial(editor.trying.redo, session)),
            (later("Save"), say("save it to its file (Ctrl S)"), editor.saving.save),
            (
                later("Save as"),
                say("save it under another name (Ctrl Shift S)"),
                editor.saving.save_as,
            ),
        )
        places = self._places([name for name, _, _ in acts], y)
        for (name, tip, act), place in zip(acts, places, strict=True):
            self._put(place, name, say(name), tip, act)
        return y + self._sheet.px(HEIGHT) + self._sheet.px(GAP)

    def _put_tools(self, y: int) -> int:
        for start in range(0, len(TOOLS), ACROSS):
            several = TOOLS[start : start + ACROSS]
            places = self._places([kind.caption for kind in several], y)
            for kind, place in zip(several, places, strict=True):
                tip = f"{say(kind.text)} ({kind.key})"
                self._put(
                    place, kind.name, say(kind.caption), tip, partial(self._choose_tool, kind.name)
                )
            y += self._sheet.px(HEIGHT) + self._sheet.px(GAP)
        return y

    def _put_joints(self, y: int) -> int:
        captions = list(map(say, self._joints))
        places = side_by_side(self._sheet.pen, captions, self._sheet.width)
        for (name, text), place in zip(self._joints.items(), places, strict=True):
            self._put(
                place.move(0, y), name, say(name), say(text), partial(self._choose_joint, name)
            )
        return y + places[-1].bottom + self._sheet.px(GAP)

    def _places(self, captions: Sequence[str], y: int) -> Iterator[pygame.Rect]:
        """Yield places side by side, each as wide as its caption and a share of the spare room."""
        gap, x = self._sheet.px(GAP), 0
        wanted = [self._sheet.pen.write(say(caption), SIZE).width for caption in captions]
        room = self._sheet.width - gap * (len(wanted) - 1)
        for width in stretched(wanted, room):
            yield pygame.Rect(x, y, width, self._sheet.px(HEIGHT))
            x += width + gap

    def _put(
        self, place: pygame.Rect, name: str, caption: str, tip: str,
        act: Callable[[], object], kind: str = SMALL,
    ) -> None:  # fmt: skip
        button = UIButton(
            place.move(self._sheet.margin, 0), caption, self._sheet.manager,
            container=self._sheet.strip, tool_tip_text=tip, object_id=ObjectID(class_id=kind),
        )  # fmt: skip
        self._buttons[name], self._acts[button] = button, act

    def button(self, name: str) -> UIButton:
        """Return the button of a tool or a joint by its name, or another by its caption."""
        return self._buttons[name]

    def press(self, element: object) -> bool:
        """Execute the action of a button, and return whether it is one of these."""
        act = next((act for button, act in self._acts.items() if button is element), None)
        if act is not None:
            act()
        return act is not None

    def _choose_tool(self, tool: str) -> None:
        self._editor.tools.choose(tool)
        self._editor.resume_time()

    def _choose_joint(self, kind: str) -> None:
        self._editor.tools.joining.use(kind)
        self._editor.bench.show()

    def update(self) -> None:
        """Show the current tool, and whether there is something to undo, redo or save."""
        editor, draft = self._editor, self._editor.work.draft
        for kind in TOOLS:
            show_pressed(self._buttons[kind.name], kind.name == editor.tools.tool)
        undoes, redoes = (
            editor.trying.undo_description(self._session),
            editor.trying.redo_description(self._session),
        )
        for name, key, undone in (("Undo", "Ctrl Z", undoes), ("Redo", "Ctrl Y", redoes)):
            set_enabled(self._buttons[name], undone is not None)
            self._buttons[name].set_tooltip(
                f"{undone} ({say_in('key', key)})" if undone else None, delay=0.6
            )
        set_enabled(self._buttons["Save"], draft.changed or draft.path is None)
        self._buttons[TRY].set_text(say(STOP if editor.trying.is_shown(self._session) else TRY))
        self._show_joints(editor.tools.tool == "join")

    def _show_joints(self, shown: bool) -> None:
        """Show or hide the buttons of the joints."""
        for name in self._joints:
            button = self._buttons[name]
            show(button, shown)
            if shown:  # only visible buttons have a look
                show_pressed(button, name == self._editor.tools.joining.kind)
        self._sheet.set_strip_height(self._height if shown else self._without)
