"""Static friction that is stronger than kinetic friction.

The friction of a sticking contact is at most the static coefficient times the normal force. Once it
needs more it slips, and the kinetic coefficient applies until the slip has stopped. pymunk has one
coefficient per contact: it is set to the right one before each solve.

The instant at which a contact breaks loose is interpolated linearly from the loads of the last two
steps. For the rest of that step its friction is lowered to the kinetic value. So the velocity after
the step is of second order.
"""

from dataclasses import dataclass, field
from itertools import combinations
from typing import NamedTuple

import pymunk
from pymunk import Vec2d

from sandbox.model.expressions import Values
from sandbox.model.level import Level
from sandbox.physics.contacts.coefficients.pair_coefficients import (
    own_coefficient,
    own_static_coefficient,
)

ROUNDING = 1e-9
"""Friction counts as being at its limit if it is below by less than this share."""

AT_REST = 1e-9
"""m/s, the relative speed of surfaces below which a new contact sticks."""

FLAT = 2
"""The number of contact points of a flat side, on which friction does not rotate the body."""


class Load(NamedTuple):
    """The friction impulses of a sticking contact in the last two steps [N s]."""

    last: float
    before: float | None = None


class BreakawayImpulse(NamedTuple):
    """The impulse by which the friction of a contact was lowered when it broke loose."""

    body: int
    """The index of one of the two bodies."""
    impulse: Vec2d
    """On that body; that on the other is opposite [N s]."""
    points: tuple[Vec2d, Vec2d]
    """Where the impulses on it and on the other act [m]."""


Memory = tuple[set[frozenset[pymunk.Shape]], dict[frozenset[pymunk.Shape], Load]]
"""The slipping contacts, and the loads of the others."""


@dataclass(slots=True)
class Sticking:
    """The friction between two bodies whose static and kinetic coefficients differ."""

    static: float
    kinetic: float
    slipping: set[frozenset[pymunk.Shape]]
    loads: dict[frozenset[pymunk.Shape], Load]
    must_slip: bool = False
    """whether it slips, regardless of the solver"""
    freed: dict[frozenset[pymunk.Shape], BreakawayImpulse] = field(default_factory=dict)
    """of the contacts that broke loose in the last kick"""

    @classmethod
    def between(cls, static: float, kinetic: float) -> "Sticking":
        """Return the friction of a pair without contact yet."""
        return cls(static, kinetic, set(), {})

    def choose(self, arbiter: pymunk.Arbiter) -> None:
        """Set the coefficient of a contact before it is solved."""
        contact = frozenset(arbiter.shapes)
        self.freed.pop(contact, None)
        if self.must_slip:
            arbiter.friction = self.kinetic
            return
        if arbiter.is_first_contact:
            self.loads.pop(contact, None)
            self._note(contact, slips=abs(_slip(arbiter)) > AT_REST)
        arbiter.friction = self.kinetic if contact in self.slipping else self.static

    def judge(self, arbiter: pymunk.Arbiter) -> None:
        """Determine whether a solved contact sticks or slips."""
        if self.must_slip:
            return
        contact = frozenset(arbiter.shapes)
        impulse, direction = arbiter.total_impulse, arbiter.normal
        normal, friction = abs(impulse.dot(direction)), abs(impulse.cross(direction))
        limit = arbiter.friction * normal
        if not limit:
            return
        slips = friction > limit * (1 - ROUNDING)
        if slips and contact not in self.slipping:
            slips = abs(_slip(arbiter)) > AT_REST
        if slips and contact not in self.slipping:
            self._break_loose(arbiter, normal, self.loads.get(contact))
        self._note(contact, slips=slips)
        if not slips:
            load = self.loads.get(contact)
            self.loads[contact] = Load(friction, load and load.last)

    def set_slipping(self, *, slips: bool) -> None:
        """Force it to slip, or let it stick as long as friction is strong enough."""
        self.must_slip = slips
        if not slips:
            self.slipping.clear()

    def memory(self) -> Memory:
        """Return the state of its contacts."""
        return set(self.slipping), dict(self.loads)

    def restore(self, memory: Memory) -> None:
        """Restore the state of its contacts."""
        self.slipping, self.loads = set(memory[0]), dict(memory[1])

    def _note(self, contact: frozenset[pymunk.Shape], *, slips: bool) -> None:
        if slips:
            self.slipping.add(contact)
            self.loads.pop(contact, None)
        else:
            self.slipping.discard(contact)

    def _break_loose(self, arbiter: pymunk.Arbiter, normal: float, load: Load | None) -> None:
        """Remove the excess of friction since the contact broke loose."""
        slip = _slip(arbiter)
        if load is None or not slip:
            return
        excess = (
            (self.static - self.kinetic)
            * normal
            * _steps_since_breakaway(load, self.static * normal)
        )
        impulse = arbiter.normal.perpendicular() * (excess if slip > 0 else -excess)
        first, second = points = _points(arbiter)
        row = arbiter.shapes[1].collision_type - 1
        self.freed[frozenset(arbiter.shapes)] = BreakawayImpulse(row, impulse, (second, first))
        for body, change, point in zip(arbiter.bodies, (-impulse, impulse), points, strict=True):
            if body.body_type == pymunk.Body.DYNAMIC:
                body.apply_impulse_at_world_point(change, point)


def sticking(level: Level, values: Values) -> dict[tuple[str, str], Sticking]:
    """Return the friction of each pair whose static coefficient is larger than the kinetic one.

    The names of a pair are in order. Coefficients are those that the level gives for the pair, or
    else the products of the bodies'.
    """
    if level.effects.friction is None:
        return {}
    bodies = {name: body for name, body in level.bodies.items() if body.friction is not None}
    stick = {name for name, body in bodies.items() if body.static_friction}
    own = {
        name: (own_static_coefficient(body, values), own_coefficient(body, values, "friction"))
        for name, body in (bodies if stick else {}).items()
    }
    pairs = {
        (a, b): (own[a][0] * own[b][0], own[a][1] * own[b][1])
        for a, b in combinations(sorted(own), 2)
        if a in stick or b in stick
    }
    for named in level.effects.friction.pairs:
        a, b = sorted(named.bodies)
        kinetic = named.coefficient(values)
        pairs[a, b] = (kinetic if named.static is None else named.static(values)), kinetic
    return {
        pair: Sticking.between(static, kinetic)
        for pair, (static, kinetic) in pairs.items()
        if static > kinetic
    }


def _steps_since_breakaway(load: Load, limit: float) -> float:
    """Return the number of steps since a contact broke loose, at the end of this one: 0.5 to 1.5.

    If the load did not grow before, it was applied suddenly: the contact broke loose at this step.
    """
    growth = 0.0 if load.before is None else load.last - load.before
    if growth <= 0:
        return 1.0
    return 1.5 - min(max((limit - load.last) / growth, 0.0), 1.0)


def _slip(arbiter: pymunk.Arbiter) -> float:
    """Return the slip velocity of the second surface relative to the first [m/s]."""
    a, b = arbiter.bodies
    point = arbiter.contact_point_set.points[0].point_a
    relative_velocity: Vec2d = b.velocity_at_world_point(point) - a.velocity_at_world_point(point)
    return float((relative_velocity + arbiter.surface_velocity).dot(arbiter.normal.perpendicular()))


def _points(arbiter: pymunk.Arbiter) -> tuple[Vec2d, Vec2d]:
    """Return where friction acts on the two bodies; on a flat side it has no lever arm."""
    a, b = arbiter.bodies
    points = arbiter.contact_point_set.points
    if len(points) == FLAT:
        return a.position, b.position
    return points[0].point_a, points[0].point_a
