"""The joints of a scene: what holds exactly, and what pulls like a spring.

A plain string over pegs that shares no body with another exact joint is solved by itself, which is
five times as fast. All other exact joints are solved together. pymunk solves what is not exact.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple, cast

import numpy as np
import pymunk

from sandbox.model.expressions import Array, Formula, Values
from sandbox.model.joints import (
    End,
    Held,
    Joint,
    Motor,
    Own,
    Pivot,
    Pulley,
    Rail,
    Rod,
    Rope,
    Spring,
    Weld,
    Winding,
    Wire,
    bodies_of,
    is_exact,
    points,
)
from sandbox.model.level import Level, is_alone, is_direct, span
from sandbox.model.shapes import XY, Point, evaluate
from sandbox.model.wires import along
from sandbox.physics.engine.batch import Batch, Booleans
from sandbox.physics.forces.spring import SpringForce
from sandbox.physics.joints.composites import Solids, Touches
from sandbox.physics.joints.exact.angles import pin, turn, weld, winding
from sandbox.physics.joints.exact.constraints import Coordinates, Equation
from sandbox.physics.joints.exact.distances import Row
from sandbox.physics.joints.exact.shake import ExactJoints
from sandbox.physics.joints.exact.wire import WireEquation
from sandbox.physics.joints.native import OwnJoint
from sandbox.physics.joints.pulley import PulleyString
from sandbox.physics.state.anchor import Anchor, length
from sandbox.physics.state.kick import Kick
from sandbox.physics.state.motion import Motion

Lengths = Rod | Rope | Pulley | Rail
Turning = Pivot | Weld | Motor | Winding

DRAWN = 200
"""How many pieces of a wire are shown."""

FAR = 1e4
"""m from the plane's origin, beyond which exact joints count places from among their bodies: there,
a float knows a place worse than joints are kept."""


class Pulls(NamedTuple):
    """What exact joints did in a kick; m equations, n bodies.

    Attributes
    ----------
    gradient
        (m, n, 3), how what they keep changes with the bodies' places and angles.
    tension
        (m,), the force against that [N].
    pulls_only
        (m,), whether they may be shorter, as ropes.
    changes
        (m,), whether what they keep changes with time.
    """

    gradient: Array
    tension: Array
    pulls_only: Booleans
    changes: Booleans


class Joints:
    """All joints of a scene; j of them, in the level's order.

    Parameters
    ----------
    level, values
        What says which there are.
    bodies, batch
        What they hold, and what reads and writes it; n of them.
    agility
        (n, 3), one over mass, mass and moment, 0 of what nothing moves or turns [1/kg, 1/(kg m²)].
    touches
        Tells which of the pairs that stick have met; None if none do.

    Attributes
    ----------
    springs
        Those that are force laws, by name.
    strings
        Those that are solved by themselves, by name.
    own
        Those that pymunk solves, by name.
    together
        All other exact ones; None if there are none.
    paths
        The points that each runs through, by name; of a wire, points of its curve.
    touches
        Tells which of the pairs that stick have met; None if none do.
    lines
        The names of rods, ropes and strings, which swing across when they are taut.
    solids
        Who is welded or stuck to whom.
    radii
        Of the circles on which strings are wound, by name [m].
    """

    def __init__(
        self,
        level: Level,
        values: Values,
        bodies: Mapping[str, pymunk.Body],
        batch: Batch,
        agility: Array,
        touches: Touches | None = None,
    ) -> None:
        self._index = index = {name: i for i, name in enumerate(bodies)}
        lengths = {name: span(spec, level.bodies, values) for name, spec in level.joints.items()}
        self.paths = {
            name: tuple(_anchor(end, index, values) for end in points(spec))
            for name, spec in level.joints.items()
        }
        reaching = Rod | Rope | Pulley | Winding
        self.lines = [n for n, spec in level.joints.items() if isinstance(spec, reaching)]
        self.wires: dict[str, WireEquation] = {}
        self.springs: dict[str, SpringForce] = {}
        self.strings: dict[str, PulleyString] = {}
        self.together: ExactJoints | None = None
        self.touches = touches
        self.radii: dict[str, float] = {}
        self._fixtures = any(isinstance(j, Weld | Motor) for j in level.joints.values())
        self._inverse_moment = agility[:, 2]
        self.own = self._take_own(level, bodies, lengths, values)
        origin = _origin(bodies)
        rows, others = self._take_ours(level, bodies, lengths, values, origin)
        if rows or others or level.effects.sticking or is_direct(level):
            self.together = ExactJoints(rows, others, batch, agility[:, 0], agility[:, 2], origin)
        together = (self.together,) if self.together else ()
        self._solved = (*self.own.values(), *together)
        self.solids = Solids(bodies)
        for a, b in _welded(level):
            self.solids.join(a, b)

    def _take_ours(
        self,
        level: Level,
        bodies: Mapping[str, pymunk.Body],
        lengths: Mapping[str, float],
        values: Values,
        origin: complex,
    ) -> tuple[list[Row], list[Equation]]:
        """Make the joints that pymunk does not solve, and return what is to be solved together."""
        rows: list[Row] = []
        others: list[Equation] = []
        start = _coordinates(bodies, origin)
        for name, spec in _ours(level).items():
            path = _from(origin, self.paths[name])
            if isinstance(spec, Wire):
                curve = along(spec, values) - origin
                self.wires[name] = WireEquation(name, self.paths[name][0], curve)
                self.paths[name] = tuple(Anchor(None, p) for p in along(spec, values, DRAWN))
                others.append(self.wires[name])
            elif isinstance(spec, Spring):
                self.springs[name] = _spring(spec, self.paths[name], lengths[name], values)
            elif isinstance(spec, Pulley) and is_alone(name, level):
                self.strings[name] = _string(name, spec, bodies, lengths[name], values)
            elif isinstance(spec, Lengths):
                rows += _rows(name, spec, path, lengths[name], values)
            else:
                new_rows, new_others = self._turning(name, spec, path, start, values)
                rows += new_rows
                others += new_others
        return rows, others

    def _take_own(
        self,
        level: Level,
        bodies: Mapping[str, pymunk.Body],
        lengths: Mapping[str, float],
        values: Values,
    ) -> dict[str, OwnJoint]:
        """Make the joints that pymunk solves, and put them into the space of their bodies."""
        own: dict[str, OwnJoint] = {}
        for name, spec in level.joints.items():
            if isinstance(spec, Own) and not spec.exact:
                space = next(iter(bodies.values())).space
                assert space
                known = [*bodies.values(), space.static_body]
                a, b = (
                    (known[-1 if end.body is None else end.body], (end.point.real, end.point.imag))
                    for end in self.paths[name]
                )
                given = getattr(spec, "length", None)
                whole = lengths[name] if given is None else given(values)
                turns = self._can_turn(*self.paths[name])
                own[name] = OwnJoint(spec, values, (a, b), whole, turns=turns)
                space.add(*own[name].constraints)
        return own

    def _turning(
        self,
        name: str,
        spec: Turning,
        path: tuple[Anchor, ...],
        start: Coordinates,
        values: Values,
    ) -> tuple[list[Row], Sequence[Equation]]:
        a, b = path
        match spec:
            case Pivot():
                return pin(name, a, b), ()
            case Weld():
                return self._weld(name, a, b, start)
            case Motor(rate=rate):
                driven = turn(name, a, b, start, _driven(rate, values))
                return pin(name, a, b), (driven,) if self._can_turn(a, b) else ()
            case Winding(radius=radius, unwinds=way):
                self.radii[name] = radius(values)
                sense = 1 if way == "counterclockwise" else -1
                return [], (winding(name, a, b, self.radii[name], sense, start),)

    def _weld(
        self, name: str, a: Anchor, b: Anchor, start: Coordinates
    ) -> tuple[list[Row], Sequence[Equation]]:
        rows, others = weld(name, a, b, start)
        return rows, others if self._can_turn(a, b) else ()

    def _can_turn(self, *anchors: Anchor) -> bool:
        held = [anchor.body for anchor in anchors if anchor.body is not None]
        return bool(self._inverse_moment[held].any())

    def _stick(self, _kick: Kick) -> None:
        """Weld those that have just met where they are."""
        assert self.together
        assert self.touches
        self.touches.end_step()
        for a, b in self.touches.latest:
            if self.solids.join(a, b):
                ends = Anchor(self._index[a]), Anchor(self._index[b])
                place = self.together.place()
                self.together.add(*self._weld(f"{a} and {b}", *ends, place))

    def length(self, name: str, motion: Motion) -> Array:
        """Return how long a joint is, from end to end, or as far as it is not wound [m]."""
        distance = length(self.paths[name], motion)
        radius = self.radii.get(name)
        return distance if radius is None else np.sqrt(distance**2 - radius**2)

    def solvers(self, *, alone: bool) -> list[Callable[[Kick], None]]:
        """Return what must run after pymunk's solver.

        Parameters
        ----------
        alone
            Whether the exact joints are solved without contacts, and therefore here.
        """
        work: list[Callable[[Kick], None]] = [string.solve for string in self.strings.values()]
        if self.touches:
            work.append(self._stick)
        if alone and (together := self.together):
            work.append(lambda kick: together.solve(kick.until))
        return work

    def time(self, kick: float, drift: float) -> None:
        """Set how long the next kicks last, and the drift that follows each [s]."""
        for joint in self._solved:
            joint.time(kick, drift)

    def refit(self, t: float) -> None:
        """Take the present lengths as those that hold from a time on [s]."""
        for string in self.strings.values():
            string.refit()
        for own in self.own.values():
            own.refit()
        for wire in self.wires.values():
            wire.forget()
        if self.together:
            self.together.refit(t)

    def parting(self) -> tuple[str, float]:
        """Return which of those solved together is furthest off, and by how much [m, rad]."""
        return self.together.parting() if self.together else ("", 0.0)

    def tension(self, motion: Motion) -> Array:
        """Return the force with which each joint pulled in the last kick, or pulls now [N]."""
        return np.array([self._tension(name, motion) for name in self.paths])

    def pulls(self, count: int) -> Pulls:
        """Return what the exact joints did in the last kick, to so many bodies."""
        parts = [
            _of_string(string, [self.paths[name][end].body for end in (0, -1)], count)
            for name, string in self.strings.items()
        ]
        if joints := self.together:
            parts.append(
                Pulls(joints.gradients(), joints.tension, joints.pulls_only, joints.changes)
            )
        if not parts:
            none = np.zeros(0, dtype=bool)
            return Pulls(np.zeros((0, count, 3)), np.zeros(0), none, none)
        return Pulls(*(np.concatenate(column) for column in zip(*parts, strict=True)))

    def _tension(self, name: str, motion: Motion) -> float:
        if name in self.strings:
            return self.strings[name].tension
        if name in self.own:
            return self.own[name].tension
        if name in self.springs:
            return float(self.springs[name].tension(motion))
        assert self.together
        force = self.together.force(name)
        return abs(force) if name in self.wires else force

    def torque(self) -> Array:
        """Return the torque of each joint on its second body in the last kick [N m]."""
        torque = np.zeros(len(self.paths))
        if self._fixtures:
            for i, name in enumerate(self.paths):
                if name in self.own:
                    torque[i] = self.own[name].torque
                elif self.together:
                    torque[i] = self.together.torque(name)
        return torque


def _of_string(string: PulleyString, rows: Sequence[int | None], count: int) -> Pulls:
    gradient = np.zeros((1, count, 3))
    for row, direction in zip(rows, string.gradient(), strict=True):
        if row is not None:
            gradient[0, row, :2] += direction
    return Pulls(gradient, np.array([string.tension]), np.array([True]), np.array([False]))


def _ours(level: Level) -> dict[str, Joint]:
    """Return the joints that pymunk does not solve, by name."""
    return {name: j for name, j in level.joints.items() if is_exact(j) or isinstance(j, Spring)}


def _anchor(end: End, index: Mapping[str, int], values: Values) -> Anchor:
    if isinstance(end, str):
        return Anchor(index[end])
    if isinstance(end, Held):
        return Anchor(index[end.body], complex(*evaluate(end.at, values)))
    return Anchor(None, complex(*evaluate(end, values)))


def _welded(level: Level) -> Iterator[tuple[str, str]]:
    """Yield the pairs of bodies that are welded from the start."""
    for joint in level.joints.values():
        if isinstance(joint, Weld) and len(held := tuple(bodies_of(joint))) == 2:
            yield held[0], held[1]


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
    name: str, spec: Lengths, path: tuple[Anchor, ...], span: float, values: Values
) -> list[Row]:
    reaches = list(pairwise(path))
    match spec:
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
