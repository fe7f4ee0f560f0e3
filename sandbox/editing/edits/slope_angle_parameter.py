"""Making the angle of a slope a parameter; bodies on it turn with it, about its lower end.

A position is then a sum such as `-4 + 2*cos(angle*deg) - 0.5*sin(angle*deg)`.
"""

from cmath import phase, rect
from collections.abc import Collection, Mapping
from math import degrees, pi
from typing import NamedTuple

from sandbox.editing.bodies_at_start import PlacedBody, distance, placed, xy
from sandbox.editing.cleanup_after_edit import accepted
from sandbox.editing.edits.field_values import parameter_name
from sandbox.editing.formula_arithmetic import rounded, sum_of
from sandbox.editing.inserted_value_layout import Json, plain
from sandbox.editing.text_patches import Changes, put_all
from sandbox.model.errors import SandboxError
from sandbox.model.joints import bodies_of, body_of, ends_of
from sandbox.model.level import Level
from sandbox.model.level_parts import names_in
from sandbox.model.shapes import Segment, evaluate

TOUCHING = 1e-6
"""m, the largest gap at which bodies touch."""

LEVEL = 1e-6
"""rad, the largest angle at which a surface counts as horizontal, not as a slope."""

FLAT = 1e-7
"""deg, the largest difference of angles at which a body lies flat on a slope."""

RANGES = ((5, 60), (0, 90))
"""deg, possible ranges of the slider; the first that contains the slope is used."""


class _Tilt(NamedTuple):
    """A slope that turns about its lower end."""

    foot: complex  # m
    angle: float  # rad, the present angle; negative if the slope rises to the left
    formula: str
    name: str  # the name of the parameter

    def along_and_normal(self, point: complex) -> complex:
        """Return the coordinates of a point along and normal to the slope [m]."""
        return (point - self.foot) / rect(1, self.angle)

    def vector(self, local: complex, start: complex = 0j) -> list[Json]:
        """Return the formulas of a vector given along and normal to the slope, added to a start."""
        sign = -1 if self.formula.startswith("-") else 1
        cos, sin = (f"{function}({self.name}*deg)" for function in ("cos", "sin"))
        x = {"": start.real, cos: local.real, sin: -sign * local.imag}
        y = {"": start.imag, cos: local.imag, sin: sign * local.real}
        return [sum_of(x), sum_of(y)]

    def angle_formula(self, angle: float) -> str:
        """Return the formula for the angle of a body that turns with the slope [rad]."""
        more = rounded(degrees(angle - self.angle))
        if abs(more) < FLAT:
            return self.formula
        return f"{self.formula} {'-' if more < 0 else '+'} {plain(abs(more))!r}*deg"


def slope_of(level: Level, name: str) -> str | None:
    """Return a body that is a slope, or the slope on which it lies; None if there is none.

    A slope is a static segment. A horizontal one counts only if it is the body itself.
    """
    where = placed(level)
    if _is_straight(where[name]):
        return name
    if where[name].body.type != "dynamic":
        return None
    under = (one for one in where.values() if _is_straight(one) and _rises(one))
    return next((one.name for one in under if distance(where[name], one) < TOUCHING), None)


def tilt(text: str, level: Level, name: str) -> str:
    """Return a level in which the angle of a slope is a parameter; bodies on it turn with it.

    So do the points of the plane to which only such bodies are tied. The name is that of the slope,
    or of a body on it. Raises `SandboxError` if there is no slope, or a position or an angle is a
    formula already.
    """
    slope = slope_of(level, name)
    if slope is None:
        raise SandboxError("'{name}' is neither a slope nor on one", name=name)
    where = placed(level)
    moved = _lying_on(where, slope)
    for one in (slope, *moved):
        _refuse_formulas(level, one)
    found = _tilt(where[slope], parameter_name(level, ("bodies", slope, "angle")))
    changes = _line(where[slope], found)
    for one in moved:
        changes |= _turned(where[one], found)
    changes |= _tied(level, where, {slope, *moved}, found)
    value = plain(rounded(abs(degrees(found.angle))))
    parameters: list[dict[str, Json]] = [
        {"value": value, "min": low, "max": high, "unit": "deg", "label": f"angle of {slope}"}
        for low, high in (*RANGES, (value, value))
        if low <= value <= high
    ]
    path = ("parameters", found.name)
    return accepted(*(put_all(text, {**changes, path: one}) for one in parameters))


def _is_straight(one: PlacedBody) -> bool:
    return isinstance(one.body.shape, Segment) and one.body.type == "static"


def _rises(one: PlacedBody) -> bool:
    start, end = one.corners
    return LEVEL < abs(phase(end - start)) < pi - LEVEL


def _lying_on(where: Mapping[str, PlacedBody], slope: str) -> list[str]:
    """Return the dynamic bodies that touch a slope, directly or through others."""
    found, pending = list[str](), [slope]
    while pending:
        under = where[pending.pop()]
        for one in where.values():
            free = one.body.type == "dynamic" and one.name not in found
            if free and distance(one, under) < TOUCHING:
                found.append(one.name)
                pending.append(one.name)
    return found


def _refuse_formulas(level: Level, name: str) -> None:
    body = level.bodies[name]
    placing = (body.position, body.angle, body.velocity)
    if names_in(placing) or (isinstance(body.shape, Segment) and names_in((body.shape,))):
        raise SandboxError("the position of '{name}' is already a formula", name=name)


def _tilt(slope: PlacedBody, name: str) -> _Tilt:
    foot, top = sorted(slope.corners, key=lambda corner: (corner.imag, corner.real))
    vector = top - foot
    if vector.real < 0:
        return _Tilt(foot, phase(-vector), f"-{name}*deg", name)
    return _Tilt(foot, phase(vector), f"{name}*deg", name)


def _line(slope: PlacedBody, tilted: _Tilt) -> Changes:
    """Return the changes that make a slope a segment of its own x axis, from its lower end."""
    path = ("bodies", slope.name)
    along = (rounded(tilted.along_and_normal(corner).real) for corner in slope.corners)
    start, end = ([plain(x), 0] for x in along)
    return {
        (*path, "shape", "start"): start,
        (*path, "shape", "end"): end,
        (*path, "position"): [plain(rounded(x)) for x in xy(tilted.foot)],
        (*path, "angle"): tilted.formula,
    }


def _turned(one: PlacedBody, tilted: _Tilt) -> Changes:
    """Return the changes that let a body turn with its slope."""
    path, body = ("bodies", one.name), one.body
    changes: Changes = {
        (*path, "position"): tilted.vector(tilted.along_and_normal(one.center), tilted.foot),
        (*path, "angle"): tilted.angle_formula(body.angle(one.values)),
    }
    if velocity := complex(*evaluate(body.velocity, one.values)):
        changes[*path, "velocity"] = tilted.vector(velocity / rect(1, tilted.angle))
    return changes


def _tied(
    level: Level, where: Mapping[str, PlacedBody], moved: Collection[str], tilted: _Tilt
) -> Changes:
    """Return the changes of the points of the plane to which only moved bodies are tied."""
    values, changes = next(iter(where.values())).values, Changes()
    for name, joint in level.joints.items():
        joined = set(bodies_of(joint))
        if not joined or not joined <= set(moved):
            continue
        for step, end in ends_of(joint):
            if body_of(end) is None and isinstance(end, tuple) and not names_in(end):
                point = complex(*evaluate(end, values))
                place = tilted.vector(tilted.along_and_normal(point), tilted.foot)
                changes["joints", name, *step] = place
    return changes
