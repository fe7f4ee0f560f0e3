"""Mirroring bodies: their positions, shapes, motions, and the joints among them."""

from collections.abc import Collection
from typing import Literal

from sandbox.editing.attached_bodies import attached
from sandbox.editing.bodies_at_start import bodies_named, bounding_box
from sandbox.editing.formula_arithmetic import negative, shifted
from sandbox.editing.inserted_value_layout import Json
from sandbox.editing.text_patches import Changes, put_all
from sandbox.model.body import Body
from sandbox.model.expressions import Expression
from sandbox.model.joints import (
    AngleStop,
    Held,
    Joint,
    Motor,
    Rack,
    Rail,
    Slot,
    Stop,
    Winding,
    Wire,
    bodies_of,
    ends_of,
)
from sandbox.model.json_positions import Path
from sandbox.model.level import Level
from sandbox.model.shapes import Arc, Curve, Polygon, Polyline, Segment, points_of

Pair = tuple[Expression, Expression]


def mirror(text: str, level: Level, names: Collection[str], axis: Literal["x", "y"] = "x") -> str:
    """Return a level in which bodies are mirrored about the middle of their bounding box.

    Coordinates along the axis are reversed: x swaps left and right, y above and below. Raises
    `SandboxError` if there are no bodies.
    """
    low, high = bounding_box(bodies_named(level, names).values())
    mirror = _Mirror(axis, (low + high).real if axis == "x" else (low + high).imag)
    changes = Changes()
    for name in names:
        changes |= mirror.body(("bodies", name), level.bodies[name])
    for name, joint in level.joints.items():
        if (joined := set(bodies_of(joint))) and joined <= set(names):
            changes |= mirror.joint(("joints", name), joint)
        elif joined:
            changes |= mirror.joint_points(("joints", name), joint, names)
    return attached(put_all(text, changes), level, names)


class _Mirror:
    """A mirror along an axis: a coordinate c becomes total − c, and rotations change their sign.

    For a point p of a body at c, turned by R(θ): F (c + R(θ) p) = F c + R(−θ) F p.
    """

    def __init__(self, axis: Literal["x", "y"], total: float) -> None:
        self._index = "xy".index(axis)
        self._total = total

    def body(self, path: Path, body: Body) -> Changes:
        """Return the changes of a body."""
        changes: Changes = {(*path, "position"): self._place(body.position)}
        if _is_given(body.velocity[self._index]):
            changes[*path, "velocity"] = self._flipped(body.velocity)
        for field in ("angle", "angular_velocity"):
            if _is_given(value := getattr(body, field)):
                changes[*path, field] = negative(value)
        if body.one_way and not isinstance(body.shape, Arc):  # an arc keeps its sense
            changes[*path, "one_way"] = "left" if body.one_way == "right" else "right"
        return changes | self._shape((*path, "shape"), body)

    def joint(self, path: Path, joint: Joint) -> Changes:
        """Return the changes of a joint whose bodies are all mirrored."""
        changes = self.joint_points(path, joint, set(bodies_of(joint)))
        for step, end in ends_of(joint):
            if isinstance(end, tuple):
                changes[*path, *step] = self._place(end)
        return changes | self._ways(path, joint) | self._turns(path, joint)

    def _ways(self, path: Path, joint: Joint) -> Changes:
        """Return the changes of the direction or the curve along which the ends of a joint move."""
        match joint:
            case Rail(direction=direction) | Slot(direction=direction) | Stop(direction=direction):
                return {(*path, "direction"): self._flipped(direction)}
            case Rack(direction=direction):  # the wheel turns the other way
                mirrored: list[Json] = [along.source for along in direction]
                mirrored[1 - self._index] = negative(direction[1 - self._index])
                return {(*path, "direction"): mirrored}
            case Wire(curve=curve):
                return {(*path, "curve"): self._place(curve)}
        return {}

    def _turns(self, path: Path, joint: Joint) -> Changes:
        """Return the changes of a joint's angles, rate or sense of turning."""
        match joint:
            case AngleStop(range=(least, most)):
                return {(*path, "range"): [negative(most), negative(least)]}
            case Motor(rate=rate):
                return {(*path, "rate"): negative(rate)}
            case Winding(unwinds=way):
                other = "clockwise" if way == "counterclockwise" else "counterclockwise"
                return {(*path, "unwinds"): other}
        return {}

    def joint_points(self, path: Path, joint: Joint, names: Collection[str]) -> Changes:
        """Return the changes of the points at which a joint holds mirrored bodies."""
        return {
            (*path, *step, "at"): self._flipped(end.at)
            for step, end in ends_of(joint)
            if isinstance(end, Held) and end.body in names
        }

    def _shape(self, path: Path, body: Body) -> Changes:
        match body.shape:
            case Polygon() as shape:
                return {(*path, "vertices"): list(map(self._flipped, points_of(shape)))}
            case Polyline() as shape:
                return {(*path, "points"): list(map(self._flipped, points_of(shape)))}
            case Segment(start=start, end=end):
                return {(*path, "start"): self._flipped(start), (*path, "end"): self._flipped(end)}
            case Curve(curve=curve):
                return {(*path, "curve"): self._flipped(curve)}
            case Arc(start=first, end=last):
                return {
                    (*path, "start"): self._direction(last),
                    (*path, "end"): self._direction(first),
                }
        return {}

    def _place(self, point: Pair) -> list[Json]:
        flipped = type(point[self._index])(negative(point[self._index]))
        return self._with(point, shifted(flipped, self._total))

    def _flipped(self, vector: Pair) -> list[Json]:
        return self._with(vector, negative(vector[self._index]))

    def _with(self, pair: Pair, coordinate: Json) -> list[Json]:
        mirrored: list[Json] = [expression.source for expression in pair]
        mirrored[self._index] = coordinate
        return mirrored

    def _direction(self, angle: Expression) -> Json:
        """Return a mirrored direction: π − θ along x, −θ along y."""
        return negative(angle) if self._index else f"pi - ({angle.source})"


def _is_given(expression: Expression) -> bool:
    return expression.source != 0
