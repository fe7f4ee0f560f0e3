"""Making the joints of a scene: what holds exactly, and what pulls like a spring.

A plain string over pegs that shares no body with another exact joint is solved by itself, which is
five times as fast. All other exact joints are solved together. pymunk solves what is not exact.
"""

from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise
from typing import cast

import numpy as np
import pymunk

from sandbox.model.acting_events import bouncing, tied
from sandbox.model.base import Model
from sandbox.model.effects.contract import IncompleteError
from sandbox.model.expressions import Array, Formula, Values
from sandbox.model.joints import (
    AngleStop,
    End,
    Gear,
    Held,
    Joint,
    Motor,
    Own,
    Pivot,
    Pulley,
    Rack,
    Rail,
    Rod,
    Rope,
    Spring,
    Stop,
    Weld,
    Winding,
    Wire,
    bodies_of,
    is_exact,
    points,
)
from sandbox.model.level import Level, is_alone, span
from sandbox.model.shapes import XY, Point, evaluate
from sandbox.model.wires import along
from sandbox.physics.engine.batch import Batch
from sandbox.physics.forces.spring import Law, SpringForce
from sandbox.physics.geometry.quintics import course
from sandbox.physics.joints.composites import Solids, Touches
from sandbox.physics.joints.exact.angles import (
    angle_stops,
    geared,
    meshed,
    number,
    pin,
    starting,
    stops,
    turn,
    weld,
    where,
    winding,
)
from sandbox.physics.joints.exact.constraints import Coordinates, Equation
from sandbox.physics.joints.exact.distances import Row
from sandbox.physics.joints.exact.equation_count import refuse_too_many
from sandbox.physics.joints.exact.joint_system import JointSystem
from sandbox.physics.joints.exact.shake import ExactJoints
from sandbox.physics.joints.exact.wire import WireEquation
from sandbox.physics.joints.joints import Joints
from sandbox.physics.joints.latches import Latches
from sandbox.physics.joints.pulley import PulleyString
from sandbox.physics.joints.pymunk_joints import OwnJoint
from sandbox.physics.state.anchor import Anchor
from sandbox.physics.state.errors import JointFailure

Lengths = Rod | Rope | Pulley | Rail | Stop
Turning = Pivot | Weld | Motor | Winding | AngleStop | Gear | Rack

DRAWN = 200
"""How many pieces of a wire are shown."""

NEAR = 1e-9
"""m or rad, by which a rope may be too short, or a stop passed, where it is tied."""

FAR = 1e4
"""m from the plane's origin, beyond which exact joints count places from among their bodies: there,
a float knows a place worse than joints are kept."""


def assemble(
    level: Level,
    values: Values,
    bodies: Mapping[str, pymunk.Body],
    batch: Batch,
    inverse_mass: Array,
    touches: Touches | None = None,
    *,
    direct: bool = False,
) -> Joints:
    """Make the joints of a scene.

    Parameters
    ----------
    level, values
        What says which there are.
    bodies, batch
        What they hold, and what reads and writes it; n of them.
    inverse_mass
        (n, 3), one over mass, mass and moment, 0 of what nothing moves or turns [1/kg, 1/(kg m²)].
    touches
        Tells which of the pairs that stick have met; None if none do.
    direct
        Whether contacts are solved together with the exact joints, of which there may be none.
    """
    return _Assembly(level, values, bodies, inverse_mass, touches).joints(batch, direct=direct)


class _Assembly:
    """Makes joints one after the other; for the parameters see `assemble`."""

    def __init__(
        self,
        level: Level,
        values: Values,
        bodies: Mapping[str, pymunk.Body],
        inverse_mass: Array,
        touches: Touches | None,
    ) -> None:
        self._level, self._values, self._bodies = level, values, bodies
        self._inverse_mass = inverse_mass
        self._index = index = {name: i for i, name in enumerate(bodies)}
        self._lengths = {n: span(spec, level.bodies, values) for n, spec in level.joints.items()}
        self._joints = Joints(
            paths={
                name: tuple(_anchor(end, index, values) for end in points(spec))
                for name, spec in level.joints.items()
            },
            lines=[name for name, spec in level.joints.items() if spec.kind.swings],
            twists=any("torque" in spec.kind.quantities for spec in level.joints.values()),
            solids=Solids(bodies),
            touches=touches,
            weld=self._weld_where_they_are,
        )
        self._open = tied(level.events)
        if self._open:
            self._joints.latches = Latches(self._open, self._tie)
        self._origin = _origin(bodies)

    def joints(self, batch: Batch, *, direct: bool) -> Joints:
        """Return all joints."""
        joints, level = self._joints, self._level
        self._take_own()
        rows, others = self._take_ours()
        later = bool(self._open - joints.springs.keys()) or any(bouncing(level.joints))
        if rows or others or later or level.effects.sticking or direct:
            inverse_mass = self._inverse_mass[:, 0], self._inverse_mass[:, 2]
            refuse_too_many((*rows, *others), inverse_mass[0])
            joints.together = ExactJoints(rows, others, batch, *inverse_mass, self._origin)
        for name in level.joints:
            if name not in self._open:
                self._make_one(name)
        joints.elastic = self._elastic(batch)
        return joints

    def _elastic(self, batch: Batch) -> JointSystem | None:
        """Return the sides of the stops that give back speed, if there are any."""
        level, start = self._level, _coordinates(self._bodies, self._origin)
        names = [name for name, _ in bouncing(level.joints)]
        made = [self._equations(name, level.joints[name], start) for name in names]
        rows = [row for some, _ in made for row in some]
        others = [other for _, some in made for other in some]
        if not (rows or others):
            return None
        inverse_mass = self._inverse_mass[:, 0], self._inverse_mass[:, 2]
        return JointSystem(rows, others, batch, *inverse_mass, self._origin)

    def _make_one(self, name: str) -> None:
        """Make two bodies one that a joint welds, if it does."""
        joint, solids = self._level.joints[name], self._joints.solids
        assert solids
        if isinstance(joint, Weld) and len(held := tuple(bodies_of(joint))) == 2:
            solids.join(held[0], held[1], name)

    def _weld_where_they_are(self, a: str, b: str) -> None:
        together = self._joints.together
        assert together
        ends = Anchor(self._index[a]), Anchor(self._index[b])
        together.add(*self._weld(f"{a} and {b}", *ends, together.place()))

    def _tie(self, name: str, t: float) -> None:
        """Let an open joint hold what there is at a time [s]; its impact is still to come.

        Raises
        ------
        JointFailure
            If it is a rope that is too short for that, or a stop that is passed already.
        """
        joints, spec = self._joints, self._level.joints[name]
        together = joints.together
        assert together
        start = together.place()
        if isinstance(spec, Pivot | Motor):
            a, b = _from(self._origin, joints.paths[name])
            there = Anchor(a.body, where(a, b, start))
            joints.paths[name] = _from(-self._origin, (there, b))
        together.add(*self._equations(name, spec, start))
        given = isinstance(spec, Stop | AngleStop) or getattr(spec, "length", None) is not None
        if not given:
            together.keep(t)
        elif (beyond := together.beyond(t)) > NEAR:
            rule = f"'{name}' is tied where what it holds is {beyond:.3g} beyond its bounds already"
            raise JointFailure(name, rule)
        self._make_one(name)

    def _take_ours(self) -> tuple[list[Row], list[Equation]]:
        """Make the joints that pymunk does not solve, and return what is to be solved together."""
        level, values, joints, lengths = self._level, self._values, self._joints, self._lengths
        rows: list[Row] = []
        others: list[Equation] = []
        start = _coordinates(self._bodies, self._origin)
        for name, spec in _ours(level).items():
            _require_made(spec)
            if isinstance(spec, Spring):
                joints.springs[name] = _spring(spec, joints.paths[name], lengths[name], values)
            elif isinstance(spec, Pulley) and is_alone(name, level):
                joints.strings[name] = _string(name, spec, self._bodies, lengths[name], values)
            elif name not in self._open and getattr(spec, "restitution", None) is None:
                new_rows, new_others = self._equations(name, spec, start)
                rows += new_rows
                others += new_others
        return rows, others

    def _equations(
        self, name: str, spec: Joint, start: Coordinates
    ) -> tuple[list[Row], Sequence[Equation]]:
        """Return the equations of a joint that is solved with others, from where bodies are."""
        joints, values = self._joints, self._values
        path = _from(self._origin, joints.paths[name])
        if isinstance(spec, Lengths):
            return _rows(name, spec, path, self._lengths[name], values), ()
        if isinstance(spec, Turning):
            return self._turning(name, spec, path, start)
        assert isinstance(spec, Wire)
        wire = WireEquation(name, path[0], course(spec, values) - self._origin)
        joints.wires[name] = wire
        joints.paths[name] = tuple(Anchor(None, p) for p in along(spec, values, DRAWN))
        return [], (wire,)

    def _take_own(self) -> None:
        """Make the joints that pymunk solves, and put them into the space of their bodies."""
        values, bodies, joints = self._values, self._bodies, self._joints
        for name, spec in self._level.joints.items():
            if isinstance(spec, Own) and not spec.exact:
                space = next(iter(bodies.values())).space
                assert space
                known = [*bodies.values(), space.static_body]
                a, b = (
                    (known[-1 if end.body is None else end.body], (end.point.real, end.point.imag))
                    for end in joints.paths[name]
                )
                given = getattr(spec, "length", None)
                whole = self._lengths[name] if given is None else given(values)
                turns = self._can_turn(*joints.paths[name])
                joints.own[name] = OwnJoint(spec, values, (a, b), whole, turns=turns)
                space.add(*joints.own[name].constraints)

    def _turning(
        self,
        name: str,
        spec: Turning,
        path: tuple[Anchor, ...],
        start: Coordinates,
    ) -> tuple[list[Row], Sequence[Equation]]:
        (a, b), values, radii = path, self._values, self._joints.radii
        match spec:
            case Pivot():
                return pin(name, a, b), ()
            case Weld():
                return self._weld(name, a, b, start)
            case Motor(rate=rate):
                driven = turn(name, a, b, start, _driven(rate, values))
                return pin(name, a, b), (driven,) if self._can_turn(a, b) else ()
            case AngleStop(range=(least, most)):
                limits = angle_stops(name, a, b, least(values), most(values))
                return [], limits if self._can_turn(a, b) else ()
            case Gear(ratio=ratio, carrier=carrier):
                arm = Anchor(None if carrier is None else self._index[carrier])
                held = geared(name, a, b, ratio(values), number(arm))
                return [], (starting(held, start),) if self._can_turn(a, b, arm) else ()
            case Rack(radius=radius, direction=direction):
                along = complex(*evaluate(direction, values))
                return [], (starting(meshed(name, a, b, radius(values), along), start),)
            case Winding(radius=radius, unwinds=way):
                radii[name] = radius(values)
                sense = 1 if way == "counterclockwise" else -1
                return [], (winding(name, a, b, radii[name], sense, start),)

    def _weld(
        self, name: str, a: Anchor, b: Anchor, start: Coordinates
    ) -> tuple[list[Row], Sequence[Equation]]:
        rows, others = weld(name, a, b, start)
        return rows, others if self._can_turn(a, b) else ()

    def _can_turn(self, *anchors: Anchor) -> bool:
        held = [anchor.body for anchor in anchors if anchor.body is not None]
        return bool(self._inverse_mass[held, 2].any())


def _require_made(joint: Model) -> None:
    """Refuse a joint that nothing here makes, which mypy tells before."""
    if not isinstance(joint, Lengths | Turning | Wire | Spring):
        rule = f"take up {type(joint).__name__} in sandbox/physics/joints/assembly.py"
        raise IncompleteError(f"a joint is made by nothing: {rule}")


def _ours(level: Level) -> dict[str, Joint]:
    """Return the joints that pymunk does not solve, by name."""
    return {name: j for name, j in level.joints.items() if is_exact(j) or j.kind.force}


def _anchor(end: End, index: Mapping[str, int], values: Values) -> Anchor:
    if isinstance(end, str):
        return Anchor(index[end])
    if isinstance(end, Held):
        return Anchor(index[end.body], complex(*evaluate(end.at, values)))
    return Anchor(None, complex(*evaluate(end, values)))


def _string(
    name: str, spec: Pulley, bodies: Mapping[str, pymunk.Body], path: float, values: Values
) -> PulleyString:
    first, second = (_holder(end, bodies, values) for end in spec.ends)
    pegs: tuple[XY, ...] = tuple(evaluate(cast("Point", peg), values) for peg in spec.over)
    length = spec.length(values) if spec.length else path
    return PulleyString(name, (first, second), pegs, length)


def _holder(end: End, bodies: Mapping[str, pymunk.Body], values: Values) -> pymunk.Body:
    if isinstance(end, str):
        return bodies[end]
    nail = pymunk.Body(body_type=pymunk.Body.STATIC)
    nail.position = evaluate(cast("Point", end), values)
    return nail


def _spring(spec: Spring, path: tuple[Anchor, ...], distance: float, values: Values) -> SpringForce:
    length = distance if spec.length is None else spec.length(values)
    law = Law(spec.law, values) if spec.law else None
    return SpringForce(
        (path[0], path[-1]),
        spec.stiffness(values),
        length,
        spec.damping(values),
        spec.pushes_only,
        law,
        law.slope(distance - length) if law else 0.0,
    )


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
        case Rod(length=None):
            return [Row(name, reaches, span)]
        case Rod(length=Formula() as length) if "t" in length.names:
            return [Row(name, reaches, 0.0, changing=_in_time(length, values))]
        case Rod(length=Formula() as length):
            return [Row(name, reaches, length(values))]
        case Rope(length=length) | Pulley(length=length):
            whole = span if length is None else length(values)
            moving = [(a, b) for a, b in reaches if a.body != b.body]
            still = sum(abs(b.point - a.point) for a, b in reaches if a.body == b.body)
            return [Row(name, moving, whole - still, pulls_only=True)]
    raise AssertionError(spec)


def _in_time(length: Formula, values: Values) -> Callable[[float], float]:
    return lambda t: float(length.over(values, np.asarray(t)))


def _driven(rate: Formula, values: Values) -> Callable[[float], float]:
    """Return what tells the angle that a motor has turned by, from one time asked for to the next.

    By the midpoint rule: leapfrog's velocity between two steps is that of the middle.
    """
    if "t" not in rate.names:
        steady = rate(values)
        return lambda t: steady * t
    turned, reached = 0.0, 0.0

    def angle(t: float) -> float:
        nonlocal turned, reached
        middle = np.asarray((reached + t) / 2)
        turned, reached = turned + (t - reached) * float(rate.over(values, middle)), t
        return turned

    return angle


def _origin(bodies: Mapping[str, pymunk.Body]) -> complex:
    """Return from where places are counted [m]: from among bodies that are far away."""
    middle = sum(complex(*body.position) for body in bodies.values()) / len(bodies)
    return middle if abs(middle) > FAR else 0j


def _from(origin: complex, path: tuple[Anchor, ...]) -> tuple[Anchor, ...]:
    """Return points through which a joint runs, those of the plane from another origin."""
    return tuple(a if a.body is not None else Anchor(None, a.point - origin) for a in path)


def _coordinates(bodies: Mapping[str, pymunk.Body], origin: complex) -> Coordinates:
    """Return where bodies are at the start, the plane itself last."""
    places = [complex(*body.position) - origin for body in bodies.values()]
    angles = [body.angle for body in bodies.values()]
    return Coordinates.of(np.array([*places, 0j]), np.array([*angles, 0.0]))
