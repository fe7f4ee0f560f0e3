"""The keys of the editor, and their lines in the help."""

from collections.abc import Callable, Mapping
from functools import partial
from typing import Protocol

import pygame

from sandbox.app.building.build_or_run_switch import BuildOrRunSwitch
from sandbox.app.building.current_tool import FIRST, CurrentTool
from sandbox.app.building.edited_level import EditedLevel
from sandbox.app.building.saving_and_reloading import Saving
from sandbox.app.building.tools.register import TOOLS
from sandbox.app.runs.session import Session
from sandbox.app.window_keys import CONTROL

ARROWS: Mapping[int, tuple[int, int]] = {
    pygame.K_LEFT: (-1, 0),
    pygame.K_RIGHT: (1, 0),
    pygame.K_UP: (0, 1),
    pygame.K_DOWN: (0, -1),
}

FINE = 0.1
"""The size of a nudge with Alt held, as a share of the usual one."""


def keys_in_help() -> tuple[tuple[str, str], ...]:
    """Return the keys and gestures of the page Build, and what they do."""
    return (
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
    """The editor, as far as the keys use it."""

    tools: CurrentTool
    trying: BuildOrRunSwitch
    saving: Saving

    @property
    def bench(self) -> EditedLevel:
        """The level or its run, whichever the tools change."""

    def resume_time(self) -> None:
        """Let time run again unless something is being drawn into the run."""


def press(editor: Keyed, event: pygame.event.Event, session: Session) -> bool:
    """Handle a pressed key, and return whether it has a meaning here."""
    if event.mod & CONTROL:
        return _with_control(editor, event, session)
    kind = next((k for k in TOOLS if event.unicode and k.key == event.unicode), None)
    if kind is not None:
        editor.tools.choose(kind.name)
        editor.resume_time()
        return True
    if editor.trying.is_shown(session):
        return _while_trying(editor, event, session)
    return _while_building(editor, event)


def _with_control(editor: Keyed, event: pygame.event.Event, session: Session) -> bool:
    shift, work = bool(event.mod & pygame.KMOD_SHIFT), editor.bench
    undo, redo = partial(editor.trying.undo, session), partial(editor.trying.redo, session)
    acts: Mapping[int, Callable[[], object]] = {
        pygame.K_z: redo if shift else undo,
        pygame.K_y: redo,
        pygame.K_s: editor.saving.save_as if shift else editor.saving.save,
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
        editor.trying.read_run_state(session)
    act()
    if event.key in (pygame.K_v, pygame.K_d):
        editor.tools.choose(FIRST)  # to drag the copy
    return True


def _while_trying(editor: Keyed, event: pygame.event.Event, session: Session) -> bool:
    """Change the run, or go back to building."""
    if event.key in (pygame.K_RETURN, pygame.K_KP_ENTER) and editor.tools.hand.busy:
        editor.tools.hand.finish()
    elif event.key == pygame.K_BACKSPACE and editor.tools.hand.busy:
        editor.tools.hand.cancel()
    elif event.key in (pygame.K_DELETE, pygame.K_BACKSPACE):
        editor.trying.read_run_state(session)
        editor.bench.delete()
    elif event.key == pygame.K_ESCAPE and editor.tools.tool == FIRST:
        editor.trying.back(session)
    elif event.key == pygame.K_ESCAPE and editor.tools.hand.busy:
        editor.tools.hand.cancel()
    elif event.key == pygame.K_ESCAPE:
        editor.tools.choose(FIRST)
    else:
        return False
    editor.resume_time()
    return True


def _while_building(editor: Keyed, event: pygame.event.Event) -> bool:
    if event.key in ARROWS:
        editor.bench.nudge(*ARROWS[event.key], FINE if event.mod & pygame.KMOD_ALT else 1.0)
    elif event.key in (pygame.K_RETURN, pygame.K_KP_ENTER):
        editor.tools.hand.finish()
    elif event.key == pygame.K_BACKSPACE and editor.tools.hand.busy:
        editor.tools.hand.cancel()
    elif event.key in (pygame.K_DELETE, pygame.K_BACKSPACE):
        editor.bench.delete()
    elif event.key == pygame.K_ESCAPE:
        editor.tools.give_up()
    else:
        return False
    return True
