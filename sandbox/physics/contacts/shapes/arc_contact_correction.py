"""Contacts of arcs, hoops and curves: pymunk finds them, and the exact geometry corrects them.

Any body within a circle overlaps it, so pymunk finds a contact in every step. Before pymunk solves
it, a callback replaces it by the exact contact, or removes it. Polygons touch an arc from inside,
or a curve, with their corners: each corner gets a small disc, a feeler, that meets nothing else.

A hoop in which no other body of the level fits remains a disc, at no extra cost.
"""

from cmath import rect
from collections.abc import Iterator, Mapping

import pymunk

from sandbox.model.expressions import Array
from sandbox.physics.contacts.shapes.hoop_collision_filter import Enclosures
from sandbox.physics.engine.arbiter_handle import PreSolveContact, address
from sandbox.physics.engine.space_arrays import Contacts
from sandbox.physics.geometry.arc_contacts import Piece, Placed, Touch, Verdict, relative_velocity
from sandbox.physics.geometry.curve_contacts import verdict

Shapes = tuple[int, int]
"""Two shapes of pymunk, by their addresses."""

HIT = 3.0
"""The approach velocity that counts as an impact, as a multiple of that of a body that follows the
arc. A body that comes from a straight line onto the arc has up to twice that."""

SLOWEST = 1e-12
"""m/s: a body on the outside of a curve rests on it if its normal velocity is no larger."""


class Hollows:
    """The arcs and curves of a scene, and the hoops that may contain bodies.

    `pairs` are the pairs of bodies whose contacts may differ from pymunk's, by name, in order, and
    `rows` are their indices. `drift` is the length of the drift after a kick [s]; None if bodies
    need not follow arcs more exactly than with pymunk. `enclosures` excludes contacts between
    bodies that hoops separate.
    """

    def __init__(
        self,
        pairs: Mapping[tuple[str, str], frozenset[int]],
        drift: float | None,
        enclosures: Enclosures,
    ) -> None:
        self.pairs, self._drift, self.enclosures = frozenset(pairs), drift, enclosures
        self.rows = frozenset(pairs.values())
        self._pieces: dict[int, Piece] = {}
        self._shapes: list[pymunk.Shape] = []  # keeps pymunk's shapes alive
        self._touching: dict[Shapes, Touch | None] = {}
        self._along: dict[Shapes, float] = {}

    def know(self, shape: pymunk.Shape, piece: Piece) -> None:
        """Register a shape with its exact geometry."""
        self._shapes.append(shape)
        self._pieces[address(shape)] = piece

    def known(self) -> Iterator[tuple[pymunk.Shape, Piece]]:
        """Yield the registered shapes with their exact geometry."""
        for shape in self._shapes:
            yield shape, self._pieces[address(shape)]

    def correct(self, arbiter: pymunk.Arbiter) -> bool:
        """Correct a contact before it is solved, and return whether there is one."""
        meeting = PreSolveContact(arbiter)
        one, other = meeting.shapes
        pair = min(one, other), max(one, other)  # pymunk may swap them from step to step
        found = self._judge((one, other), *meeting.poses())
        if found is False:
            self._touching.pop(pair, None)
            self._along.pop(pair, None)
            meeting.refuse()
            return False
        meeting.accept(first=pair not in self._touching)
        if found is True:
            self._touching[pair] = None
            return True
        self._touching[pair] = found
        meeting.replace(*self._sides(one, found))
        return True

    def leave(self, arbiter: pymunk.Arbiter) -> None:
        """Forget a contact that was removed elsewhere."""
        one, other = PreSolveContact(arbiter).shapes
        self._touching.pop((min(one, other), max(one, other)), None)
        self._along.pop((min(one, other), max(one, other)), None)

    def sides(self, shape: pymunk.Shape, touch: Touch) -> tuple[complex, complex, complex]:
        """Return the normal from a shape of a contact to the other, and the point on each [m]."""
        return self._sides(address(shape), touch)

    def _sides(self, shape: int, touch: Touch) -> tuple[complex, complex, complex]:
        if self._pieces[shape].body == touch.arc.body:
            return touch.normal, touch.on_arc, touch.on_other
        return -touch.normal, touch.on_other, touch.on_arc

    def follow(self, arbiter: pymunk.Arbiter) -> None:
        """Make a body that touches an arc from inside, or a curve, follow it, unless it bounces.

        pymunk would leave it the velocity along the tangent, which leads out of the arc: each step
        would lose the share (v dt / r)² of v². A body hits the arc if it approaches faster than
        from a straight line onto the arc, which is twice as fast as along it. On the outside of a
        curve it is made to return in the same way: with the velocity for which its distance is the
        same after the drift.
        """
        meeting = PreSolveContact(arbiter)
        one, other = meeting.shapes
        pair = min(one, other), max(one, other)
        found = self._touching.get(pair)
        if found is None or not (found.sign and self._drift):
            return
        poses, motions = meeting.poses(), meeting.motions()
        if self._pieces[one].body != found.arc.body:
            poses, motions = poses[::-1], motions[::-1]
        before = self._along.get(pair)
        relative_motion = relative_velocity(found, poses, motions, self._drift, before)
        hits = relative_motion.approach > HIT * max(
            relative_motion.separation,
            relative_motion.along**2 * self._drift / (2 * found.arc.inner),
        )
        if hits:
            self._along.pop(pair, None)
        else:
            self._along[pair] = relative_motion.along
        if (
            relative_motion.approach > 0 and relative_motion.separation > 0
            if found.sign > 0
            else abs(relative_motion.approach) > SLOWEST
        ):
            share = relative_motion.separation / relative_motion.approach
            meeting.bounce(max(share, meeting.restitution) if hits else share)

    def impacts(self, contacts: Contacts) -> Contacts:
        """Return the contacts that may be impacts: those of bodies that do not follow an arc."""
        follow = {
            frozenset(self._pieces[shape].body for shape in pair)
            for pair in self._along
            if pair in self._touching
        }
        rows = [frozenset(pair) not in follow for pair in contacts.bodies.tolist()]
        return contacts if all(rows) else Contacts._make(field[rows] for field in contacts)

    def judge(self, one: pymunk.Shape, other: pymunk.Shape) -> Verdict:
        """Return the exact contact of two shapes that overlap in pymunk, at present positions."""
        at, there = (
            (complex(*body.position), complex(*body.rotation_vector))
            for body in (one.body, other.body)
            if body
        )
        shapes = address(one), address(other)
        rows = frozenset(self._pieces[s].body for s in shapes if s in self._pieces)
        return rows not in self.rows or self._judge(shapes, at, there)

    def inside(self, state: Array) -> Iterator[Touch]:
        """Yield the contacts with arcs from inside and with curves, given a `Batch.state`.

        Right after a step these are the contacts that pymunk has just solved, as it finds them at
        these positions.
        """
        for shapes, overlap in self._touching.items():
            if overlap:
                rows = [self._pieces[shape].body for shape in shapes]
                found = self._judge(shapes, *(_placed(state[row]) for row in rows))
                if isinstance(found, Touch):
                    yield found

    def _judge(self, shapes: Shapes, at: Placed, there: Placed) -> Verdict:
        one, other = (self._pieces.get(shape) for shape in shapes)
        return one is None or other is None or verdict(one, other, at, there)


def _placed(row: Array) -> Placed:
    x, y, angle = row[:3].tolist()
    return complex(x, y), rect(1, angle)
