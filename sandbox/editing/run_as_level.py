"""A run as a level that starts from the present state.

Whatever the original level derives from its start keeps its value: a rod without a length gets the
length that it had, and a force that depends on time continues from the present time. The closed
forms hold for the original start only, and are left out.
"""

import json
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from sandbox.editing.cleanup_after_edit import without_meaning
from sandbox.editing.formula_arithmetic import renamed
from sandbox.editing.inserted_value_layout import plain as rounded
from sandbox.editing.written_out_shorthand import expanded
from sandbox.model import level_writing
from sandbox.model.body import Body
from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Expression, Values
from sandbox.model.joint_ends_at_start import span
from sandbox.model.joints import Pulley, Rod, Rope, Spring, Weld, Winding
from sandbox.model.level import Level
from sandbox.model.level_parts import expressions, names_in
from sandbox.model.loading import parse
from sandbox.model.parameters_changeable_in_run import obstacle
from sandbox.model.shapes import evaluate
from sandbox.physics.stepping.world import World

Data = dict[str, Any]

TOLD = ("checks", "ghosts", "challenge")
"""The parts of a level that describe a run from the level's own start."""

MOVES = ("position", "angle", "velocity", "angular_velocity")
"""The fields of a body that change while it runs."""


def as_it_stands(world: World, *, anew: bool) -> str:
    """Return a level that starts from the present state of a run, with the parameters of the run.

    If `anew`, time starts at 0 in the new level: formulas are then shifted in time. If not, the
    level continues the run from its present time, and numbers have all their digits. Raises
    `SandboxError` if no level can start from this state.
    """
    _refuse(world)
    if world.scene.event_times or (anew and world.level.events):
        raise SandboxError("no level can start between its events")
    if not anew:
        _refuse_to_begin_late(world.level)
    level, values = world.level, world.values
    data: Data = json.loads(expanded(level.text))
    for part in TOLD:
        data.pop(part, None)
    _fix(data, level, values, keep=not anew)
    for row, (name, body) in enumerate(level.bodies.items()):
        _put(data["bodies"][name], body, values, _state(world, row), keep=not anew)
    for name, length in _lengths(level, values):
        data["joints"][name]["length"] = length
    if not anew:  # not read by people, so it needs no layout
        return _without_unused(json.dumps(data, ensure_ascii=False), level)
    _begin_later(data, level, world)
    return _without_unused(level_writing.text(data), level)


def _fix(data: Data, level: Level, values: Values, *, keep: bool) -> None:
    """Set the parameters; those on which positions and shapes depend become constants."""
    fixed = dict[str, float]()
    for name, value in values.items():
        if obstacle(level, [name]):
            fixed[name] = value if keep else rounded(value)
            del data["parameters"][name]
        elif value != level.defaults[name]:
            data["parameters"][name]["value"] = value
    if fixed:
        data["constants"] = {**fixed, **data.get("constants", {})}


def _without_unused(text: str, level: Level) -> str:
    """Return a level without parameters and constants that are no longer used.

    A `LevelError` says what else would go: a body, a joint or an effect.
    """
    found = without_meaning(text)
    data = json.loads(found)
    present = level.bodies, level.joints, level.effects.declared
    for before, part in zip(present, ("bodies", "joints", "effects"), strict=True):
        if not set(before) <= data.get(part, {}).keys():
            parse(text)
    return found


def _refuse(world: World) -> None:
    """Refuse changed masses, bodies that stuck together, and a slack string on a wheel."""
    level = world.level
    flows = [e for e, _, _ in level.effects.settings if e.changes_mass]
    if flows:
        raise SandboxError(
            "'{name}' has changed masses, and no level can start from that", name=flows[0].name
        )
    welds = sum(isinstance(joint, Weld) for joint in level.joints.values())
    if len(world.scene.joints.joined) > welds:
        raise SandboxError("bodies have stuck together, and no level can start from that")
    for row, (name, joint) in enumerate(level.joints.items()):
        if isinstance(joint, Winding) and world.snapshot.tension[row] == 0 and world.steps:
            raise SandboxError(
                "'{name}' is slack, and no level can give its unwound length then; wait until"
                " it is taut",
                name=name,
            )


def _refuse_to_begin_late(level: Level) -> None:
    """Refuse rods whose length is a formula of time, since a run starts with the initial length."""
    for name, joint in level.joints.items():
        if isinstance(joint, Rod) and "t" in names_in(joint):
            raise SandboxError(
                "the length of '{name}' is a formula of time; keep the run as a level, and"
                " continue there",
                name=name,
            )


def _state(world: World, row: int) -> Mapping[str, list[float] | float]:
    now = world.snapshot
    return {
        "position": now.position[row].tolist(),
        "angle": float(now.angle[row]),
        "velocity": now.velocity[row].tolist(),
        "angular_velocity": float(now.angular_velocity[row]),
    }


def _put(
    written: Data,
    body: Body,
    values: Values,
    state: Mapping[str, list[float] | float],
    *,
    keep: bool,
) -> None:
    """Write the state of a body into its fields; unchanged fields stay as they were typed.

    A body that follows formulas is left unchanged, unless time starts at 0.
    """
    if body.type == "static" or (keep and body.motion is not None):
        return
    fields = MOVES if body.motion is None else MOVES[:2]
    for field in fields:
        if state[field] != _values_of(getattr(body, field), values):
            written[field] = state[field] if keep else _rounded(state[field])


def _values_of(
    expression: Expression | tuple[Expression, Expression], values: Values
) -> list[float] | float:
    """Return the value of a field of a level."""
    return (
        list(evaluate(expression, values)) if isinstance(expression, tuple) else expression(values)
    )


def _rounded(value: list[float] | float) -> list[float] | float:
    return [rounded(each) for each in value] if isinstance(value, list) else rounded(value)


def _lengths(level: Level, values: Values) -> Iterable[tuple[str, float]]:
    """Yield the initial lengths of the joints for which the level gives no length."""
    for name, joint in level.joints.items():
        if isinstance(joint, Rod | Rope | Pulley | Spring) and joint.length is None:
            yield name, span(joint, level.bodies, values)


def _begin_later(data: Data, level: Level, world: World) -> None:
    """Shift all formulas of time by the present time of the run."""
    t = world.t
    moved = ("effects", "bodies", "joints")
    timed = ((p, e) for part in moved for p, e in expressions(getattr(level, part), (part,)))
    for path, expression in timed:
        if "t" not in expression.names:
            continue
        later = renamed(str(expression.source), "t", f"(t + {rounded(t)!r})")
        if path[0] == "bodies" and path[2] == "motion":  # relative to its start
            later = f"{later} - ({expression({**world.values, 't': t})!r})"
        _set(data, path, later)


def _set(data: Data, path: Sequence[str | int], value: str) -> None:
    part: Any = data
    for step in path[:-1]:
        part = part[step]
    part[path[-1]] = value
