"""Joints fit the distances between their ends at the start."""

from cmath import exp
from collections.abc import Iterator
from functools import partial

import numpy as np

from sandbox.model.errors import brief
from sandbox.model.events import tied_joints
from sandbox.model.expression_compiler import ExpressionError
from sandbox.model.expressions import Values
from sandbox.model.joint_ends_at_start import end_position, span
from sandbox.model.joints import (
    AngleStop,
    Gear,
    Joint,
    Motor,
    Pivot,
    Pulley,
    Rack,
    Rail,
    Rod,
    Rope,
    Slot,
    Spring,
    Stop,
    Winding,
    Wire,
    bodies_of,
    body_of,
)
from sandbox.model.level import Level
from sandbox.model.level_parts import names_in
from sandbox.model.number_bounds import Extent
from sandbox.model.rules.conditions.condition import Condition
from sandbox.model.shapes import evaluate
from sandbox.model.translatable_message import Message, word

NEAR = 1e-9
"""The tolerance for equal lengths, as a share or in m."""


def conditions(level: Level) -> Iterator[Condition]:
    """Yield the conditions on a level's joints at the start, except those that an event ties."""
    later = tied_joints(level.events)
    for name, joint in level.joints.items():
        if isinstance(joint, Wire):
            continue
        held = [level.bodies[body] for body in bodies_of(joint)]
        used = names_in((joint, *((b.position, b.angle) for b in held)))
        names = frozenset(used & level.parameters.keys())
        last = "ends" if joint.kind.points_meet else "length"
        fault = _later_fault if name in later else _span_fault
        yield Condition(("joints", name, last), names, partial(fault, joint, level))
        if isinstance(joint, Spring) and joint.law:
            yield Condition(("joints", name, "law"), names, partial(_law_fault, joint, level))
        yield Condition(("joints", name), frozenset(), partial(_turning_fault, joint, level))


def _turning_fault(joint: Joint, level: Level, _values: Values) -> Message | None:
    """Say that a joint needs bodies that can turn, which only `rotation` makes possible."""
    wheel = level.bodies[joint.ends[1]].type == "dynamic" if isinstance(joint, Winding) else False
    turns = isinstance(joint, Motor | Gear | Rack | AngleStop)
    if level.effects.rotation or not (wheel or turns):
        return None
    return Message("'{type}' is used but the effect 'rotation' is not declared", type=joint.type)


def _law_fault(spring: Spring, level: Level, values: Values) -> Message | None:
    """Say that a spring's own law has no value, or no slope, at the spring's initial length."""
    assert spring.law
    distance = span(spring, level.bodies, values)
    slack = distance if spring.length is None else spring.length(values)
    stretch = np.asarray(distance - slack)
    try:
        found = [f.at(values, {"x": stretch}) for f in (spring.law, spring.law.slope("x"))]
    except ExpressionError as error:
        return error.message
    if not np.isfinite(found).all():
        return Message(
            "'{source}' has no finite value or slope at x = {stretch:g} m",
            source=brief(str(spring.law.source)),
            stretch=float(stretch),
        )
    pull = float(found[0])
    if beyond := spring.law.range_fault(pull):
        return Message("is {pull:g} N, {beyond}", pull=pull, beyond=beyond)
    return None


def _span_fault(joint: Joint, level: Level, values: Values) -> Message | None:
    distance = span(joint, level.bodies, values)
    match joint:
        case Rod(length=length):
            long = distance if length is None else float(length.over(values, np.zeros(())))
            return _rod_fault(distance, long)
        case Rope(length=Extent() as length) | Pulley(length=Extent() as length):
            return _string_fault(distance, length(values))
        case Pivot() | Motor() if distance > NEAR:
            return Message(
                "the two ends of a {type} must coincide, but they are {distance:g} m apart",
                type=word(joint.type),
                distance=distance,
            )
        case Winding(radius=radius):
            return _winding_fault(distance, radius(values))
        case Rail() | Slot() | Stop() | AngleStop() | Rack():
            return _way_fault(joint, level, values)
    return None


def _later_fault(joint: Joint, _level: Level, values: Values) -> Message | None:
    """Say what is wrong with a joint that an event ties, for any positions of its ends."""
    return _direction_fault(joint, values) if isinstance(joint, Rail | Slot | Stop | Rack) else None


def _direction_fault(joint: Rail | Slot | Stop | Rack, values: Values) -> Message | None:
    if abs(complex(*evaluate(joint.direction, values))) > NEAR:
        return None
    return Message("a {type} needs a 'direction' that is not [0, 0]", type=word(joint.type))


def _way_fault(
    joint: Rail | Slot | Stop | AngleStop | Rack, level: Level, values: Values
) -> Message | None:
    """Say what is wrong with the direction or range in which a joint lets its ends move."""
    if isinstance(joint, AngleStop):
        return _angle_fault(joint, level, values)
    fault = _direction_fault(joint, values)
    if fault or isinstance(joint, Rack):
        return fault
    direction = complex(*evaluate(joint.direction, values))
    first, second = (end_position(end, level.bodies, values) for end in joint.ends)
    if isinstance(joint, Slot):
        direction *= exp(1j * level.bodies[str(body_of(joint.ends[1]))].angle(values))
    beyond = (first - second) * direction.conjugate() / abs(direction)
    if isinstance(joint, Stop):
        return _stop_fault(joint, beyond.real, values)
    return _rail_fault(joint, beyond.imag)


def _rail_fault(joint: Rail | Slot, aside: float) -> Message | None:
    if abs(aside) <= NEAR:
        return None
    if isinstance(joint, Slot):
        return Message(
            "the first end must start in the slot, but it is {aside:g} m away from it",
            aside=abs(aside),
        )
    return Message(
        "the first end must start on the rail, but it is {aside:g} m away from it",
        aside=abs(aside),
    )


def _stop_fault(stop: Stop, along: float, values: Values) -> Message | None:
    lower, upper = (limit(values) for limit in stop.range)
    return _range_fault(along, (lower, upper), "m")


def _angle_fault(stop: AngleStop, level: Level, values: Values) -> Message | None:
    names = [body_of(end) for end in stop.ends]
    first, second = (0.0 if n is None else level.bodies[n].angle(values) for n in names)
    lower, upper = (limit(values) for limit in stop.range)
    return _range_fault(second - first, (lower, upper), "rad")


def _range_fault(start: float, limits: tuple[float, float], unit: str) -> Message | None:
    """Say that a coordinate does not start between its two stops."""
    lower, upper = limits
    if not lower < upper:
        return Message(
            "a 'range' must go from the smaller to the larger value, not from {least:g} to"
            " {most:g}",
            least=lower,
            most=upper,
        )
    if lower - NEAR <= start <= upper + NEAR:
        return None
    return Message(
        "it starts at {start:g} {unit}, beyond the stops at {least:g} and {most:g} {unit}",
        start=start,
        unit=unit,
        least=lower,
        most=upper,
    )


def _rod_fault(distance: float, long: float) -> Message | None:
    if not distance > NEAR:
        return Message("a rod cannot be 0 m long; use a pivot to hold two points together")
    if not abs(long - distance) <= NEAR * distance:
        return Message(
            "the rod is {long:g} m long at the start, but its ends are {distance:g} m apart",
            long=long,
            distance=distance,
        )
    return None


def _string_fault(path: float, long: float) -> Message | None:
    if long < path * (1 - 1e-12):
        return Message(
            "the string is {long:g} m long, but its path is {path:g} m", long=long, path=path
        )
    return None


def _winding_fault(distance: float, radius: float) -> Message | None:
    if distance > radius * (1 + NEAR):
        return None
    return Message(
        "the string's end is {distance:g} m from the wheel's centre, within its radius of"
        " {radius:g} m; it must lie outside",
        distance=distance,
        radius=radius,
    )
