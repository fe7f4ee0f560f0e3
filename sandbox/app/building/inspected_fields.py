"""The inspector's view of the selection, and the setting of fields."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from sandbox.app.building import editable_fields
from sandbox.app.building.button_action import ButtonAction
from sandbox.app.building.editable_fields import EditableField, Row
from sandbox.app.building.edited_level import EditedLevel
from sandbox.app.building.effect_examples import example
from sandbox.app.words.language import later, plural, say
from sandbox.editing import suggested_checks
from sandbox.editing.cleanup_after_edit import accepted
from sandbox.editing.edits import effects
from sandbox.editing.edits.automatic_title import entitled
from sandbox.editing.edits.checks_and_ghosts import quantity_completions
from sandbox.editing.edits.field_values import make_parameter, parameter_name, set_field
from sandbox.editing.edits.slope_angle_parameter import slope_of, tilt
from sandbox.editing.renaming import rename
from sandbox.editing.suggested_checks.recogniser_input import Suggestion
from sandbox.editing.text_patches import put, put_all, value_at
from sandbox.model.body import Body
from sandbox.model.errors import LevelError, SandboxError
from sandbox.model.joints import Joint
from sandbox.model.json_positions import Path
from sandbox.model.level import Level
from sandbox.model.level_parts import expressions
from sandbox.model.levels_with_changed_effects import DEFAULTS

NAMED = later("its name: a letter, then letters, digits or _; every mention of it changes, too")

ALIKE = (
    "type", "mass", "friction", "static_friction", "restitution", "sensor", "color", "hidden",
    "layer",
)  # fmt: skip
"""The fields that can be set for several bodies at once."""

MOST_NAMES = 6
"""The largest number of names offered while one is typed."""


def subject(work: EditedLevel) -> str:
    """Return a description of the inspected parts."""
    match work.selected:
        case ():
            return say("The level")
        case ((family, name),):
            part = work.document[family][name]
            kind = part["type"] if family == "joints" else part["shape"]["type"]
            return f"{name}: {say(kind)}"
        case several:
            return plural("{count} part", "{count} parts", len(several))


def rows(work: EditedLevel) -> Sequence[Row]:
    """Return the rows for the selection; for several bodies, those of fields they can share."""
    match work.selected:
        case () if not work.fixed:
            return editable_fields.rows(Level, work.document, ())
        case ((family, name),):
            part = work.document[family][name]
            model = Body if family == "bodies" else editable_fields.model_of(Joint, part)
            found = editable_fields.rows(model, part, (family, name)) if model else ()
            called = EditableField(
                (family, name), say("name"), say(NAMED), "", "text", name, required=True
            )
            return [(called,), *(row for row in found if _field(row) not in work.fixed)]
    several = len(work.selected_bodies) == len(work.selected) > 1
    return list(_alike(work)) if several and not work.fixed else ()


def _alike(work: EditedLevel) -> Iterator[Row]:
    """Yield the rows for fields that bodies can share; where they differ, a field is empty."""
    first, *others = (work.document["bodies"][name] for name in work.selected_bodies)
    for row in editable_fields.rows(Body, first, ("bodies", work.selected_bodies[0])):
        if (
            isinstance(row, editable_fields.Section)
            or len(row) > 1
            or (key := _field(row)) not in ALIKE
        ):
            continue
        if all(other.get(key) == first.get(key) for other in others):
            yield row
        elif row[0].input_kind not in ("choice", "switch"):
            yield (replace(row[0], shown=""),)


def _places(work: EditedLevel, path: Path) -> list[Path]:
    """Return the paths of a field: one in each body, if several are selected."""
    if len(work.selected) < 2:
        return [path]
    return [("bodies", name, *path[2:]) for name in work.selected_bodies]


def _field(row: Row) -> str | int:
    """Return the field of a body or a joint that a row sets."""
    return (row.path if isinstance(row, editable_fields.Section) else row[0].path)[2]


def assign(
    work: EditedLevel, row: Sequence[EditableField], entry: EditableField, typed: str
) -> str:
    """Set a field to a typed text; return the reason if that is impossible, else an empty text."""
    try:
        if len(entry.path) == 2 and entry.path[0] in ("bodies", "joints"):
            _rename(work, entry, typed.strip())
            return ""
        text = work.text
        for path in _places(work, entry.path):
            text = _assigned(text, row, replace(entry, path=path), typed)
        work.replace_text(text, say("set {field}", field=entry.label))
    except LevelError as error:
        return say(error.mistakes[0].rule)
    except SandboxError as error:
        return say(error.message)
    return ""


def _rename(work: EditedLevel, entry: EditableField, name: str) -> None:
    """Rename a body or a joint wherever it is mentioned; it stays selected."""
    family = str(entry.path[0])
    work.replace_text(
        rename(work.text, entry.path, name),
        say("call {before} {name}", before=entry.shown, name=name),
    )
    work.select([(family, name)])


def _assigned(text: str, row: Sequence[EditableField], entry: EditableField, typed: str) -> str:
    """Return the text with a new value; a point that was left out gets both coordinates."""
    if len(row) > 1 and not all(each.shown for each in row):
        whole = [float(each.default or 0) for each in row]
        text = put(text, entry.path[:-1], whole)
    return set_field(text, entry.path, typed)


def completions(work: EditedLevel, entry: EditableField, typed: str) -> list[str]:
    """Return the names that complete a typed text, the likeliest first."""
    level, begun = work.draft.level, typed.strip()
    if level is None or not begun:
        return []
    found = list[str]()
    if entry.names == "quantity":
        found = quantity_completions(level, begun)
    elif entry.names == "body":
        found = [name for name in level.bodies if begun.casefold() in name.casefold()]
    return [] if begun in found else found[:MOST_NAMES]


def numbers(work: EditedLevel) -> frozenset[Path]:
    """Return the paths of the numbers that can be made parameters, as they use no names yet."""
    if work.fixed or work.draft.level is None:
        return frozenset()
    return work.cached(_numbers)


def _numbers(level: Level) -> frozenset[Path]:
    return frozenset(path for path, expression in expressions(level) if not expression.names)


def parametrise(work: EditedLevel, entry: EditableField) -> None:
    """Turn a number into a parameter, which gets a slider on the level's page.

    For a slope or a body on it, the angle of both is replaced. Several selected bodies share the
    parameter.
    """

    def edit(text: str, level: Level) -> str:
        if entry.path[0] == "bodies" and entry.path[2:] == ("angle",):
            name = str(entry.path[1])
            if slope_of(level, name):
                return tilt(text, level, name)
        made = make_parameter(text, entry.path, parameter_name(level, entry.path))
        formula = value_at(made, entry.path)
        return accepted(put_all(made, dict.fromkeys(_places(work, entry.path), formula)))

    if work.change(say("make {field} a parameter", field=entry.label), edit):
        name = list(work.document["parameters"])[-1]
        message = later("'{name}' is a parameter now; its slider is on the level's page (O)")
        work.show_message(say(message, name=name))


def declared(work: EditedLevel) -> tuple[str, ...]:
    """Return the declared effects."""
    return tuple(work.document.get("effects", ()))


def switch(work: EditedLevel, effect: str) -> None:
    """Switch an effect on, with default settings, or off."""
    if effect in declared(work):
        caption = say("switch {effect} off", effect=say(effect))
        work.change(caption, lambda text, level: effects.drop(text, level, effect))
    else:
        caption = say("switch {effect} on", effect=say(effect))
        example = None if effect in DEFAULTS else _example(work, effect)
        work.change(caption, lambda text, level: effects.declare(text, level, effect, example))


def _example(work: EditedLevel, effect: str) -> Mapping[str, Any]:
    """Return example settings of an effect that requires some."""
    bodies = work.sketch.bodies.items()
    moving = [name for name, body in bodies if body.outline.is_dynamic]
    return example(effect, moving, [name for name, body in bodies if not body.outline.is_dynamic])


def suggestions(work: EditedLevel) -> list[ButtonAction]:
    """Return the actions that add the checks of the recognised set-ups."""
    if work.draft.level is None:
        return []
    return [
        ButtonAction(say(one.setup), say("add its checks"), partial(_take, work, one))
        for one in work.cached(suggested_checks.suggestions)
    ]


def _take(work: EditedLevel, one: Suggestion) -> None:
    title = say(one.setup)
    title = f"{title[:1].upper()}{title[1:]}"

    def edit(text: str, level: Level) -> str:
        return entitled(suggested_checks.with_suggestion(text, level, one), title)

    if work.change(say(one.setup), edit):
        work.show_message(
            say("Its checks are on the level's page (O); they are tested while it runs")
        )
