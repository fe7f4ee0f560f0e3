"""The joints of a scene: what holds exactly, and what pulls like a spring.

A plain string over pegs that shares no body with another exact joint is solved by itself, which is
five times as fast. All other exact joints are solved together.
"""

from collections.abc import Callable, Iterator, Mapping
from itertools import pairwise
from typing import TYPE_CHECKING, cast

import numpy as np
import pymunk

from sandbox.model.expressions import Array, Formula, Values
from sandbox.model.joints import (
    End,
    Held,
    Pivot,
    Pulley,
    Rail,
    Rod,
    Rope,
    Spring,
    Wire,
    bodies_of,
    body_of,
    points,
)
from sandbox.model.level import Level, span
from sandbox.model.shapes import XY, Point, evaluate
from sandbox.model.wires import along
from sandbox.physics.anchor import Anchor
from sandbox.physics.batch import Batch
from sandbox.physics.exact.reaches import Row
from sandbox.physics.exact.solver import ExactJoints
from sandbox.physics.exact.wire import WireEquation
from sandbox.physics.laws.spring import SpringForce
from sandbox.physics.motion import Motion
from sandbox.physics.pulley import PulleyString

if TYPE_CHECKING:
    from sandbox.physics.exact.equations import Condition, Equation

Exact = Rod | Rope | Pulley | Pivot | Rail

DRAWN = 200
"""How many pieces of a wire are shown."""


class Joints:
    """All joints of a scene; j of them, in the level's order.

    Attributes
    ----------
    springs
        Those that are force laws, by name.
    strings
        Those that are solved by themselves, by name.
    together
        All other exact ones; None if there are none.
    paths
        The points that each runs through, by name; of a wire, points of its curve.
    """

    def __init__(
        self,
        level: Level,
        values: Values,
        bodies: Mapping[str, pymunk.Body],
        batch: Batch,
        mass: Array,
        moment: Array,
    ) -> None:
        index = {name: i for i, name in enumerate(bodies)}
        lengths = {name: span(spec, level.bodies, values) for name, spec in level.joints.items()}
        self.paths = {
            name: tuple(_anchor(end, index, values) for end in points(spec))
            for name, spec in level.joints.items()
        }
        self.wires: dict[str, WireEquation] = {}
        self.springs: dict[str, SpringForce] = {}
        self.strings: dict[str, PulleyString] = {}
        self.together: ExactJoints | None = None
        rows: list[Row] = []
        others: list[Equation] = []
        for name, spec in level.joints.items():
            if isinstance(spec, Wire):
                curve = along(spec, values)
                self.wires[name] = WireEquation(name, self.paths[name][0], curve)
                self.paths[name] = tuple(Anchor(None, p) for p in along(spec, values, DRAWN))
                others.append(self.wires[name])
            elif isinstance(spec, Spring):
                self.springs[name] = _spring(spec, self.paths[name], lengths[name], values)
            elif isinstance(spec, Pulley) and _is_alone(name, level):
                self.strings[name] = _string(name, spec, bodies, lengths[name], values)
            else:
                rows += _rows(name, spec, self.paths[name], lengths[name], values)
        equations: tuple[Condition, ...] = (*rows, *others)
        if equations:
            self.together = ExactJoints(rows, others, batch, inverse(mass), inverse(moment))
        self._rows = {
            name: [i for i, row in enumerate(equations) if row.joint == name]
            for name in level.joints
        }

    def solvers(self, until: Callable[[], float]) -> list[Callable[[], None]]:
        """Return what must run after pymunk's solver.

        Parameters
        ----------
        until
            Tells the time at the end of the next drift [s].
        """
        work: list[Callable[[], None]] = [string.solve for string in self.strings.values()]
        if together := self.together:
            work.append(lambda: together.solve(until()))
        return work

    def time(self, kick: float, drift: float) -> None:
        """Set how long the next kicks last, and the drift that follows each [s]."""
        for joint in self._solved():
            joint.time(kick, drift)

    def refit(self, t: float) -> None:
        """Take the present lengths as those that hold from a time on [s]."""
        for string in self.strings.values():
            string.refit()
        for wire in self.wires.values():
            wire.forget()
        if self.together:
            self.together.refit(t)

    def tension(self, motion: Motion) -> Array:
        """Return the force with which each joint pulled in the last kick, or pulls now [N]."""
        return np.array([self._tension(name, motion) for name in self.paths])

    def _tension(self, name: str, motion: Motion) -> float:
        if name in self.strings:
            return self.strings[name].tension
        if name in self.springs:
            return float(self.springs[name].tension(motion))
        assert self.together
        parts = self.together.tension[self._rows[name]]
        if name in self.wires:
            return abs(float(parts[0]))
        return float(parts[0] if len(parts) == 1 else np.hypot(*parts))

    def _solved(self) -> Iterator[PulleyString | ExactJoints]:
        yield from self.strings.values()
        if self.together:
            yield self.together


def _anchor(end: End, index: Mapping[str, int], values: Values) -> Anchor:
    if isinstance(end, str):
        return Anchor(index[end])
    if isinstance(end, Held):
        return Anchor(index[end.body], complex(*evaluate(end.at, values)))
    return Anchor(None, complex(*evaluate(end, values)))


def _is_alone(name: str, level: Level) -> bool:
    """Whether a string is plain and shares no body that moves with another exact joint."""
    joint = level.joints[name]
    first, *pegs, last = points(joint)
    if any(isinstance(end, Held) for end in (first, last)) or any(body_of(peg) for peg in pegs):
        return False
    moving = {body for body in bodies_of(joint) if level.bodies[body].type == "dynamic"}
    others = (o for n, o in level.joints.items() if n != name and not isinstance(o, Spring))
    return not any(moving & set(bodies_of(other)) for other in others)


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
    ends, stiffness = (path[0], path[-1]), spec.stiffness(values)
    return SpringForce(ends, stiffness, length, spec.damping(values), spec.pushes_only)


def _rows(
    name: str, spec: Exact, path: tuple[Anchor, ...], span: float, values: Values
) -> list[Row]:
    reaches = list(pairwise(path))
    match spec:
        case Pivot():
            return [Row(name, reaches, 0.0, along=direction) for direction in (1 + 0j, 1j)]
        case Rail(direction=direction):
            way = complex(*evaluate(direction, values))
            return [Row(name, reaches, 0.0, along=1j * way / abs(way))]
        case Rod(length=None):
            return [Row(name, reaches, span)]
        case Rod(length=Formula() as length) if "t" in length.names:
            return [Row(name, reaches, 0.0, changing=_in_time(length, values))]
        case Rod(length=Formula() as length):
            return [Row(name, reaches, length(values))]
        case Rope(length=length) | Pulley(length=length):
            whole = span if length is None else length(values)
            moving = [reach for reach in reaches if any(end.body is not None for end in reach)]
            still = sum(abs(b.point - a.point) for a, b in reaches if (a, b) not in moving)
            return [Row(name, moving, whole - still, pulls_only=True)]
    raise AssertionError(spec)


def _in_time(length: Formula, values: Values) -> Callable[[float], float]:
    return lambda t: float(length.over(values, np.asarray(t)))


def inverse(inertia: Array) -> Array:
    """Return one over a mass or moment, 0 where it is 0: of what nothing moves."""
    return np.divide(1.0, inertia, out=np.zeros_like(inertia), where=inertia > 0)
