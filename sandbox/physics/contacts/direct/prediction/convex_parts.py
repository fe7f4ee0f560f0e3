"""Convex parts of bodies, and their distances and overlaps.

They have few corners, and a step needs few of them, so plain numbers are faster than arrays.
"""

from collections.abc import Iterator, Sequence
from math import inf
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import pymunk

from sandbox.model.expressions import Array
from sandbox.physics.geometry import outline_distance
from sandbox.physics.joints.exact.constraint_interface import Coordinates
from sandbox.physics.state.joint_anchors import Complexes

if TYPE_CHECKING:
    from sandbox.physics.engine.space_arrays import Booleans

PLACEMENTS = 2
"""How many placements are remembered: those at the start and at the end of a drift."""

TOUCHING = 1e-7
"""The largest distance of parts that count as touching [m]; those that rest are 3e-8 m apart."""

Pair = tuple[int, int]
"""Two bodies, the lower index first; or the indices of a part of each."""


class ConvexPart(NamedTuple):
    """A convex part of a body, along its axes or in the plane.

    `corners`, (k,), are counter-clockwise [m]: two for a segment, one, the centre, for a disc.
    `normals` and `lengths` [m], (k,), are the outward normals and the lengths of the sides, each
    from a corner to the next; a disc has no normals. `rounding` is the distance of its surface from
    the polygon of its corners [m], and `middle` and `radius` are a disc that encloses it [m].
    """

    corners: list[complex]
    normals: list[complex]
    lengths: list[float]
    rounding: float
    middle: complex
    radius: float

    @classmethod
    def of(cls, shape: pymunk.Shape) -> "ConvexPart":
        """Return the part of a disc, a polygon or a segment."""
        if isinstance(shape, pymunk.Circle):
            middle = complex(*shape.offset)
            return cls([middle], [], [], shape.radius, middle, shape.radius)
        assert isinstance(shape, pymunk.Poly | pymunk.Segment)
        ends = shape.get_vertices() if isinstance(shape, pymunk.Poly) else (shape.a, shape.b)
        corners = np.array([complex(*end) for end in ends])
        sides = np.roll(corners, -1) - corners
        lengths, middle = np.abs(sides), complex(corners.mean())
        return cls(
            corners.tolist(),
            (-1j * sides / lengths).tolist(),
            lengths.tolist(),
            shape.radius,
            middle,
            float(np.abs(corners - middle).max()) + shape.radius,
        )

    @property
    def reach(self) -> float:
        """The largest distance of its corners from the body's centre of mass [m]."""
        return max(map(abs, self.corners))

    def placed(self, position: complex, rotation: complex) -> "ConvexPart":
        """Return it in the plane, with its body at a position and rotated."""
        return ConvexPart(
            [position + corner * rotation for corner in self.corners],
            [normal * rotation for normal in self.normals],
            self.lengths,
            self.rounding,
            position + self.middle * rotation,
            self.radius,
        )

    def seen(self, other: "ConvexPart", side: int) -> list[complex]:
        """Return the corners of another part over a side: height + i × position along it [m]."""
        corner, across = self.corners[side], self.normals[side].conjugate()
        proud = self.rounding + other.rounding
        return [(far - corner) * across - proud for far in other.corners]

    def shows(self, other: "ConvexPart") -> tuple[float, int]:
        """Return the largest separation of another part from a side, and that side [m].

        The separation is negative where they overlap, and -inf for a disc, which has no sides.
        """
        best, chosen, corners, others = -inf, 0, self.corners, other.corners
        for side, normal in enumerate(self.normals):
            corner, across, least = corners[side], normal.conjugate(), inf
            for far in others:
                height = ((far - corner) * across).real
                if height < least:
                    least = height
                    if least <= best:
                        break
            else:
                best, chosen = least, side
        return best - (self.rounding + other.rounding), chosen

    def lowest(self, other: "ConvexPart", side: int) -> float:
        """Return the separation of another part from a side [m]."""
        corner, across = self.corners[side], self.normals[side].conjugate()
        least = min([((far - corner) * across).real for far in other.corners])
        return least - (self.rounding + other.rounding)

    def gap(self, other: "ConvexPart") -> float:
        """Return a lower bound of the distance between two parts [m]."""
        around = abs(self.middle - other.middle) - self.radius - other.radius
        if around > 0 or not (self.normals or other.normals):
            return around
        return max(self.shows(other)[0], other.shows(self)[0])

    def touches(self, other: "ConvexPart") -> bool:
        """Return whether two parts touch or overlap."""
        proud = self.rounding + other.rounding
        return outline_distance.gap(self.corners, other.corners, proud).distance <= TOUCHING


def parts_of(shapes: Sequence[pymunk.Shape]) -> list[ConvexPart]:
    """Return the parts of a body, in an order that does not depend on memory addresses.

    A body with a shape of another kind has none.
    """
    own = outline_distance.without_feelers(shapes)
    if not all(isinstance(s, pymunk.Circle | pymunk.Poly | pymunk.Segment) for s in own):
        return []
    parts = map(ConvexPart.of, own)
    return sorted(parts, key=lambda p: ([(c.real, c.imag) for c in p.corners], p.rounding))


class PlacedParts:
    """The parts of bodies at some positions; each is placed when it is first asked for.

    `parts` are those of each body, along its axes. `last` are the parts as last placed, by body and
    number, with their bodies' positions: those of bodies that have not moved since are reused.
    """

    def __init__(
        self,
        parts: Sequence[Sequence[ConvexPart]],
        pose: Coordinates,
        last: dict[Pair, tuple[complex, complex, ConvexPart]],
    ) -> None:
        self._parts, self.pose, self._last = parts, pose, last
        self._positions: list[complex] = pose.position.tolist()
        self._rotations: list[complex] = pose.rotation.tolist()
        self._known: dict[Pair, ConvexPart] = {}

    def part(self, body: int, number: int) -> ConvexPart:
        """Return a part of a body."""
        if (part := self._known.get((body, number))) is None:
            where, rotation = self._positions[body], self._rotations[body]
            last = self._last.get((body, number))
            if last and last[0] == where and last[1] == rotation:
                part = last[2]
            else:
                part = self._parts[body][number].placed(where, rotation)
                self._last[body, number] = where, rotation, part
            self._known[body, number] = part
        return part

    def both(self, bodies: Pair, numbers: Pair) -> tuple[ConvexPart, ConvexPart]:
        """Return a part of each of two bodies."""
        return self.part(bodies[0], numbers[0]), self.part(bodies[1], numbers[1])


class ConvexParts:
    """The parts of n bodies, pymunk's in order.

    `parts` are those of each body, along its axes. `sided` and `single`, (n,), tell whether all
    parts of a body have sides, and whether it has only one part. `reach`, (n,), is the largest
    distance of corners from the centre of mass; inf without any parts [m].
    """

    def __init__(self, bodies: Sequence[pymunk.Body]) -> None:
        self.parts = parts = [parts_of(list(body.shapes)) for body in bodies]
        self._middle = [np.array([part.middle for part in own]) for own in parts]
        self._radius = [np.array([part.radius for part in own]) for own in parts]
        sided = [bool(own) and all(part.normals for part in own) for own in parts]
        self.sided: Booleans = np.array(sided, dtype=bool)
        self.single: Booleans = np.array([len(own) == 1 for own in parts], dtype=bool)
        self.reach = np.array([max((p.reach for p in own), default=np.inf) for own in parts])
        self._placed: dict[bytes, PlacedParts] = {}  # the last ones, by the bodies' positions
        self._last: dict[Pair, tuple[complex, complex, ConvexPart]] = {}

    def at(self, pose: Coordinates) -> PlacedParts:
        """Return the parts with the bodies at some positions; the last placements are reused."""
        where = pose.values.tobytes()
        if (parts := self._placed.pop(where, None)) is None:
            parts = PlacedParts(self.parts, pose, self._last)
        self._placed[where] = parts
        if len(self._placed) > PLACEMENTS:
            del self._placed[next(iter(self._placed))]
        return parts

    def close(self, pair: Pair, parts: PlacedParts) -> Iterator[Pair]:
        """Yield the pairs of parts of two bodies that may overlap."""
        if self.single[pair[0]] and self.single[pair[1]]:
            one, other = parts.both(pair, (0, 0))
            if abs(one.middle - other.middle) < one.radius + other.radius:
                yield 0, 0
        else:
            near = np.argwhere(self._between(pair, parts.pose) < 0)
            yield from ((int(first), int(second)) for first, second in near.tolist())

    def near(self, pair: Pair, start: PlacedParts, end: PlacedParts, fall: float) -> list[Pair]:
        """Return the pairs of parts of two bodies that may meet between two placements.

        For all others the enclosing discs stay apart along the direction between them at first, in
        which they come closer by at most `fall` more than at both placements [m].
        """
        a, b = pair
        if self.single[a] and self.single[b]:
            (one, other), (later_one, later_other) = (at.both(pair, (0, 0)) for at in (start, end))
            shift, reach = other.middle - one.middle, one.radius + other.radius + fall
            along = ((later_other.middle - later_one.middle) * shift.conjugate()).real
            return [] if abs(shift) > reach and along > reach * abs(shift) else [(0, 0)]
        offset, apart = self._offsets(pair, start.pose)
        later, _ = self._offsets(pair, end.pose)
        around = self._radius[a][:, None] + self._radius[b] + fall
        far = (apart > around) & ((later * offset.conj()).real > around * apart)
        return [(int(first), int(second)) for first, second in np.argwhere(~far).tolist()]

    def gap(self, pair: Pair, parts: PlacedParts, *, beside: bool = False) -> float:
        """Return a lower bound of the distance between two bodies [m].

        With `beside` it is that of the parts that do not touch.
        """
        a, b = pair
        if self.single[a] and self.single[b]:
            return parts.part(a, 0).gap(parts.part(b, 0))
        between, least = self._between(pair, parts.pose), inf
        for at in np.argsort(between, axis=None):
            first, second = divmod(int(at), between.shape[1])
            if between[first, second] >= least:
                break
            one, other = parts.part(a, first), parts.part(b, second)
            gap = one.gap(other)
            if not (beside and gap <= TOUCHING and one.touches(other)):
                least = min(least, gap)
        return least

    def _between(self, pair: Pair, pose: Coordinates) -> Array:
        """Return the distances between the enclosing discs of two bodies' parts: (k, l) [m]."""
        a, b = pair
        apart = self._offsets(pair, pose)[1]
        return np.asarray(apart - self._radius[a][:, None] - self._radius[b])

    def _offsets(self, pair: Pair, pose: Coordinates) -> tuple[Complexes, Array]:
        """Return the vectors between the middles of two bodies' parts, and their lengths."""
        one, other = (pose.position[c] + self._middle[c] * pose.rotation[c] for c in pair)
        offset = other - one[:, None]
        return offset, np.abs(offset)
