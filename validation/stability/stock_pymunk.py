"""Stock pymunk on the scene of a level, with its own stepping, settings and joints."""

import pymunk
from pymunk import Vec2d

from sandbox.model.expressions import Values
from sandbox.model.joint_ends_at_start import span
from sandbox.model.joints import End, Held, Joint, Pivot, Rail, Rod, Rope, Spring, points
from sandbox.model.level import Level, Stepping
from sandbox.model.shapes import evaluate
from sandbox.physics.run import build
from sandbox.physics.stepping.world import World

LONG = 1e3
"""The length of a rail to either side [m], since pymunk's rails have ends."""


def naive(level: Level, rate: float) -> World:
    """Return a world at a rate [Hz] in which pymunk does everything, with its default iterations.

    Pymunk must have all joints of the level.
    """
    stepping = Stepping(rate=rate, scheme="symplectic-euler")
    world = build(level.model_copy(update={"joints": {}}), stepping=stepping)
    for joint in level.joints.values():
        world.scene.space.add(_joint(joint, level, world))
    return world


def _joint(joint: Joint, level: Level, world: World) -> pymunk.Constraint:
    values = level.defaults
    first, *_, second = points(joint)
    a, b = _body(first, world), _body(second, world)
    at_a, at_b = _anchor(first, values), _anchor(second, values)
    match joint:
        case Rod():
            return pymunk.PinJoint(a, b, at_a, at_b)
        case Pivot():
            return pymunk.PivotJoint(a, b, at_a, at_b)
        case Rail(direction=direction):
            along = LONG * Vec2d(*evaluate(direction, values)).normalized()
            return pymunk.GrooveJoint(b, a, at_b - along, at_b + along, at_a)
        case Rope(length=length):
            most = length(values) if length else span(joint, level.bodies, values)
            return pymunk.SlideJoint(a, b, at_a, at_b, 0, most)
        case Spring(length=length, stiffness=stiffness, damping=damping):
            slack = length(values) if length else span(joint, level.bodies, values)
            return pymunk.DampedSpring(a, b, at_a, at_b, slack, stiffness(values), damping(values))
    raise TypeError(f"pymunk has no {joint.type}")


def _body(end: End, world: World) -> pymunk.Body:
    name = end.body if isinstance(end, Held) else end
    return world.scene.bodies[name] if isinstance(name, str) else world.scene.space.static_body


def _anchor(end: End, values: Values) -> tuple[float, float]:
    if isinstance(end, Held):
        return evaluate(end.at, values)
    return (0.0, 0.0) if isinstance(end, str) else evaluate(end, values)
