"""Groups: bodies and joints that are placed together, any number of times.

    "groups": {"cart": {"bodies": {"frame": {...}, "wheel": {...}}, "joints": {"axle": {...}}}},
    "bodies": {"left": {"copy": "cart", "position": [-3, 0], "angle": "10*deg"}}

stands for the bodies `left_frame`, `left_wheel` and the joint `left_axle`. Positions in a group are
along its own axes, which are rotated by the angle, then moved to the position.
"""

import json
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from math import cos, sin
from typing import Annotated, Any, NamedTuple

from pydantic import Field

from sandbox.model.base import Model, Name
from sandbox.model.body import MAX_BODIES, Body
from sandbox.model.did_you_mean import suggestion
from sandbox.model.errors import brief
from sandbox.model.joints import Joint
from sandbox.model.json_positions import Path
from sandbox.model.number_bounds import Angle, Coordinate
from sandbox.model.shapes import Point
from sandbox.model.shorthand.expansion_notes import Notes, followed
from sandbox.model.shorthand.repeated_members import GROUPS
from sandbox.model.translatable_message import Message

INTO_EACH = 10
"""The most numbers of a body in which the position and angle of a copy appear."""

LARGEST = 1e100
"""Larger numbers are not allowed in a level."""

COPY = "copy"

Number = float | int | str
"""A number or a formula, as typed."""


class Group(Model):
    """Bodies and joints that are placed together, described in the group's own frame."""

    bodies: Annotated[Mapping[Name, Body], Field(min_length=1, max_length=MAX_BODIES)]
    """the bodies; their positions are relative to the group's origin"""
    joints: Annotated[Mapping[Name, Joint], Field(max_length=2000)] = {}
    """the joints between its bodies, or with bodies and fixed points outside"""


class Copy(Model):
    """A copy of a group: its bodies and joints, with the name of the copy before theirs."""

    copy_: Annotated[str, Field(alias=COPY)]
    """the name of the group"""
    position: Point = (Coordinate(0), Coordinate(0))
    """[x, y] in m, the position of the group's origin"""
    angle: Angle = Angle(0)
    """rad, counter-clockwise, the rotation of the group about its origin"""


def placed(data: Any, notes: Notes) -> Any:  # noqa: ANN401 (whatever JSON holds)
    """Return a level in which the groups are replaced by the bodies and joints placed from them."""
    if not isinstance(data, dict):
        return data
    groups = data.get(GROUPS, {})
    bodies, joints = data.get("bodies"), data.get("joints", {})
    plain = {key: value for key, value in data.items() if key != GROUPS}
    if not isinstance(groups, dict) or not isinstance(bodies, dict) or not isinstance(joints, dict):
        if not isinstance(groups, dict):
            notes.refuse((GROUPS,), Message("must be an object, {...}"))
        return plain
    placing = _Placing(groups, notes)
    plain["bodies"] = placing.bodies(bodies)
    if placing.joints:
        plain["joints"] = placing.merged("joints", [*joints.items(), *placing.joints])
    placing.refuse_unused()
    return plain


class _Placing:
    """Places groups, one body of a level after the other."""

    def __init__(self, groups: Mapping[str, Any], notes: Notes) -> None:
        self._notes = notes
        self._groups = {name: group for name, group in groups.items() if self._fits(name, group)}
        self._known = groups.keys()
        self._unused = set(self._groups)
        self.joints: list[tuple[str, Any]] = []

    def _fits(self, name: str, group: Any) -> bool:  # noqa: ANN401
        """Whether a group is valid enough to be placed; if not, note a mistake."""
        before = len(self._notes.faults)
        place = (GROUPS, name)
        if not isinstance(group, dict):
            self._refuse(place, Message("must be an object with 'bodies' and 'joints'"))
            return False
        for key, part in group.items():
            if key not in Group.model_fields:
                hint = suggestion(key, Group.model_fields)
                rule = Message("unknown key '{name}'{hint}", name=brief(key), hint=hint)
                self._refuse((*place, key), rule)
            elif not isinstance(part, dict):
                self._refuse((*place, key), Message("must be an object, {...}"))
        if not group.get("bodies"):
            self._refuse(place, Message("'{last}' is missing", last="bodies"))
        elif COPY in (inside := _keys_within(group["bodies"])):
            rule = Message("a group cannot contain another one")
            self._refuse((*place, "bodies", inside[COPY]), rule)
        return len(self._notes.faults) == before

    def bodies(self, bodies: Mapping[str, Any]) -> dict[str, Any]:
        """Return the bodies of a level, with the bodies of groups in place of their copies."""
        found: list[tuple[str, Any]] = []
        for name, body in bodies.items():
            if isinstance(body, dict) and COPY in body:
                found += self._copied(name, body)
            else:
                found.append((name, body))
        return self.merged("bodies", found)

    def merged(self, kind: str, items: Sequence[tuple[str, Any]]) -> dict[str, Any]:
        """Return the members of groups and of the level itself under one key."""
        found: dict[str, Any] = {}
        for name, value in items:
            if name in found:
                path = followed((kind, name), self._notes.placed)
                rule = Message(
                    "there are two of '{name}', one of them from a group", name=brief(name)
                )
                self._refuse(path, rule)
            found[name] = value
        return found

    def _copied(self, name: str, copy: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
        path = ("bodies", name)
        group = self._group_of(copy, path)
        if group is None:
            return
        added = len(name) + INTO_EACH * len(json.dumps([copy.get("position"), copy.get("angle")]))
        parts = len(group["bodies"]) + len(group.get("joints", {}))
        size = len(json.dumps(group)) + parts * added
        self._notes.charge(size, followed(path, self._notes.typed))
        frame, inside = _Frame(copy), group["bodies"].keys()
        of = (GROUPS, copy[COPY])
        for local, body in group["bodies"].items():
            self._notes.placed["bodies", f"{name}_{local}"] = (*of, "bodies", local)
            yield f"{name}_{local}", frame.body(body)
        for local, joint in group.get("joints", {}).items():
            self._notes.placed["joints", f"{name}_{local}"] = (*of, "joints", local)
            self.joints.append((f"{name}_{local}", frame.joint(joint, _Names(name, inside))))

    def _group_of(self, copy: Mapping[str, Any], path: Path) -> Any:  # noqa: ANN401
        known = [field.alias or name for name, field in Copy.model_fields.items()]
        for key in copy:
            if key not in known:
                rule = Message(
                    "unknown key '{name}' of a copy of a group{hint}",
                    name=brief(key),
                    hint=suggestion(key, known),
                )
                self._refuse((*path, key), rule)
        group = copy[COPY]
        if not isinstance(group, str) or group not in self._known:
            hint = suggestion(str(group), self._known)
            rule = Message("unknown group '{name}'{hint}", name=brief(str(group)), hint=hint)
            self._refuse((*path, COPY), rule)
            return None
        self._unused.discard(group)
        if not _is_point(copy.get("position", [0, 0])):
            rule = Message("must be two numbers or expressions, [x, y]")
            self._refuse((*path, "position"), rule)
            return None
        if not _is_number(copy.get("angle", 0)):
            self._refuse((*path, "angle"), Message("must be a number"))
            return None
        return self._groups.get(group)

    def _refuse(self, path: Path, rule: Message) -> None:
        self._notes.refuse(followed(path, self._notes.typed), rule)

    def refuse_unused(self) -> None:
        """Refuse groups that are never placed, since their members would not be checked."""
        for name in sorted(self._unused):
            rule = Message(
                'this group is never placed; a body {{"{copy}": "{name}"}} places it',
                copy=COPY,
                name=brief(name),
            )
            self._refuse((GROUPS, name), rule)


def _keys_within(bodies: Any) -> dict[str, str]:  # noqa: ANN401 (whatever JSON holds)
    """Return the keys in the bodies of a group, each with the last body that has it."""
    named = bodies.items() if isinstance(bodies, dict) else ()
    return {key: name for name, body in named if isinstance(body, dict) for key in body}


def _is_number(value: object) -> bool:
    if isinstance(value, bool) or not isinstance(value, int | float | str):
        return False
    return isinstance(value, str) or abs(value) <= LARGEST


def _is_point(value: object) -> bool:
    return isinstance(value, list) and len(value) == 2 and all(map(_is_number, value))


class _Names(NamedTuple):
    """The name of a copy, and those of the bodies in its group."""

    copy: str
    inside: Collection[str]


class _Frame:
    """The axes of a placed group: r' = R + (x cos a − y sin a, x sin a + y cos a)."""

    def __init__(self, copy: Mapping[str, Any]) -> None:
        self._origin: Sequence[Number] = copy.get("position", [0, 0])
        self._angle: Number = copy.get("angle", 0)

    def body(self, body: Any) -> Any:  # noqa: ANN401
        if not isinstance(body, dict):
            return body
        made = {**body, "position": self.point(body.get("position", [0, 0]))}
        if self._angle != 0:
            made["angle"] = _sum(self._angle, body.get("angle", 0))
        if "velocity" in body:
            made["velocity"] = self.vector(body["velocity"])
        if isinstance(motion := body.get("motion"), dict) and "displacement" in motion:
            made["motion"] = {**motion, "displacement": self.vector(motion["displacement"])}
        return made

    def joint(self, joint: Any, names: _Names) -> Any:  # noqa: ANN401
        """Return a joint of the group with the bodies of its copy."""
        if not isinstance(joint, dict):
            return joint
        made = dict(joint)
        for key in joint.keys() & TURNED.keys():
            made[key] = TURNED[key](self, joint[key], names)
        if joint.get("type") == "slot":
            made["direction"] = joint.get("direction")  # along its body's axes, which turn
        if joint.get("type") == "angle_stop":
            made["range"] = self.angles(joint)
        return made

    def angles(self, stop: Mapping[str, Any]) -> Any:  # noqa: ANN401
        """Return the range of an angle stop in a copy, shifted if one of its ends is the plane."""
        ends, angles = stop.get("ends"), stop.get("range")
        from_plane = isinstance(ends, list) and ends and _is_point(ends[0])
        if self._angle == 0 or not from_plane or not isinstance(angles, list):
            return angles
        return [_sum(self._angle, angle) for angle in angles]

    def ends(self, ends: Any, names: _Names) -> Any:  # noqa: ANN401
        """Return the ends of a joint in a copy."""
        return [self.end(end, names) for end in ends] if isinstance(ends, list) else ends

    def end(self, end: Any, names: _Names) -> Any:  # noqa: ANN401
        """Return an end of a joint in a copy."""
        if isinstance(end, str):
            return f"{names.copy}_{end}" if end in names.inside else end
        if isinstance(end, dict) and isinstance(end.get("body"), str):
            return {**end, "body": self.end(end["body"], names)}
        return self.point(end)

    def point(self, point: Any, _: _Names | None = None) -> Any:  # noqa: ANN401
        """Return the position of a point of the group in the plane."""
        turned = self.vector(point)
        if not _is_point(turned):
            return point
        return [_sum(o, c) for o, c in zip(self._origin, turned, strict=True)]

    def vector(self, vector: Any, _: _Names | None = None) -> Any:  # noqa: ANN401
        """Return a vector of the group along the axes of the plane."""
        if self._angle == 0 or not _is_point(vector):
            return vector
        (x, y), a = vector, self._angle
        if isinstance(a, str):
            c, s = f"cos({a})", f"sin({a})"
            return [_sum(_times(x, c), _times(y, f"-{s}")), _sum(_times(x, s), _times(y, c))]
        return [
            _sum(_times(x, cos(a)), _times(y, -sin(a))),
            _sum(_times(x, sin(a)), _times(y, cos(a))),
        ]


TURNED: Mapping[str, Callable[[_Frame, Any, _Names], Any]] = {
    "ends": _Frame.ends,
    "over": _Frame.ends,
    "bead": _Frame.end,
    "curve": _Frame.point,
    "direction": _Frame.vector,
}
"""How each field of a joint is transformed where its group is placed."""


def _sum(a: Number, b: Any) -> Any:  # noqa: ANN401
    """Return a sum as it would be typed; a sum of numbers is a number."""
    if not _is_number(b) or a == 0:
        return b
    if isinstance(a, str) or isinstance(b, str):
        return a if b == 0 else f"{_bracketed(a)} + {_bracketed(b)}"
    return a + b


def _times(a: Number, b: Number) -> Number:
    """Return a product as it would be typed."""
    if isinstance(a, str) or isinstance(b, str):
        return 0 if a == 0 else f"{_bracketed(a)}*{_bracketed(b)}"
    return a * b


def _bracketed(number: Number) -> str:
    text = str(number)
    return text if text.isidentifier() or text.isdecimal() else f"({text})"
