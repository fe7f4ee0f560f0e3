"""Actions on a single selected part, besides setting its fields."""

from collections.abc import Callable, Iterator
from functools import partial

from sandbox.app.building.button_action import ButtonAction
from sandbox.app.building.editable_fields import EditableField
from sandbox.app.building.edited_level import EditedLevel
from sandbox.app.building.inspected_fields import parametrise
from sandbox.app.words.language import later, say
from sandbox.editing.edits import events
from sandbox.editing.edits.checks_and_ghosts import flight, set_ghost
from sandbox.editing.edits.pendulum_angle_parameter import peg_of, swing
from sandbox.editing.edits.resizing import ROUND, rounded
from sandbox.editing.edits.slope_angle_parameter import slope_of
from sandbox.model.level import Level

AS_A: dict[str, tuple[str, str]] = {
    "disc": (later("As a disc"), later("solid, touched from outside")),
    "hoop": (later("As a hoop"), later("hollow: what is within it touches its inner side")),
    "arc": (later("As an arc"), later("a part of a circle that stands still, from start to end")),
}
"""The captions and tooltips of the shapes into which a round body can be changed."""


def part_actions(work: EditedLevel) -> list[ButtonAction]:
    """Return the actions on the selected part; none if several are selected."""
    level = work.draft.level
    if level is None or len(work.selected) != 1:
        return []
    ((family, name),) = work.selected
    return list((_of_joint if family == "joints" else _of_body)(work, level, name))


def _of_joint(work: EditedLevel, level: Level, name: str) -> Iterator[ButtonAction]:
    if not events.is_cut(level, name):
        tip = say("an event releases it at a time, or when a quantity crosses a value")
        cut = partial(_happen, work, say("cut {name} in the run", name=name), events.cut, name)
        yield ButtonAction(say("Cut it in the run"), tip, cut)


def _of_body(work: EditedLevel, level: Level, name: str) -> Iterator[ButtonAction]:
    body = level.bodies[name]
    if body.one_way is not None:
        tip = say("an event reverses its direction, at a time or when a quantity crosses a value")
        undo_caption = say("reverse {name} in the run", name=name)
        reverse = partial(_happen, work, undo_caption, events.reverse, name)
        yield ButtonAction(say("Reverse it in the run"), tip, reverse)
    if (slope := slope_of(level, name)) and not level.bodies[slope].angle.names:
        tip = say("its angle becomes a parameter; what lies on it turns with it")
        yield ButtonAction(say("Slider for the slope"), tip, partial(_tilt, work, name))
    if body.type == "dynamic" and peg_of(level, name) is not None:
        tip = say(
            "draws it aside; its angle becomes a parameter, and its rod or rope keeps its length"
        )
        yield ButtonAction(say("Slider for the swing"), tip, partial(_swing, work, name))
    if body.type == "dynamic" and name not in level.ghosts:
        tip = say(
            "shows where a formula puts the body: in free flight, until you type another formula"
        )
        yield ButtonAction(say("Add a ghost"), tip, partial(_haunt, work, name))
    if body.shape.type in ROUND:
        for kind in ROUND:
            if kind != body.shape.type:
                caption, text = AS_A[kind]
                yield ButtonAction(say(caption), say(text), partial(_round, work, name, kind))


def _happen(
    work: EditedLevel, caption: str, edit: Callable[[str, Level, str], str], name: str
) -> None:
    """Add an event that acts on a part."""
    if work.change(caption, lambda text, level: edit(text, level, name)):
        work.show_message(
            say("Set when that happens in the level's own fields, under events (Esc)")
        )


def _tilt(work: EditedLevel, name: str) -> None:
    parametrise(
        work, EditableField(("bodies", name, "angle"), say("angle"), "", "rad", "number", "")
    )


def _swing(work: EditedLevel, name: str) -> None:
    caption = say("draw {name} aside", name=name)
    if work.change(caption, lambda text, level: swing(text, level, name)):
        work.show_message(
            say("Its angle is a parameter now; its slider is on the level's page (O)")
        )


def _round(work: EditedLevel, name: str, kind: str) -> None:
    caption = say("make {name} another shape", name=name)
    work.add_parts(caption, lambda text, level: rounded(text, level, name, kind))


def _haunt(work: EditedLevel, name: str) -> None:
    def edit(text: str, level: Level) -> str:
        return set_ghost(text, name, flight(level, name))

    if work.change(say("add a ghost of {name}", name=name), edit):
        work.show_message(say("Its formulas are in the level's own fields, under ghosts (Esc)"))
