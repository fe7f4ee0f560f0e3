"""What moves with a body: bodies pinned to it, and the points of pins and rails."""

from collections.abc import Collection, Mapping

from sandbox.editing.bodies_at_start import PlacedBody, placed, xy
from sandbox.editing.formula_arithmetic import shifted
from sandbox.editing.inserted_value_layout import Json
from sandbox.editing.text_patches import Changes, put_all
from sandbox.model.comments import read_level
from sandbox.model.expressions import Expression
from sandbox.model.joint_ends_at_start import end_position
from sandbox.model.joints import End, Held, Motor, Pivot, Rail, Rod, bodies_of, body_of, ends_of
from sandbox.model.json_positions import Path
from sandbox.model.level import Level
from sandbox.model.shapes import evaluate

APART = 1e-12
"""m, the largest distance at which two points count as one."""


def pinned(level: Level, names: Collection[str]) -> set[str]:
    """Return some bodies, and all but static ones that are pinned to them, even indirectly."""
    found, pending = set(names), list(names)
    couples = [set(bodies_of(j)) for j in level.joints.values() if isinstance(j, Pivot | Motor)]
    while pending:
        one = pending.pop()
        others = set().union(*(couple for couple in couples if one in couple)) - found
        moving = {other for other in others if level.bodies[other].type != "static"}
        found |= moving
        pending += moving
    return found


def attached(text: str, before: Level, moved: Collection[str]) -> str:
    """Return a level in which pins and rails hold again after bodies were moved.

    The end at the plane, or at a body that stayed, follows the end that moved. If the length of a
    rod is a number, it becomes the new distance of its ends. The parts of the text are each valid
    by themselves; `before` is the level before bodies were moved, rotated or resized.
    """
    if all(set(bodies_of(joint)).isdisjoint(moved) for joint in before.joints.values()):
        return text
    level = read_level(text)
    values = level.defaults
    where = placed(level)
    changes = Changes()
    for name, joint in level.joints.items():
        if set(bodies_of(joint)).isdisjoint(moved):
            continue
        match joint:
            case Pivot() | Motor() | Rail():
                changes |= _held_again(("joints", name), joint, moved, level, where)
            case Rod(length=length) if length is not None and not length.names:
                a, b = (end_position(end, level.bodies, values) for end in joint.ends)
                changes["joints", name, "length"] = abs(b - a)
    return put_all(text, changes) if changes else text


def _held_again(
    path: Path,
    joint: Pivot | Motor | Rail,
    moved: Collection[str],
    level: Level,
    where: Mapping[str, PlacedBody],
) -> Changes:
    """Return the changes by which the end that stayed follows the other; none if both moved."""
    ends = sorted(ends_of(joint), key=lambda end: body_of(end[1]) in moved)
    (step, stays), (_, moves_to) = ends
    if body_of(stays) in moved:
        return {}
    values = next(iter(where.values())).values
    displacement = end_position(moves_to, level.bodies, values) - end_position(
        stays, level.bodies, values
    )
    if isinstance(joint, Rail):
        along = complex(*evaluate(joint.direction, values))
        displacement -= along * (displacement / along).real
    return (
        _shifted_end((*path, *step), stays, displacement, where)
        if abs(displacement) > APART
        else {}
    )


def _shifted_end(path: Path, end: End, by: complex, where: Mapping[str, PlacedBody]) -> Changes:
    match end:
        case str():
            at = xy(by / where[end].rotation)
            return {path: {"body": end, "at": list(at)}}
        case Held(body=body, at=at):
            return {(*path, "at"): shifted_point(at, by / where[body].rotation)}
    return {path: shifted_point(end, by)}


def shifted_point(point: tuple[Expression, Expression], by: complex) -> Json:
    """Return a point displaced by a vector."""
    return [shifted(coordinate, d) for coordinate, d in zip(point, xy(by), strict=True)]
