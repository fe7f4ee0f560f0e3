"""The keys of the editor, and their lines in the help."""

from collections.abc import Callable, Mapping
from functools import partial
from typing import Protocol

import pygame

from sandbox.app.building.edited_level import Work
from sandbox.app.building.tools.register import TOOLS
from sandbox.app.building.tools.tool import Tool
from sandbox.app.keys import CONTROL
from sandbox.app.runs.session import Session

ARROWS: Mapping[int, tuple[int, int]] = {
    pygame.K_LEFT: (-1, 0),
    pygame.K_RIGHT: (1, 0),
    pygame.K_UP: (0, 1),
    pygame.K_DOWN: (0, -1),
}

FINE = 0.1
"""The share of a step by which arrows nudge while Alt is held."""

HELP: tuple[tuple[str, str], ...] = (
    *((kind.key, kind.text) for kind in TOOLS),
    ("", ""),
    ("Space", "try it; Esc comes back to building"),
    ("in the run", "tools add, Delete removes, Ctrl Z undoes"),
    ("Esc", "cancel, select nothing"),
    ("Enter, Backspace", "finish a shape of several points; remove the last point"),
    ("drag, Shift and click", "select with a frame; add or remove one"),
    ("arrows", "nudge by a step of the grid; with Alt by a tenth of it"),
    ("Alt", "no snapping while held"),
    ("Delete", "delete the selection and its joints"),
    ("Ctrl C, V, D", "copy, paste, duplicate"),
    ("Ctrl A", "select all"),
    ("Ctrl G, Ctrl Shift G", "group the selection; ungroup it"),
    ("Ctrl Z, Ctrl Y", "undo; redo (also Ctrl Shift Z), the run too"),
    ("Tab", "accept the first suggested name"),
    ("Ctrl S, Ctrl Shift S", "save; save under another name"),
    ("Ctrl N", "an empty scene"),
    ("right or middle drag", "move the view; the wheel zooms, F fits it"),
    ("", ""),
    ("letters", "open the other pages, where H tells all other keys"),
)


class Keyed(Protocol):
    """What keys act on: the editor."""

    bench: Work
    tool: str

    @property
    def hand(self) -> Tool:
        """The tool in hand."""
        ...

    def trying(self, session: Session) -> bool:
        """Whether the run is shown."""
        ...

    def back(self, session: Session) -> None:
        """Go back to building."""
        ...

    def look(self, session: Session) -> None:
        """Take in where the run stands, before it is changed."""
        ...

    def go_on(self, session: Session) -> None:
        """Let time run again, once nothing is being drawn into the run."""
        ...

    def undo(self, session: Session) -> None:
        """Take back what was done last."""
        ...

    def redo(self, session: Session) -> None:
        """Do again what was taken back last."""
        ...

    def choose(self, tool: str) -> None:
        """Take a tool in hand."""
        ...

    def give_up(self) -> None:
        """Give up what was begun, or else what is selected."""
        ...

    def save(self) -> None:
        """Save the level to its file."""
        ...

    def save_as(self) -> None:
        """Ask for the name under which to save."""
        ...


def press(editor: Keyed, event: pygame.event.Event, session: Session) -> bool:
    """Do what a pressed key means, and return whether it means anything here."""
    if event.mod & CONTROL:
        return _with_control(editor, event, session)
    kind = next((k for k in TOOLS if event.unicode and k.key == event.unicode), None)
    if kind is not None:
        editor.choose(kind.name)
        editor.go_on(session)
        return True
    if editor.trying(session):
        return _while_trying(editor, event, session)
    return _while_building(editor, event)


def _with_control(editor: Keyed, event: pygame.event.Event, session: Session) -> bool:
    shift, work = bool(event.mod & pygame.KMOD_SHIFT), editor.bench
    undo, redo = partial(editor.undo, session), partial(editor.redo, session)
    acts: Mapping[int, Callable[[], object]] = {
        pygame.K_z: redo if shift else undo,
        pygame.K_y: redo,
        pygame.K_s: editor.save_as if shift else editor.save,
        pygame.K_a: work.select_all,
        pygame.K_g: work.ungroup if shift else work.group,
        pygame.K_c: work.copy,
        pygame.K_v: work.paste,
        pygame.K_d: work.duplicate,
    }
    act = acts.get(event.key)
    if act is None:
        return False
    if event.key not in (pygame.K_z, pygame.K_y, pygame.K_s):
        editor.look(session)
    act()
    if event.key in (pygame.K_v, pygame.K_d):
        editor.choose(TOOLS[0].name)  # to drag the copy
    return True


def _while_trying(editor: Keyed, event: pygame.event.Event, session: Session) -> bool:
    """Change the run, or go back to building."""
    first = TOOLS[0].name
    if event.key in (pygame.K_RETURN, pygame.K_KP_ENTER) and editor.hand.busy:
        editor.hand.finish()
    elif event.key == pygame.K_BACKSPACE and editor.hand.busy:
        editor.hand.cancel()
    elif event.key in (pygame.K_DELETE, pygame.K_BACKSPACE):
        editor.look(session)
        editor.bench.delete()
    elif event.key == pygame.K_ESCAPE and editor.tool == first:
        editor.back(session)
    elif event.key == pygame.K_ESCAPE and editor.hand.busy:
        editor.hand.cancel()
    elif event.key == pygame.K_ESCAPE:
        editor.choose(first)
    else:
        return False
    editor.go_on(session)
    return True


def _while_building(editor: Keyed, event: pygame.event.Event) -> bool:
    if event.key in ARROWS:
        editor.bench.nudge(*ARROWS[event.key], FINE if event.mod & pygame.KMOD_ALT else 1.0)
    elif event.key in (pygame.K_RETURN, pygame.K_KP_ENTER):
        editor.hand.finish()
    elif event.key == pygame.K_BACKSPACE and editor.hand.busy:
        editor.hand.cancel()
    elif event.key in (pygame.K_DELETE, pygame.K_BACKSPACE):
        editor.bench.delete()
    elif event.key == pygame.K_ESCAPE:
        editor.give_up()
    else:
        return False
    return True
