"""What moves along with a body: bodies pinned to it, and the points that pins hold."""

from collections.abc import Collection, Mapping

from sandbox.editing.formulas import shifted
from sandbox.editing.json_layout import Json
from sandbox.editing.placement import Placed, placed, xy
from sandbox.editing.text_patches import Changes, put_all
from sandbox.model.expressions import Expression
from sandbox.model.joint_ends import place
from sandbox.model.joints import (
    End,
    Held,
    Motor,
    Pivot,
    Rail,
    Rod,
    bodies_of,
    body_of,
    ends_of,
)
from sandbox.model.json_positions import Path
from sandbox.model.level import Level
from sandbox.model.shapes import evaluate

APART = 1e-12
"""m, the distance below which two points count as one."""


def pinned(level: Level, names: Collection[str]) -> set[str]:
    """Return some bodies, and whatever moves and is pinned to them, however far around."""
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
    """Return a level in which pins and rails hold again, after bodies were moved.

    The point of the plane, or of a body that stayed, follows the one that moved. A rod whose
    length is a number is as long as its ends are apart now.

    Parameters
    ----------
    text
        In which every part is well formed by itself.
    before
        The level as it was.
    moved
        The bodies that were moved, turned or made larger.
    """
    if all(set(bodies_of(joint)).isdisjoint(moved) for joint in before.joints.values()):
        return text
    level = Level.model_validate_json(text)
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
                a, b = (place(end, level.bodies, values) for end in joint.ends)
                changes["joints", name, "length"] = abs(b - a)
    return put_all(text, changes) if changes else text


def _held_again(
    path: Path,
    joint: Pivot | Motor | Rail,
    moved: Collection[str],
    level: Level,
    where: Mapping[str, Placed],
) -> Changes:
    """Return how the end that stayed follows the one that was moved; nothing if both were."""
    ends = sorted(ends_of(joint), key=lambda end: body_of(end[1]) in moved)
    (step, stays), (_, goes) = ends
    if body_of(stays) in moved:
        return {}
    values = next(iter(where.values())).values
    way = place(goes, level.bodies, values) - place(stays, level.bodies, values)
    if isinstance(joint, Rail):
        along = complex(*evaluate(joint.direction, values))
        way -= along * (way / along).real
    return _shifted_end((*path, *step), stays, way, where) if abs(way) > APART else {}


def _shifted_end(path: Path, end: End, by: complex, where: Mapping[str, Placed]) -> Changes:
    match end:
        case str():
            at = xy(by / where[end].turn)
            return {path: {"body": end, "at": list(at)}}
        case Held(body=body, at=at):
            return {(*path, "at"): shifted_point(at, by / where[body].turn)}
    return {path: shifted_point(end, by)}


def shifted_point(point: tuple[Expression, Expression], by: complex) -> Json:
    """Return a point that lies elsewhere, coordinate by coordinate."""
    return [shifted(coordinate, d) for coordinate, d in zip(point, xy(by), strict=True)]
