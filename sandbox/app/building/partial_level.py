"""A drawable level from a text with mistakes: every part that can be read is drawn.

The level need not be able to run. An unchanged part is not read again, so that a change to one of
five hundred bodies takes little longer than a change to one of two.
"""

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import pairwise
from math import dist
from typing import Any, Generic, TypeVar

import numpy as np
import pygame
from pydantic import ConfigDict, TypeAdapter, ValidationError

from sandbox.app.drawing import lines, shading
from sandbox.app.drawing.camera import Camera
from sandbox.app.drawing.text import Pen
from sandbox.app.stage import bodies, grid, joints, static_bodies
from sandbox.app.stage.body_outlines import Outline, outlined
from sandbox.model.body import Body
from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Expression, Values
from sandbox.model.joint_ends_at_start import end_position
from sandbox.model.joints import Joint, Rail, Wire, points
from sandbox.model.level import Level
from sandbox.model.named_constants import let_use
from sandbox.model.shapes import XY, evaluate
from sandbox.model.view import View
from sandbox.model.wire_points import along

Part = TypeVar("Part")


class PartCache(Generic[Part]):
    """Reads parts, and reuses those that are unchanged in the next scene.

    `read` makes a part from its JSON text, or raises a `ValidationError`.
    """

    def __init__(self, read: Callable[[str], Part]) -> None:
        self._read = read
        self._now: dict[str, Part | None] = {}
        self._before: dict[str, Part | None] = {}

    def __len__(self) -> int:
        return len(self._now.keys() | self._before.keys())

    def begin(self) -> None:
        """Begin the next scene, after which parts that are not in it are dropped."""
        self._before, self._now = self._now, {}

    def __call__(self, text: str) -> Part | None:
        """Return the part; None if it cannot be read."""
        if text not in self._now:
            is_known = text in self._before
            self._now[text] = self._before[text] if is_known else self._made(text)
        return self._now[text]

    def _made(self, text: str) -> Part | None:
        try:
            return self._read(text)
        except ValidationError:
            return None


SIDEWAYS = 2000.0
"""m, the drawn length of a rail on each side."""

_JOINT: TypeAdapter[Joint] = TypeAdapter(Joint, config=ConfigDict(defer_build=True))
_body = PartCache(Body.model_validate_json)
_joint: PartCache[Joint] = PartCache(_JOINT.validate_json)


@dataclass(frozen=True, slots=True)
class DrawableBody:
    """A body at the start."""

    spec: Body
    outline: Outline
    position: XY
    angle: float

    @property
    def corners(self) -> list[XY]:
        """Its corners in the plane [m]."""
        return self.outline.placed(self.position, self.angle)

    def covers(self, point: XY, margin: float) -> bool:
        """Return whether it covers a point of the plane, or comes within a margin of it [m]."""
        offset = point[0] - self.position[0], point[1] - self.position[1]
        return self.outline.covers(offset, self.angle, margin)


@dataclass(frozen=True, slots=True)
class DrawableJoint:
    """A joint at the start, through points of the plane [m]."""

    spec: Joint
    path: tuple[XY, ...]


@dataclass
class Parts:
    """Bodies and joints that can be drawn, by name."""

    bodies: Mapping[str, DrawableBody]
    joints: Mapping[str, DrawableJoint]


def parts_of(level: Level) -> Parts:
    """Return the parts of a level at its start."""
    values = level.defaults
    bodies, joints = (
        _drawable_bodies(level.bodies, values),
        _drawable_joints(level.joints, level.bodies, values),
    )
    return Parts(dict(bodies), dict(joints))


class PartialLevel(Parts):
    """The drawable content of a level's text."""

    def __init__(self, document: Mapping[str, Any]) -> None:
        _body.begin()
        _joint.begin()
        parameters = dict(_numbers(_mapping(document, "parameters")))
        self.values = _with_constants(parameters, _mapping(document, "constants"))
        """The parameters' default values, and those of constants, as far as they can be read."""
        specs = {
            name: spec
            for name, part in _mapping(document, "bodies").items()
            if (spec := _body(json.dumps(part))) is not None
        }
        parts = _mapping(document, "joints").items()
        tied = {name: j for name, part in parts if (j := _joint(json.dumps(part))) is not None}
        drawn, paths = (
            _drawable_bodies(specs, self.values),
            _drawable_joints(tied, specs, self.values),
        )
        super().__init__(dict(drawn), dict(paths))
        self._open = _initially_open(_mapping(document, "events"))
        self.view = _view(json.dumps(document.get("view", {})))
        """The part of the plane that the level asks to show."""

    def body_at(self, point: XY, margin: float) -> str | None:
        """Return the topmost body within a margin of a point [m]; moving bodies come first."""
        found = [name for name, body in self.bodies.items() if body.covers(point, margin)]
        moving = [name for name in found if self.bodies[name].outline.moves]
        return next(reversed(moving or found), None)

    def joint_at(self, point: XY, margin: float) -> str | None:
        """Return a joint within a margin of a point [m], preferably a pin."""
        close = [n for n, joint in self.joints.items() if _distance(joint.path, point) <= margin]
        return next((name for name in close if self.is_pin(name)), next(iter(close), None))

    def is_pin(self, joint: str) -> bool:
        """Return whether a joint is drawn at a single point."""
        path = self.joints[joint].path
        return all(place == path[0] for place in path)

    def draw(self, surface: pygame.Surface, camera: Camera, pen: Pen) -> None:
        """Draw all of it, on a grid."""
        shading.backdrop(surface)
        grid.draw_grid(surface, camera)
        middle = self._middle(camera)
        for body in self.bodies.values():
            if not body.outline.moves:
                place = body.position, body.angle
                static_bodies.draw_surface(surface, camera, body.outline, *place, middle)
        self._draw_joints(surface, camera, in_front=False)
        few = len(self.bodies) <= bodies.FEW
        for body in self.bodies.values():
            if body.outline.moves:
                place = body.position, body.angle
                if few:
                    bodies.draw_body(surface, camera, body.outline, *place, spoke=False)
                else:
                    bodies.draw_crowd(surface, camera, body.outline, *place)
        self._draw_joints(surface, camera, in_front=True)
        grid.draw_rulers(surface, camera, pen)
        grid.draw_scale_bar(surface, camera, pen)

    def _draw_joints(self, surface: pygame.Surface, camera: Camera, *, in_front: bool) -> None:
        for name, joint in self.joints.items():
            if name in self._open:
                if in_front:
                    joints.draw_open(surface, camera, joint.path)
            elif isinstance(joint.spec, joints.IN_FRONT) is in_front:
                joints.draw_joint(surface, camera, joint.spec, joint.path, slack=False)

    def _middle(self, camera: Camera) -> XY:
        """Return the mean position of the moving bodies, or the centre of the view [m]."""
        places = [body.position for body in self.bodies.values() if body.outline.moves]
        if not places:
            return camera.center
        x, y = np.mean(places, axis=0).tolist()
        return x, y


def _distance(path: Sequence[XY], point: XY) -> float:
    """Return the distance of a point from a polyline [m]."""
    if len(path) == 1:
        return dist(point, path[0])
    return min(lines.distance(a, b, point) for a, b in pairwise(path))


def _mapping(document: Mapping[str, Any], name: str) -> Mapping[str, Any]:
    """Return a part that is an object; an empty one if it is not."""
    part = document.get(name)
    return part if isinstance(part, dict) else {}


def _numbers(parameters: Mapping[str, Any]) -> Iterator[tuple[str, float]]:
    for name, parameter in parameters.items():
        value = parameter.get("value") if isinstance(parameter, dict) else None
        if isinstance(value, int | float):
            yield name, float(value)


def _with_constants(
    parameters: Mapping[str, float], document: Mapping[str, Any]
) -> dict[str, float]:
    """Return the values of the parameters, and of those constants that can be evaluated."""
    values, constants = dict(parameters), dict[str, Expression]()
    for name, formula in document.items():
        with suppress(SandboxError, TypeError):
            constants[name] = Expression(formula)
    let_use(constants.values(), constants)
    for name, constant in constants.items():
        with suppress(SandboxError, ArithmeticError, LookupError):
            values[name] = constant(parameters)
    return values


def _view(text: str) -> View:
    try:
        return View.model_validate_json(text)
    except ValidationError:
        return View()


def _drawable_bodies(
    specs: Mapping[str, Body], values: Values
) -> Iterator[tuple[str, DrawableBody]]:
    moving = 0
    for row, (name, spec) in enumerate(specs.items()):
        try:
            outline = outlined(name, row, spec, values, moving)
            yield (
                name,
                DrawableBody(spec, outline, evaluate(spec.position, values), spec.angle(values)),
            )
        except (SandboxError, ArithmeticError, KeyError):  # a formula without a value here
            continue
        moving += spec.type != "static"


def _drawable_joints(
    tied: Mapping[str, Joint], specs: Mapping[str, Body], values: Values
) -> Iterator[tuple[str, DrawableJoint]]:
    for name, joint in tied.items():
        try:
            yield name, DrawableJoint(joint, tuple(_path(joint, specs, values)))
        except (SandboxError, ArithmeticError, LookupError):  # or an end at a missing body
            continue


def _initially_open(events: Mapping[str, Any]) -> frozenset[str]:
    """Return the joints that an event ties, as far as events can be read."""
    lists = [event.get("tie") for event in events.values() if isinstance(event, Mapping)]
    named = (name for names in lists if isinstance(names, list) for name in names)
    return frozenset(name for name in named if isinstance(name, str))


def _path(joint: Joint, specs: Mapping[str, Body], values: Values) -> list[XY]:
    """Return the points through which a joint is drawn [m]."""
    if isinstance(joint, Wire):
        return [(p.real, p.imag) for p in along(joint, values, 256).tolist()]
    path = [(p.real, p.imag) for p in (end_position(end, specs, values) for end in points(joint))]
    if isinstance(joint, Rail):
        return _rail(path[1], evaluate(joint.direction, values))
    return joints.drawn_path(joint, path, values, lambda body: specs[body].angle(values))


def _rail(through: XY, direction: XY) -> list[XY]:
    size = float(np.hypot(*direction)) or 1.0
    dx, dy = (SIDEWAYS * along / size for along in direction)
    return [(through[0] - dx, through[1] - dy), (through[0] + dx, through[1] + dy)]
