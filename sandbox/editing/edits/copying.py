"""Copying bodies with the joints among them, into the same level or another one."""

import json
from collections.abc import Collection, Mapping
from functools import reduce
from itertools import count
from typing import Any, cast

from pydantic import ValidationError

from sandbox.editing.attached_bodies import shifted_point
from sandbox.editing.cleanup_after_edit import without_meaning
from sandbox.editing.edits.edit_result import EditResult, new_name
from sandbox.editing.renaming import rename_numbers
from sandbox.editing.text_patches import Changes, put_all
from sandbox.model.comments import read_level
from sandbox.model.errors import SandboxError
from sandbox.model.expression_compiler import RESERVED
from sandbox.model.joints import Joint, Wire, bodies_of, body_of, ends_of
from sandbox.model.level import Level
from sandbox.model.level_parts import names_in
from sandbox.model.rules.consistency.references_by_name import mentions
from sandbox.model.shapes import XY, Point

Data = dict[str, Any]
"""A JSON object."""


def copy(text: str, level: Level, names: Collection[str]) -> str:
    """Return the text of a level that has only some bodies, and what belongs to them.

    Those are the joints that hold no other bodies, the groups, the level's constants, and the
    parameters that all of these use. Raises `SandboxError` if there are no bodies.
    """
    if not names:
        raise SandboxError("choose the bodies first")
    data = json.loads(text)
    joints = [
        name
        for name, joint in level.joints.items()
        if (joined := set(bodies_of(joint))) and joined <= set(names)
    ]
    parts = [level.bodies[name] for name in names], [level.joints[name] for name in joints]
    used = names_in((*parts[0], *parts[1], *level.constants.values()))
    groups = [list(group) for group in level.view.together if set(group) <= set(names)]
    return json.dumps(
        {
            "format": 1,
            "title": "copied",
            "parameters": {n: data["parameters"][n] for n in level.parameters if n in used},
            "constants": data.get("constants", {}),
            "bodies": {name: data["bodies"][name] for name in names},
            "joints": {name: data["joints"][name] for name in joints},
            "view": {"together": groups},
        },
        ensure_ascii=False,
    )


def paste(text: str, level: Level, copied: str, by: XY = (0.0, 0.0)) -> EditResult:
    """Return a level with displaced copies of bodies, under new names.

    Fields without a meaning in the level, such as friction if it is not declared, are left out.
    Parameters and constants keep their values: one that the level has, too, is shared if it is the
    same there, else its copy gets a new name. Raises `SandboxError` if the copied text is not a
    level.
    """
    try:
        source, data = read_level(copied), json.loads(copied)
    except ValidationError:
        raise SandboxError("what was copied is not part of a level") from None
    if numbers := _numbers_in_conflict(source, level):
        copied = rename_numbers(copied, source, numbers)
        source, data = read_level(copied), json.loads(copied)
    names = _new_names(source, level)
    changes = Changes()
    for name, body in source.bodies.items():
        position = shifted_point(body.position, complex(*by))
        changes["bodies", names[name]] = {**data["bodies"][name], "position": position}
    for name, joint in source.joints.items():
        joint_copy = _joint(joint, data["joints"][name], names, complex(*by))
        changes["joints", names[name]] = joint_copy
    for index, group in enumerate(source.view.together, start=len(level.view.together)):
        changes["view", "together", index] = [names[name] for name in group]
    for kind in ("parameters", "constants"):
        for name in getattr(source, kind).keys() - getattr(level, kind).keys():
            changes[kind, name] = data[kind][name]
    pasted = without_meaning(put_all(text, changes))
    return EditResult(pasted, tuple(names[name] for name in source.bodies))


def duplicate(text: str, level: Level, names: Collection[str], by: XY) -> EditResult:
    """Return a level with displaced duplicates of bodies."""
    return paste(text, level, copy(text, level, names), by)


def _new_names(source: Level, level: Level) -> Mapping[str, str]:
    """Return the names of the copies: `left` becomes `left1`, and `box1` the next free name."""
    names = dict[str, str]()
    for name in (*source.bodies, *source.joints):
        names[name] = new_name(name.rstrip("0123456789")[:28], level, besides=names.values())
    return names


def _numbers_in_conflict(source: Level, level: Level) -> Mapping[str, str]:
    """Return new names for parameters and constants that are something else in a level."""
    own_names = level.parameters.keys() | level.constants.keys()
    numbers = (*source.parameters, *source.constants)
    others = {name for name in numbers if name in own_names and not _same(name, source, level)}
    while using := {
        name
        for name, formula in source.constants.items()
        if name in own_names and name not in others and not others.isdisjoint(formula.names_written)
    }:
        others |= using
    taken = own_names | source.parameters.keys() | source.constants.keys() | RESERVED
    names = dict[str, str]()
    for name in sorted(others):
        stem = name.rstrip("0123456789")[:28]
        free = (f"{stem}{number}" for number in count(1))
        names[name] = next(one for one in free if one not in taken | set(names.values()))
    return names


def _same(name: str, one: Level, other: Level) -> bool:
    """Return whether two levels have the same parameter or constant of a name."""
    if name in one.constants and name in other.constants:
        return one.constants[name].source == other.constants[name].source
    a, b = one.parameters.get(name), other.parameters.get(name)
    return a is not None and b is not None and (a.value, a.unit) == (b.value, b.unit)


def _joint(joint: Joint, document: Data, names: Mapping[str, str], by: complex) -> Data:
    """Return the fields of a copied joint."""
    for path, body, _ in mentions(joint):
        _inside(document, path[:-1])[path[-1]] = names[body]
    for path, end in ends_of(joint):
        if body_of(end) is None:
            _inside(document, path[:-1])[path[-1]] = shifted_point(cast("Point", end), by)
    if isinstance(joint, Wire):
        document["curve"] = shifted_point(joint.curve, by)
    return document


def _inside(document: Data, path: tuple[str | int, ...]) -> Any:  # noqa: ANN401 (an object or a list)
    return reduce(lambda part, step: part[step], path, cast("Any", document))
