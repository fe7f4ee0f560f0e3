"""What the inspector shows of the work, and how it is set."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any, Literal

from sandbox.app.building import fields
from sandbox.app.building.act import Act
from sandbox.app.building.examples import example
from sandbox.app.building.fields import Entry, Row
from sandbox.app.building.work import Work
from sandbox.editing import suggest
from sandbox.editing.edits import effects, transforms
from sandbox.editing.edits.checks import add_checks, complete, drop_told, flight, set_ghost
from sandbox.editing.edits.fields import make_parameter, parameter_name, set_field
from sandbox.editing.edits.mirroring import mirror
from sandbox.editing.edits.transforms import Side
from sandbox.editing.patches import put
from sandbox.editing.renaming import rename
from sandbox.editing.snapping import flat_turn, snap_body
from sandbox.editing.suggest.scene import Suggestion
from sandbox.model.errors import LevelError, SandboxError
from sandbox.model.joints import Joint
from sandbox.model.level import Body, Level
from sandbox.model.loading import parse
from sandbox.model.locating import Path
from sandbox.model.parts import expressions
from sandbox.model.variants import DEFAULTS

NAMED = "what it is called: a letter, then letters, digits or _; all mentions of it follow"

NEAR = 80.0
"""px, how near something must be for a body to be laid flat on it."""

MOST_NAMES = 6
"""How many names are offered while one is typed."""

MOST_TOLD = 12
"""How many checks have a button that takes them out, and how many ghosts."""

SIDES: Mapping[str, Side] = {
    "Left": "left",
    "Right": "right",
    "Top": "top",
    "Bottom": "bottom",
    "Above": "center-x",
    "In line": "center-y",
}
"""What bodies are aligned at, by what stands on the buttons."""


def subject(work: Work) -> str:
    """Return what is inspected, in words."""
    match work.selected:
        case ():
            return "The level"
        case ((family, name),):
            said = work.document[family][name]
            return f"{name}: {said['type'] if family == 'joints' else said['shape']['type']}"
        case several:
            return f"{len(several)} parts"


def rows(work: Work) -> Sequence[Row]:
    """Return what can be set of what is inspected; of several parts nothing can."""
    match work.selected:
        case () if not work.fixed:
            return fields.rows(Level, work.document, ())
        case ((family, name),):
            said = work.document[family][name]
            model = Body if family == "bodies" else fields.model_of(Joint, said)
            found = fields.rows(model, said, (family, name)) if model else ()
            called = Entry((family, name), "name", NAMED, "", "text", name, required=True)
            return [(called,), *(row for row in found if _field(row) not in work.fixed)]
    return ()


def _field(row: Row) -> str | int:
    """Return the field of a body or a joint that a row sets."""
    return (row.path if isinstance(row, fields.Section) else row[0].path)[2]


def assign(work: Work, row: Sequence[Entry], entry: Entry, typed: str) -> str:
    """Set an entry of a row to what was typed; return why that cannot be, or nothing."""
    try:
        if len(entry.path) == 2 and entry.path[0] in ("bodies", "joints"):
            _rename(work, entry, typed.strip())
            return ""
        work.put(_assigned(work.text, row, entry, typed), f"set {entry.label}")
    except LevelError as error:
        return error.mistakes[0].rule
    except SandboxError as error:
        return str(error)
    return ""


def _rename(work: Work, entry: Entry, name: str) -> None:
    """Call a body or a joint otherwise, wherever it is mentioned; it stays selected."""
    family = str(entry.path[0])
    work.put(rename(work.text, entry.path, name), f"call {entry.shown} {name}")
    work.select([(family, name)])


def _assigned(text: str, row: Sequence[Entry], entry: Entry, typed: str) -> str:
    """Return the text with another value; of a point that is not said both halves are."""
    if len(row) > 1 and not all(each.shown for each in row):
        whole = [float(each.default or 0) for each in row]
        text = put(text, entry.path[:-1], whole)
    return set_field(text, entry.path, typed)


def completions(work: Work, entry: Entry, typed: str) -> list[str]:
    """Return the names that what was typed into a field may become, the likeliest first."""
    level, begun = work.draft.level, typed.strip()
    if level is None or not begun:
        return []
    found = list[str]()
    if entry.names == "quantity":
        found = complete(level, begun)
    elif entry.names == "body":
        found = [name for name in level.bodies if begun.casefold() in name.casefold()]
    return [] if begun in found else found[:MOST_NAMES]


def numbers(work: Work) -> frozenset[Path]:
    """Return what can be made a parameter: what is said, and is no formula of others yet."""
    if work.fixed or work.draft.level is None:
        return frozenset()
    return work.once(_numbers)


def _numbers(level: Level) -> frozenset[Path]:
    return frozenset(path for path, expression in expressions(level) if not expression.names)


def parametrise(work: Work, entry: Entry) -> None:
    """Make a number a parameter, of which the level's page has a slider."""

    def edit(text: str, level: Level) -> str:
        if not entry.shown:
            raise SandboxError(f"type a number for '{entry.label}' first")
        return make_parameter(text, entry.path, parameter_name(level, entry.path))

    if work.change(f"make {entry.label} a parameter", edit):
        name = list(work.document["parameters"])[-1]
        work.tell(f"'{name}' is a parameter now; its slider is on the level's page (O)")


def declared(work: Work) -> tuple[str, ...]:
    """Return the effects that act."""
    return tuple(work.document.get("effects", ()))


def switch(work: Work, effect: str) -> None:
    """Let an effect act, as it is tried where nothing is said of it, or act no more."""
    if effect in declared(work):
        work.change(f"switch {effect} off", lambda text, level: effects.drop(text, level, effect))
    else:
        said = None if effect in DEFAULTS else _example(work, effect)
        work.change(
            f"switch {effect} on", lambda text, level: effects.declare(text, level, effect, said)
        )


def _example(work: Work, effect: str) -> Mapping[str, Any]:
    """Return an example of an effect that must be told what it is."""
    bodies = work.sketch.bodies.items()
    moving = [name for name, body in bodies if body.outline.heavy]
    return example(effect, moving, [name for name, body in bodies if not body.outline.heavy])


def suggestions(work: Work) -> list[Act]:
    """Return the set-ups that are recognised, and what adds their checks."""
    if work.draft.level is None:
        return []
    return [
        Act(one.setup, "add its checks", partial(_take, work, one))
        for one in work.once(suggest.suggestions)
    ]


def _take(work: Work, one: Suggestion) -> None:
    if work.change(one.setup, lambda text, level: suggest.take(text, level, one)):
        work.tell("Its checks are on the level's page (O), and hold while it runs")


def told(work: Work) -> list[Act]:
    """Return what adds a check, and what takes out those that there are, and ghosts."""
    if work.draft.level is None:
        return []
    level = work.level
    moving = [name for name, body in level.bodies.items() if body.type == "dynamic"]
    adding = [
        Act("Add a check", "of any quantity; its fields are below", partial(_check, work, name))
        for name in moving[:1]
    ]
    checks = [
        Act(f"− {check.quantity}", "take this check out", partial(_drop, work, "checks", index))
        for index, check in enumerate(level.checks)
    ]
    ghosts = [
        Act(f"− ghost of {name}", "take this ghost out", partial(_drop, work, "ghosts", name))
        for name in level.ghosts
    ]
    return [*adding, *checks[:MOST_TOLD], *ghosts[:MOST_TOLD]]


def _check(work: Work, body: str) -> None:
    new = {"quantity": f"{body}.position.x", "formula": "0", "tolerance": 1e-3}
    if work.change("add a check", lambda text, level: add_checks(text, level, [new])):
        work.tell("Its quantity and its formula are below, under checks")


def _drop(work: Work, part: Literal["checks", "ghosts"], which: int | str) -> None:
    work.change(f"take out a {part[:-1]}", lambda text, _: drop_told(text, part, which))


def ghost(work: Work) -> list[Act]:
    """Return what gives the body that is selected a ghost, which flies as if nothing met it."""
    level = work.draft.level
    match work.selected:
        case (("bodies", name),) if level is not None and name not in level.ghosts:
            if level.bodies[name].type == "dynamic":
                tip = "where a formula says that it is; it flies freely until you type another one"
                return [Act("Add a ghost", tip, partial(_haunt, work, name))]
    return []


def _haunt(work: Work, name: str) -> None:
    def edit(text: str, level: Level) -> str:
        return set_ghost(text, name, flight(level, name))

    if work.change(f"add a ghost of {name}", edit):
        work.tell("Its formulas are in the level's own fields, under ghosts (Esc)")


def arrangements(work: Work) -> list[Act]:
    """Return what can be done with several bodies at once."""
    names = work.chosen
    if not names:
        return []
    several = [
        *(
            _arranging(work, caption, f"align: {side}", partial(_align, names, side))
            for caption, side in SIDES.items()
        ),
        _arranging(
            work, "Spread across", "the same gaps, from left to right", partial(_spread, names, "x")
        ),
        _arranging(work, "Spread upwards", "the same gaps, upwards", partial(_spread, names, "y")),
    ]
    flat = [] if len(names) > 1 else [_flat(work, names[0])]
    return [
        *_grouping(work, names),
        *(several if len(names) > 1 else flat),
        _arranging(work, "Mirror across", "left becomes right", partial(_mirror, names, "x")),
        _arranging(work, "Mirror upright", "top becomes bottom", partial(_mirror, names, "y")),
    ]


def _grouping(work: Work, names: Sequence[str]) -> list[Act]:
    """Return what makes bodies a group, and what takes apart the groups that they are in."""
    found = [work.with_group(("bodies", name)) for name in names]
    grouped = any(len(group) > 1 for group in found)
    one = grouped and {part[1] for part in found[0]} == set(names)
    return [
        *(
            []
            if one or len(names) < 2
            else [Act("Group", "select them together (Ctrl G)", work.group)]
        ),
        *(
            [Act("Ungroup", "select each by itself (Ctrl Shift G)", work.ungroup)]
            if grouped
            else []
        ),
    ]


def _flat(work: Work, name: str) -> Act:
    tip = "turn and move it so that a side of it lies on what is nearest"
    return _arranging(work, "Lay flat", tip, partial(_lay_flat, name, NEAR / work.camera.scale))


def _lay_flat(name: str, reach: float, text: str, level: Level) -> str:
    turned = transforms.turn(text, level, [name], flat_turn(level, name, reach))
    lying = parse(turned)
    found = snap_body(lying, [name], (0.0, 0.0), reach)
    if found.kind != "contact":
        raise SandboxError(f"nothing that '{name}' could lie on is near; move it closer")
    return transforms.move(turned, lying, [name], found.point)


def _arranging(work: Work, caption: str, tip: str, edit: Callable[[str, Level], str]) -> Act:
    return Act(caption, tip, lambda: work.change(caption.casefold(), edit))


def _align(names: Sequence[str], side: Side, text: str, level: Level) -> str:
    return transforms.align(text, level, names, side)


def _spread(names: Sequence[str], axis: Literal["x", "y"], text: str, level: Level) -> str:
    return transforms.distribute(text, level, names, axis)


def _mirror(names: Sequence[str], axis: Literal["x", "y"], text: str, level: Level) -> str:
    return mirror(text, level, names, axis)
