"""Contacts at the present positions, found by pymunk between two of its steps."""

from collections import Counter
from collections.abc import Collection, Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import pymunk

from sandbox.physics.contacts.shapes.arc_contact_correction import Hollows
from sandbox.physics.contacts.shapes.pair_exclusion import meets
from sandbox.physics.engine.shape_pairs import Collision, collision
from sandbox.physics.engine.space_arrays import NO_CONTACTS, Contacts
from sandbox.physics.geometry.outline_distance import dot

if TYPE_CHECKING:
    from sandbox.physics.contacts.shapes.one_way_surfaces import Gates

Points = tuple[complex, complex]
"""The contact point of two shapes, on the surface of each [m]."""


class ShapeContact(NamedTuple):
    """A contact of a shape.

    The unit normal points towards the other body, `body` of pymunk. There are one or two contact
    points, the shape's own surface first; `depth` is the largest overlap [m]. `directed` tells
    whether pymunk finds a direction to part in: not if shapes other than two circles have the same
    centre, or are lines that lie in each other.
    """

    body: pymunk.Body
    normal: complex
    points: Sequence[Points]
    depth: float
    directed: bool = True


NUDGE = 1e-9
"""m, by which a shape is moved to find how far it overlaps another one with the same centre."""


def touched(
    space: pymunk.Space,
    shape: pymunk.Shape,
    hollows: Hollows | None,
    gates: "Gates | None" = None,
) -> Iterator[ShapeContact]:
    """Yield the contacts of a shape, also with other shapes of its own body."""
    for hit in space.shape_query(shape):
        points = [(complex(*p.point_a), complex(*p.point_b)) for p in hit.contact_point_set.points]
        found = Collision(complex(*hit.contact_point_set.normal), points)
        if hit.shape and (contact := contact_of(shape, hit.shape, found, hollows, gates)):
            yield contact


def contact_of(
    shape: pymunk.Shape,
    other: pymunk.Shape,
    found: Collision,
    hollows: Hollows | None,
    gates: "Gates | None",
) -> ShapeContact | None:
    """Return the contact of two shapes of which pymunk finds that they collide, if they touch."""
    if shape.body is None or other.body is None or not meets(shape.body, other.body):
        return None
    if gates and gates.lets_pass(shape.body, other.body):
        return None
    verdict = hollows.judge(shape, other) if hollows else True
    if hollows and not isinstance(verdict, bool):
        normal, *points = hollows.sides(shape, verdict)
        return ShapeContact(other.body, normal, [(points[0], points[1])], verdict.depth)
    if not verdict:
        return None
    directed = bool(found.normal)
    depth = found.depth if directed else _nudged(shape, other)
    return ShapeContact(other.body, found.normal, found.points, depth, directed)


def _nudged(shape: pymunk.Shape, other: pymunk.Shape) -> float:
    """Return how far a shape overlaps another one with the same centre [m].

    pymunk starts its search along the line between the centres, and finds nothing if there is none.
    So the shape is moved a little to each side; the result is the least overlap.
    """
    body = shape.body
    assert body
    position, depths = body.position, list[float]()
    for shift in ((NUDGE, 0), (-NUDGE, 0), (0, NUDGE), (0, -NUDGE)):
        body.position = position + shift
        shape.cache_bb()
        found = collision(shape, other)
        if found and found.normal:
            depths.append(found.depth)
    body.position = position
    shape.cache_bb()
    return min(depths, default=0.0)


class Query:
    """Finds the contacts of bodies that were moved outside pymunk's step; n bodies.

    `bodies` are all bodies, in order; `hollows` and `gates`, the one-way surfaces, are None if
    there are none.
    """

    def __init__(
        self,
        space: pymunk.Space,
        bodies: Sequence[pymunk.Body],
        hollows: Hollows | None,
        gates: "Gates | None" = None,
    ) -> None:
        self._space, self.bodies, self.hollows, self.gates = space, bodies, hollows, gates
        self._rows = {body: row for row, body in enumerate(bodies)}

    def updated(self, contacts: Contacts, moved: Collection[int], min_depth: float) -> Contacts:
        """Return known contacts, updated for bodies that were moved.

        Pairs that now touch with more shapes, or overlap deeply at more points, get new contacts;
        the others keep the known ones. `moved` are the rows of the moved bodies; overlaps of at
        least `min_depth` [m] count as deep.
        """
        found: dict[tuple[int, int], list[ShapeContact]] = {}
        for row, other, contact in self._found(moved):
            found.setdefault((row, other), []).append(contact)
        pairs = pairs_of(contacts)
        deep = Counter[tuple[int, int]]()
        for pair, depths in zip(pairs, contacts.depths, strict=True):
            deep[pair] += int(np.count_nonzero(depths > min_depth))
        new = {
            pair: all_
            for pair, all_ in found.items()
            if len(all_) > pairs.count(pair) or _deep(all_, min_depth) > deep[pair]
        }
        if not new:
            return contacts
        keep = [pair not in new for pair in pairs]
        rest = Contacts._make(field[keep] for field in contacts)
        return rest.followed_by(contacts_of(new)).in_order()

    def _found(self, moved: Collection[int]) -> Iterator[tuple[int, int, ShapeContact]]:
        """Yield the rows of two bodies that touch, the lower first, and their contact."""
        for row in moved:
            self._space.reindex_shapes_for_body(self.bodies[row])
        for row in moved:
            for shape in self.bodies[row].shapes:
                for found in touched(self._space, shape, self.hollows, self.gates):
                    other = self._rows[found.body]
                    if row < other:
                        yield row, other, found
                    elif other < row and other not in moved:  # else it is found from the other body
                        back = [(second, first) for first, second in found.points]
                        yield other, row, found._replace(normal=-found.normal, points=back)


def pairs_of(contacts: Contacts) -> list[tuple[int, int]]:
    """Return the bodies of each contact, the lower index first."""
    return [(a, b) if a < b else (b, a) for a, b in contacts.bodies.tolist()]


def _deep(contacts: Sequence[ShapeContact], min_depth: float) -> int:
    """Return the number of points with more than the least overlap [m]."""
    pairs = ((contact.normal, *point) for contact in contacts for point in contact.points)
    return sum(dot(first - second, normal) > min_depth for normal, first, second in pairs)


def contacts_of(found: dict[tuple[int, int], list[ShapeContact]]) -> Contacts:
    """Return contacts in the form of a step's, without impulses."""
    rows = [(pair, contact) for pair, contacts in found.items() for contact in contacts]
    count = len(rows)
    points, depths = np.zeros((count, 2), dtype=complex), np.zeros((count, 2))
    for row, (_, contact) in enumerate(rows):
        for index, (first, second) in enumerate(contact.points):
            points[row, index] = (first + second) / 2
            depths[row, index] = dot(first - second, contact.normal)
    normals = np.array([contact.normal for _, contact in rows])
    return NO_CONTACTS._replace(
        bodies=np.array([pair for pair, _ in rows], dtype=np.intp),
        first=np.ones(count, dtype=bool),
        direction=np.stack((normals.real, normals.imag), axis=1),
        normal=np.zeros(count),
        friction=np.zeros(count),
        touches=np.array([len(contact.points) for _, contact in rows], dtype=np.intp),
        points=np.stack((points.real, points.imag), axis=2),
        impulse=np.zeros((count, 2)),
        depths=depths,
    )
