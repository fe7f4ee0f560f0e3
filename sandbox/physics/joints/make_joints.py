"""Makes the joints of a scene: exact ones, springs, and those that pymunk solves.

A plain string over pegs that shares no body with another exact joint is solved by itself, which is
five times as fast. All other exact joints are solved together. pymunk solves joints that are not
exact.
"""

from collections.abc import Collection, Mapping
from math import fsum
from typing import cast

import numpy as np
import pymunk

from sandbox.model.base import Model
from sandbox.model.contact_solver_choice import lone_strings
from sandbox.model.events import rebounding_stops, stops_without_rebound, tied_joints
from sandbox.model.expressions import Array, Values
from sandbox.model.joint_ends_at_start import span
from sandbox.model.joints import (
    AngleStop,
    End,
    Held,
    Motor,
    Pivot,
    Pulley,
    Spring,
    Stop,
    Weld,
    bodies_of,
    is_exact,
    is_solved_by_pymunk,
    points,
)
from sandbox.model.level import Level
from sandbox.model.shapes import XY, Point, evaluate
from sandbox.model.translatable_message import Message
from sandbox.physics.engine.space_arrays import Batch
from sandbox.physics.forces.spring import Law, SpringForce
from sandbox.physics.joints.composite_bodies import Solids, Touches
from sandbox.physics.joints.exact.angle_equations import where
from sandbox.physics.joints.exact.constraint_interface import Coordinates, Equation
from sandbox.physics.joints.exact.distance_equations import Row
from sandbox.physics.joints.exact.joint_failures import refuse_too_many
from sandbox.physics.joints.exact.joint_system import JointSystem
from sandbox.physics.joints.exact.shake import ExactJoints
from sandbox.physics.joints.make_joint_equations import (
    JointEquations,
    Solved,
    counted_from,
    not_made,
)
from sandbox.physics.joints.pulley import PulleyString
from sandbox.physics.joints.pymunk_joints import OwnJoint
from sandbox.physics.joints.scene_joints import Joints, Latches
from sandbox.physics.state.joint_anchors import Anchor
from sandbox.physics.state.simulation_errors import JointFailure

NEAR = 1e-9
"""m or rad, the largest violation of a rope or stop at the time when it is tied."""

FAR = 1e4
"""m, the distance from the plane's origin beyond which exact joints use the centre of the bodies as
origin: there, the rounding of positions exceeds the accuracy of joints."""


def assemble(
    level: Level,
    values: Values,
    bodies: Mapping[str, pymunk.Body],
    batch: Batch,
    inverse_mass: Array,
    touches: Touches | None = None,
    *,
    direct: bool = False,
    bounces: bool = False,
) -> Joints:
    """Make the joints of a scene of n bodies.

    `inverse_mass` is (n, 3), the inverse mass, mass and moment of inertia, 0 of bodies that do not
    move or turn [1/kg, 1/(kg m²)]. `touches` finds the pairs to stick together that have met. If
    `direct`, contacts are solved together with the exact joints, even if there are none; and if
    it `bounces`, with the stops that rebound.
    """
    assembly = _Assembly(level, values, bodies, inverse_mass, touches, bounces=bounces)
    return assembly.joints(batch, direct=direct)


class _Assembly:
    """Makes the joints one by one; for the parameters see `assemble`."""

    def __init__(
        self,
        level: Level,
        values: Values,
        bodies: Mapping[str, pymunk.Body],
        inverse_mass: Array,
        touches: Touches | None,
        *,
        bounces: bool,
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
        self._open = tied_joints(level.events)
        rebounds = {name: e(values) for name, e in rebounding_stops(level.joints)}
        self._rebounds = rebounds if bounces else {}
        self._bounce = [] if bounces else [*rebounds]
        if self._bounce:
            self._bounce += stops_without_rebound(level.joints, level.events)
        if self._open:
            self._joints.latches = Latches(self._open, self._tie)
        self._origin = _origin(bodies)
        self._equations = JointEquations(
            values, index, inverse_mass, self._lengths, self._joints, self._origin
        )

    def joints(self, batch: Batch, *, direct: bool) -> Joints:
        """Return all joints."""
        joints, level = self._joints, self._level
        self._take_own()
        rows, others = self._take_ours()
        later = bool(self._open - joints.springs.keys()) or bool(self._bounce)
        if rows or others or later or level.effects.sticking or direct:
            inverse_mass = self._inverse_mass[:, 0], self._inverse_mass[:, 2]
            refuse_too_many((*rows, *others), inverse_mass[0])
            joints.together = ExactJoints(rows, others, batch, *inverse_mass, self._origin)
            joints.together.rebounds = self._rebounds
        for name in level.joints:
            if name not in self._open:
                self._make_one(name)
        joints.elastic = self._elastic(batch)
        return joints

    def _elastic(self, batch: Batch) -> JointSystem | None:
        """Return the sides of elastic stops, and what is beside them; None if there are none."""
        start = _coordinates(self._bodies, self._origin)
        made = [self._equations.of(name, self._solved(name), start) for name in self._bounce]
        rows = [row for some, _ in made for row in some]
        others = [other for _, some in made for other in some]
        if not (rows or others):
            return None
        inverse_mass = self._inverse_mass[:, 0], self._inverse_mass[:, 2]
        return JointSystem(rows, others, batch, *inverse_mass, self._origin)

    def _make_one(self, name: str) -> None:
        """Join two bodies into one solid if the joint is a weld."""
        joint, solids = self._level.joints[name], self._joints.solids
        assert solids
        if isinstance(joint, Weld) and len(held := tuple(bodies_of(joint))) == 2:
            solids.join(held[0], held[1], name)

    def _weld_where_they_are(self, a: str, b: str) -> None:
        together = self._joints.together
        assert together
        ends = Anchor(self._index[a]), Anchor(self._index[b])
        together.add(*self._equations.weld(f"{a} and {b}", *ends, together.pose()))

    def _solved(self, name: str) -> Solved:
        """Return the model of a joint that is not a spring."""
        spec = self._level.joints[name]
        assert not isinstance(spec, Spring)
        return spec

    def _tie(self, names: Collection[str], t: float) -> None:
        """Tie open joints, which keep their values at a time [s]; their impact is not solved here.

        A `JointFailure` says that one exceeds its given length or bounds already.
        """
        joints, together = self._joints, self._joints.together
        assert together
        start = together.pose()
        rows: list[Row] = []
        others: list[Equation] = []
        for name in names:
            if isinstance(spec := self._solved(name), Pivot | Motor):
                a, b = counted_from(self._origin, joints.paths[name])
                there = Anchor(a.body, where(a, b, start))
                joints.paths[name] = counted_from(-self._origin, (there, b))
            new_rows, new_others = self._equations.of(name, spec, start)
            rows += new_rows
            others += new_others
        together.add(rows, others)
        given = {name for name in names if _is_given(self._solved(name))}
        together.keep(set(names) - given, t)
        name, beyond = together.largest_excess(given, t)
        if beyond > NEAR:
            rule = Message(
                "'{name}' is tied when its ends are already {beyond:.3g} beyond its bounds",
                name=name,
                beyond=beyond,
            )
            raise JointFailure(name, rule)
        for name in names:
            self._make_one(name)

    def _take_ours(self) -> tuple[list[Row], list[Equation]]:
        """Make the joints that pymunk does not solve, and return those to be solved together."""
        level, values, joints, lengths = self._level, self._values, self._joints, self._lengths
        rows: list[Row] = []
        others: list[Equation] = []
        start, lone = _coordinates(self._bodies, self._origin), lone_strings(level)
        for name, spec in level.joints.items():
            if not (is_exact(spec) or spec.kind.force):
                continue
            _require_made(spec)
            if isinstance(spec, Spring):
                joints.springs[name] = make_spring(spec, joints.paths[name], lengths[name], values)
            elif isinstance(spec, Pulley) and name in lone:
                joints.strings[name] = make_string(name, spec, self._bodies, lengths[name], values)
            elif name not in self._open and name not in self._bounce:
                new_rows, new_others = self._equations.of(name, spec, start)
                rows += new_rows
                others += new_others
        return rows, others

    def _take_own(self) -> None:
        """Make the joints that pymunk solves, and add them to the space of their bodies."""
        values, bodies, joints = self._values, self._bodies, self._joints
        for name, spec in self._level.joints.items():
            if is_solved_by_pymunk(spec):
                space = next(iter(bodies.values())).space
                assert space
                known = [*bodies.values(), space.static_body]
                a, b = (
                    (known[-1 if end.body is None else end.body], (end.point.real, end.point.imag))
                    for end in joints.paths[name]
                )
                given = getattr(spec, "length", None)
                whole = self._lengths[name] if given is None else given(values)
                turns = self._equations.can_turn(*joints.paths[name])
                joints.own[name] = OwnJoint(spec, values, (a, b), whole, turns=turns)
                space.add(*joints.own[name].constraints)


def _is_given(joint: Solved) -> bool:
    """Whether a joint has a length or bounds of its own, instead of those at which it is tied."""
    return isinstance(joint, Stop | AngleStop) or getattr(joint, "length", None) is not None


def _require_made(joint: Model) -> None:
    """Refuse a joint without a case here, which mypy reports as well."""
    if not isinstance(joint, Solved | Spring):
        raise not_made(joint)


def _anchor(end: End, index: Mapping[str, int], values: Values) -> Anchor:
    if isinstance(end, str):
        return Anchor(index[end])
    if isinstance(end, Held):
        return Anchor(index[end.body], complex(*evaluate(end.at, values)))
    return Anchor(None, complex(*evaluate(end, values)))


def _origin(bodies: Mapping[str, pymunk.Body]) -> complex:
    """Return the origin of positions [m]: the centre of the bodies, if that is far away, else 0."""
    positions = [body.position for body in bodies.values()]
    middle = complex(fsum(p.x for p in positions), fsum(p.y for p in positions)) / len(positions)
    return middle if abs(middle) > FAR else 0j


def _coordinates(bodies: Mapping[str, pymunk.Body], origin: complex) -> Coordinates:
    """Return the positions at the start, the plane itself last."""
    positions = [complex(*body.position) - origin for body in bodies.values()]
    angles = [body.angle for body in bodies.values()]
    return Coordinates.of(np.array([*positions, 0j]), np.array([*angles, 0.0]))


def make_string(
    name: str, spec: Pulley, bodies: Mapping[str, pymunk.Body], path: float, values: Values
) -> PulleyString:
    """Return a plain string over pegs; its length is that of its path [m] unless given."""
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


def make_spring(
    spec: Spring, path: tuple[Anchor, ...], distance: float, values: Values
) -> SpringForce:
    """Return the force law of a spring; its length is the distance of its ends [m] unless given."""
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
