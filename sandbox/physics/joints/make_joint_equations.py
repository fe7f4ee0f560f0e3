"""The equations of joints, made from their models in a level."""

from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise
from math import fsum
from typing import Never

import numpy as np

from sandbox.model.effects.contract import IncompleteError
from sandbox.model.expressions import Array, Values
from sandbox.model.functions_of_one_variable import Formula, Function
from sandbox.model.joints import (
    AngleStop,
    Gear,
    Motor,
    Pivot,
    Pulley,
    Rack,
    Rail,
    Rod,
    Rope,
    Slot,
    Stop,
    Weld,
    Winding,
    Wire,
)
from sandbox.model.shapes import evaluate
from sandbox.model.wire_points import along
from sandbox.physics.geometry.quadrature import Antiderivative
from sandbox.physics.geometry.quintic_curve import points_along
from sandbox.physics.joints.exact.angle_equations import (
    AngleEquation,
    RackEquation,
    SlotEquation,
    angle_stops,
    number,
    pin,
    starting,
    stops,
    turn,
    where,
    winding,
)
from sandbox.physics.joints.exact.bead_on_wire import WireEquation
from sandbox.physics.joints.exact.constraint_interface import Change, Coordinates, Equation
from sandbox.physics.joints.exact.distance_equations import Row
from sandbox.physics.joints.scene_joints import Joints
from sandbox.physics.state.joint_anchors import Anchor

Lengths = Rod | Rope | Pulley | Rail | Stop
Turning = Pivot | Weld | Motor | Winding | AngleStop | Gear | Rack
Solved = Lengths | Turning | Slot | Wire
"""The joints that are solved by their equations."""

Made = tuple[list[Row], Sequence[Equation]]

DRAWN = 200
"""The number of segments of a wire that are drawn."""


class JointEquations:
    """Makes the equations of a scene's joints, and stores their wires and radii in `joints`.

    The indices of its n bodies are given by name; `inverse_mass` is (n, 3), the inverse mass, mass
    and moment of inertia, 0 of bodies that do not move or turn [1/kg, 1/(kg m²)]. `lengths` are
    those of the joints from end to end at the start, by name [m]. Positions in the equations are
    relative to the origin [m].
    """

    def __init__(
        self,
        values: Values,
        index: Mapping[str, int],
        inverse_mass: Array,
        lengths: Mapping[str, float],
        joints: Joints,
        origin: complex,
    ) -> None:
        self._values, self._index, self._inverse_mass = values, index, inverse_mass
        self._lengths, self._joints, self._origin = lengths, joints, origin

    def of(self, name: str, spec: Solved, start: Coordinates) -> Made:
        """Return the equations of a joint that is solved with others, for positions `start`."""
        joints, values = self._joints, self._values
        path = counted_from(self._origin, joints.paths[name])
        if isinstance(spec, Lengths):
            return _rows(name, spec, path, self._lengths[name], values), ()
        if isinstance(spec, Turning):
            return self._turning(name, spec, path, start)
        if isinstance(spec, Slot):
            way = complex(*evaluate(spec.direction, values))
            return [], (SlotEquation(name, path[0], path[1], -1j * way / abs(way)),)
        wire = WireEquation(name, path[0], points_along(spec, values) - self._origin)
        joints.wires[name] = wire
        joints.paths[name] = tuple(Anchor(None, p) for p in along(spec, values, DRAWN))
        return [], (wire,)

    def _turning(
        self, name: str, spec: Turning, path: tuple[Anchor, ...], start: Coordinates
    ) -> Made:
        """Return the equations of a joint that keeps a point, an angle, or a rolling distance."""
        (a, b), values, radii = path, self._values, self._joints.radii
        match spec:
            case Pivot():
                return pin(name, a, b), ()
            case Weld():
                return self.weld(name, a, b, start)
            case Motor(rate=rate):
                driven = turn(name, a, b, start, _driven(rate, values))
                return pin(name, a, b), (driven,) if self.can_turn(a, b) else ()
            case AngleStop(range=(least, most)):
                limits = angle_stops(name, a, b, least(values), most(values))
                return [], limits if self.can_turn(a, b) else ()
            case Gear(ratio=ratio, carrier=carrier):
                arm = Anchor(None if carrier is None else self._index[carrier])
                bodies, other = (number(a), number(b)), number(arm)
                held = AngleEquation(name, *bodies, 0.0, ratio=ratio(values), carrier=other)
                return [], (starting(held, start),) if self.can_turn(a, b, arm) else ()
            case Rack(radius=radius, direction=direction):
                along = complex(*evaluate(direction, values))
                bar = RackEquation(name, a, number(b), radius(values), along / abs(along))
                return [], (starting(bar, start),)
            case Winding(radius=radius, unwinds=way):
                radii[name] = radius(values)
                sense = 1 if way == "counterclockwise" else -1
                return [], (winding(name, a, b, radii[name], sense, start),)
            case _:
                raise _no_case(spec)

    def weld(self, name: str, a: Anchor, b: Anchor, start: Coordinates) -> Made:
        """Return the equations that weld two bodies at their positions `start`."""
        rows = pin(name, Anchor(a.body, where(a, b, start)), b)
        return rows, [turn(name, a, b, start)] if self.can_turn(a, b) else ()

    def can_turn(self, *anchors: Anchor) -> bool:
        """Return whether any of the bodies can turn."""
        held = [anchor.body for anchor in anchors if anchor.body is not None]
        return bool(self._inverse_mass[held, 2].any())


def not_made(joint: object) -> IncompleteError:
    """Return the error of a joint that has no equations here."""
    rule = f"add {type(joint).__name__} to sandbox/physics/joints/make_joint_equations.py"
    return IncompleteError(f"no code makes this joint: {rule}")


def _no_case(joint: Never) -> IncompleteError:
    """Return the error of a joint without a `case`, which mypy reports by the type."""
    return not_made(joint)


def counted_from(origin: complex, path: tuple[Anchor, ...]) -> tuple[Anchor, ...]:
    """Return the points of a joint, with those of the plane relative to an origin."""
    return tuple(a if a.body is not None else Anchor(None, a.point - origin) for a in path)


def _rows(
    name: str, spec: Lengths, path: tuple[Anchor, ...], span: float, values: Values
) -> list[Row]:
    reaches = list(pairwise(path))
    match spec:
        case Rail(direction=direction):
            way = complex(*evaluate(direction, values))
            return [Row(name, reaches, 0.0, along=1j * way / abs(way))]
        case Stop(direction=direction, range=limits):
            way = complex(*evaluate(direction, values))
            least, most = (limit(values) for limit in limits)
            return stops(name, path[0], path[1], way, (least, most))
        case Rod(length=length):
            if length is None:
                return [Row(name, reaches, span)]
            if "t" in length.names:
                return [Row(name, reaches, 0.0, changing=_in_time(length, values))]
            return [Row(name, reaches, length(values))]
        case Rope(length=length) | Pulley(length=length):
            whole = span if length is None else length(values)
            moving = [(a, b) for a, b in reaches if a.body != b.body]
            still = fsum(abs(b.point - a.point) for a, b in reaches if a.body == b.body)
            return [Row(name, moving, whole - still, pulls_only=True)]
        case _:
            raise _no_case(spec)


def _in_time(length: Formula, values: Values) -> Change:
    return Change(*(_at(f, values) for f in (length, length.slope("t"))))


def _driven(rate: Formula, values: Values) -> Change:
    """Return the change of the angle that a motor has turned by."""
    if "t" not in rate.names:
        steady = rate(values)
        return Change(lambda t: steady * t, lambda _: steady)
    return Change(Antiderivative(lambda t: rate.over(values, t)), _at(rate, values))


def _at(formula: Function, values: Values) -> Callable[[float], float]:
    return lambda t: float(formula.at(values, {"t": np.asarray(t)}))
