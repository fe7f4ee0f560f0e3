"""The check for bodies that overlap at the start, which is a mistake in the level.

The correction of overlaps would throw them apart, or leave them overlapping. So a level with
overlaps must allow them explicitly, or is refused. Boxes with the same centre, and lines and arcs
that lie in each other, are refused in any case: there is no direction in which they could part, and
so boxes and lines would not even collide.
"""

from cmath import phase
from collections.abc import Iterator, Mapping
from itertools import islice
from math import acos, inf
from typing import TYPE_CHECKING, NamedTuple

import pymunk

from sandbox.model.effects.contact import Contact
from sandbox.model.expressions import Values
from sandbox.model.translatable_message import Message
from sandbox.physics.contacts.detection.contact_queries import contact_of
from sandbox.physics.contacts.shapes.arc_contact_correction import Hollows
from sandbox.physics.contacts.shapes.pair_exclusion import meets
from sandbox.physics.contacts.shapes.pymunk_shapes import slop_of
from sandbox.physics.engine.shape_pairs import close_pairs, collision, is_dynamic, overlap
from sandbox.physics.state.cancellation_points import cancellation_point
from sandbox.physics.state.simulation_errors import OverlapError

if TYPE_CHECKING:
    from sandbox.physics.contacts.shapes.one_way_surfaces import Gates

TOUCHING = 1e-6
"""m, the overlap of touching bodies that is allowed: skins of 1e-9 m, and rounded decimals."""

DIGITS = 9
"""Decimals of a metre, to which the circles of arcs that lie in each other agree."""

ENOUGH = 1000
"""The most overlaps among which the worst is found, as a heap of n bodies has n² / 2."""


class Overlap(NamedTuple):
    """Two bodies that overlap, and how far [m]."""

    depth: float
    bodies: tuple[str, str]
    """Their names, in order."""
    directed: bool = True
    """Whether there is a direction in which they can part."""

    @property
    def reason(self) -> Message:
        """The message that refuses it."""
        one, other = self.bodies
        if not self.directed:
            return Message(
                "'{one}' and '{other}' lie in each other at the start, {depth:.3g} m deep, and"
                " nothing tells which way they part; move one of them",
                one=one,
                other=other,
                depth=self.depth,
            )
        return Message(
            "'{one}' and '{other}' overlap by {depth:.3g} m at the start; move them apart, or"
            " give 'contact' \"overlaps\": true",
            one=one,
            other=other,
            depth=self.depth,
        )


def refuse_overlaps(
    space: pymunk.Space,
    bodies: Mapping[str, pymunk.Body],
    contact: Contact,
    values: Values,
    hollows: Hollows | None,
    gates: "Gates | None",
) -> None:
    """Refuse bodies that overlap by more than is allowed; the error names the worst pair.

    Where the level allows overlaps, only those that have no direction to part in are refused.
    Bodies that never collide, because they are welded or neither moves, are left out. The error is
    an `OverlapError`.
    """
    least = inf if contact.overlaps else tolerated(space, contact, values)
    wrong = overlaps(bodies, least, hollows, gates)
    worst = max(islice(wrong, ENOUGH), default=None)
    if worst:
        raise OverlapError(worst.bodies[0], 0.0, worst.reason)


def _arcs_in_arcs(names: Mapping[pymunk.Body, str], hollows: Hollows | None) -> Iterator[Overlap]:
    """Yield the arcs of two bodies that lie in each other, on the same circle."""
    seen: dict[tuple[float, ...], list[tuple[pymunk.Body, complex, float]]] = {}
    for shape, piece in hollows.known() if hollows else ():
        arc, body = piece.arc, shape.body
        if arc is None or piece.outward or body is None or arc.cosine < -1:
            continue  # no arc, the end of one, or a whole circle, which parts as a disc does
        rotation = complex(*body.rotation_vector)
        center = complex(*body.position) + rotation * arc.center
        middle, half = rotation * arc.middle, acos(arc.cosine)
        circle = (*(round(x, DIGITS) for x in (center.real, center.imag, arc.radius)),)
        same = seen.setdefault(circle, [])
        for other, direction, reach in same:
            common = (half + reach - abs(phase(direction / middle))) * arc.radius
            one_moves = pymunk.Body.DYNAMIC in (body.body_type, other.body_type)
            if one_moves and meets(body, other) and common > TOUCHING:
                first, second = sorted((names[body], names[other]))
                yield Overlap(arc.outer - arc.inner, (first, second), directed=False)
        same.append((body, middle, half))


def tolerated(space: pymunk.Space, contact: Contact, values: Values) -> float:
    """Return the largest overlap that is allowed at the start [m]."""
    return max(TOUCHING, slop_of(space, contact, values))


def overlaps(
    bodies: Mapping[str, pymunk.Body],
    least: float,
    hollows: Hollows | None,
    gates: "Gates | None",
) -> Iterator[Overlap]:
    """Yield the overlaps of more than `least` [m], one for each two shapes.

    Those that have no direction to part in are yielded however deep they are.
    """
    names = {body: name for name, body in bodies.items()}
    yield from _arcs_in_arcs(names, hollows)
    shapes = [shape for body in bodies.values() for shape in body.shapes]
    dynamic = set(filter(is_dynamic, shapes))
    for shape in dynamic:
        shape.cache_bb()
    for pair in close_pairs(shapes):
        cancellation_point()
        one, other = pair if pair[0] in dynamic else pair[::-1]
        if not hollows:
            together = overlap(one, other)
            if together is None or (together[0] and together[1] <= least):
                continue
        touch = collision(one, other)
        found = touch and contact_of(one, other, touch, hollows, gates)
        if found and one.body and (found.depth > least or not found.directed):
            first, second = sorted((names[one.body], names[found.body]))
            yield Overlap(found.depth, (first, second), found.directed)
