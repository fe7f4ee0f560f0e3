"""Convex parts of bodies: how far apart they are, and which corners of which are in which."""

from collections.abc import Iterator, Sequence
from math import inf
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import pymunk

from sandbox.model.expressions import Array
from sandbox.physics.geometry.distance import plain
from sandbox.physics.joints.exact.constraints import Coordinates
from sandbox.physics.state.anchor import Plane

if TYPE_CHECKING:
    from sandbox.physics.engine.batch import Booleans

LEAST = 1e-8
"""m, how deep a corner must come down to count: a tenth of the overlap that is left alone."""

ALIKE = 1e-9
"""m: sides that are less deep by this are as deep, and corners that are so far beside one on it."""


class Part(NamedTuple):
    """A convex part of a body, along its axes.

    Attributes
    ----------
    corners
        (k,), counter-clockwise; two are a line, one is the middle of a disc [m].
    normals
        (k,), of the sides from each to the next, outwards; a disc has none.
    lengths
        (k,), of these sides [m].
    rounding
        How far its surface lies beyond them [m].
    """

    corners: Plane
    normals: Plane
    lengths: Array
    rounding: float

    @classmethod
    def of(cls, shape: pymunk.Shape) -> "Part":
        """Return that of a disc, a polygon or a segment."""
        if isinstance(shape, pymunk.Circle):
            none = np.zeros(0, dtype=complex)
            return cls(np.array([complex(*shape.offset)]), none, np.zeros(0), shape.radius)
        assert isinstance(shape, pymunk.Poly | pymunk.Segment)
        ends = shape.get_vertices() if isinstance(shape, pymunk.Poly) else (shape.a, shape.b)
        corners = np.array([complex(*end) for end in ends])
        sides = np.roll(corners, -1) - corners
        lengths = np.abs(sides)
        return cls(corners, -1j * sides / lengths, lengths, shape.radius)

    @property
    def around(self) -> tuple[complex, float]:
        """The middle and the radius of a disc around it [m]."""
        middle = complex(self.corners.mean())
        return middle, float(np.abs(self.corners - middle).max()) + self.rounding

    @property
    def plain(self) -> "Plain":
        """The same in plain numbers."""
        return Plain(self.corners.tolist(), self.normals.tolist(), self.rounding, *self.around)

    @property
    def reach(self) -> float:
        """How far from the body's middle it has corners [m]."""
        return float(np.abs(self.corners).max())

    def placed(self, place: complex, turned: complex) -> "Part":
        """Return it in the plane."""
        return self._replace(corners=place + self.corners * turned, normals=self.normals * turned)

    def apart(self, other: "Part") -> Array:
        """Return how far the corners of another are in front of each side: (k, l) [m]."""
        ways = other.corners - self.corners[:, None]
        across = (ways * self.normals.conj()[:, None]).real
        return np.asarray(across - (self.rounding + other.rounding))

    def beside(self, other: "Part", side: int) -> Array:
        """Return how far along a side the corners of another are: (l,) [m]."""
        along = 1j * self.normals[side]
        return np.asarray(((other.corners - self.corners[side]) * along.conjugate()).real)


def parts_of(shapes: Sequence[pymunk.Shape]) -> list[Part]:
    """Return the parts of a body, in an order that does not depend on memory addresses.

    None if it has a shape of another kind.
    """
    own = plain(shapes)
    if not all(isinstance(s, pymunk.Circle | pymunk.Poly | pymunk.Segment) for s in own):
        return []
    return sorted(map(Part.of, own), key=lambda part: [(c.real, c.imag) for c in part.corners])


class Plain(NamedTuple):
    """A part in plain numbers: of its few corners how far apart they are is known ten times sooner.

    Attributes
    ----------
    corners, normals, rounding
        Those of the part [m].
    middle, radius
        Of a disc around it [m].
    """

    corners: list[complex]
    normals: list[complex]
    rounding: float
    middle: complex
    radius: float

    def placed(self, body: int, place: Coordinates) -> "Plain":
        """Return it in the plane."""
        where, turned = complex(place.plane[body]), complex(place.turned[body])
        corners = [where + corner * turned for corner in self.corners]
        normals, middle = [normal * turned for normal in self.normals], where + self.middle * turned
        return Plain(corners, normals, self.rounding, middle, self.radius)

    def gap(self, other: "Plain") -> float:
        """Return how far two parts are apart at the least [m]: nothing if that is not seen."""
        around = abs(self.middle - other.middle) - self.radius - other.radius
        if around > 0 or not (self.normals or other.normals):
            return around
        return max(self.shown(other), other.shown(self)) - self.rounding - other.rounding

    def shown(self, other: "Plain") -> float:
        """Return how far the corners of another are in front of the side that shows it best [m]."""
        best = -inf
        for corner, normal in zip(self.corners, self.normals, strict=False):  # a disc has none
            across = normal.conjugate()
            best = max(best, min(((far - corner) * across).real for far in other.corners))
        return best


class Spot(NamedTuple):
    """Where a corner of a part, or a disc, comes down on the other part.

    Attributes
    ----------
    own
        On which of the two parts: 0 or 1.
    normal
        The unit vector from that to the other.
    tip
        The point of the other that comes down [m].
    gap
        How far it has to go [m].
    """

    own: int
    normal: complex
    tip: complex
    gap: float


Both = tuple[Part, Part]
"""Two parts in the plane."""


def within(ended: Both) -> Iterator[tuple[int, int, int]]:
    """Yield whose side a corner of the other part is behind, 0 or 1, which side, which corner.

    Of two parts that overlap these are the side that shows it least, and the one that faces it.
    """
    own, side, least = showing(ended)
    if least < -LEAST:
        yield from _behind(ended, own, side, LEAST)


def _behind(ended: Both, own: int, side: int, least: float) -> Iterator[tuple[int, int, int]]:
    """Yield the same of a side, and of the one that faces it."""
    for row, chosen in ((own, side), (1 - own, _facing(ended, own, side))):
        owner, guest = ended[row], ended[1 - row]
        if chosen is None:
            continue
        beside = owner.beside(guest, chosen)
        deep = owner.apart(guest)[chosen] < -least
        deep &= (beside > -ALIKE) & (beside < owner.lengths[chosen] + ALIKE)
        yield from ((row, chosen, int(corner)) for corner in np.flatnonzero(deep))


def _facing(both: Both, own: int, side: int) -> int | None:
    """Return which side of the other part faces one of a part; a disc has none."""
    sides, normal = both[1 - own].normals, both[own].normals[side]
    return int((sides * normal.conj()).real.argmin()) if len(sides) else None


def showing(both: Both) -> tuple[int, int, float]:
    """Return the side that shows best that two parts are apart: whose, which, by how much [m].

    By less than nothing where they overlap. Not both may be discs.
    """
    one, other = both
    least = [one.apart(other).min(axis=1), other.apart(one).min(axis=1)]
    best = [float(across.max(initial=-np.inf)) for across in least]
    own = int(best[1] >= best[0] - ALIKE)
    return own, int(least[own].argmax()), best[own]


def landing(began: Both, ended: Both, least: float) -> Iterator[Spot]:
    """Yield where two parts that were apart come into each other, as it was before.

    The side that showed them apart is the one that is met, however deep they are in the end: what
    is less deep than the `least` [m] does not count.
    """
    if not (len(began[0].normals) or len(began[1].normals)):
        yield from _round(began, ended, 0, 0, least)
        return
    own, side, apart = showing(began)
    if apart <= 0 or showing(ended)[2] >= -least:
        return
    for row, chosen, corner in _behind(ended, own, side, least):
        owner, guest = began[row], began[1 - row]
        normal = complex(owner.normals[chosen])
        tip = complex(guest.corners[corner]) - normal * guest.rounding
        left = float(owner.apart(guest)[chosen, corner])
        if left > 0:
            yield Spot(row, normal, tip, left)
    if not len(ended[1 - own].normals):
        beside = float(ended[own].beside(ended[1 - own], side)[0])
        if beside < -ALIKE:
            yield from _round(began, ended, own, side, least)
        elif beside > ended[own].lengths[side] + ALIKE:
            yield from _round(began, ended, own, (side + 1) % len(ended[own].corners), least)


def _round(began: Both, ended: Both, own: int, corner: int, least: float) -> Iterator[Spot]:
    """Yield where a disc comes down on a corner, or on a disc, if it does."""

    def across(both: Both) -> tuple[complex, float]:
        owner, guest = both[own], both[1 - own]
        way = complex(guest.corners[0] - owner.corners[corner])
        return way, abs(way) - owner.rounding - guest.rounding

    way, apart = across(began)
    if apart > 0 and across(ended)[1] < -least:
        normal = way / abs(way)
        guest = began[1 - own]
        yield Spot(own, normal, complex(guest.corners[0]) - normal * guest.rounding, apart)


class Shapes:
    """The parts of n bodies.

    Parameters
    ----------
    bodies
        pymunk's, in order.

    Attributes
    ----------
    sided, single
        (n,), whether all parts of a body have sides, and whether it has but one.
    reach
        (n,), how far from its middle a body reaches; without any parts it has no end [m].
    """

    def __init__(self, bodies: Sequence[pymunk.Body]) -> None:
        self._parts = parts = [parts_of(list(body.shapes)) for body in bodies]
        self._plain = [[part.plain for part in own] for own in parts]
        discs = [[part.around for part in own] for own in parts]
        self._middle = [np.array([middle for middle, _ in own]) for own in discs]
        self._radius = [np.array([radius for _, radius in own]) for own in discs]
        sided = [bool(own) and all(len(part.normals) for part in own) for own in parts]
        self.sided: Booleans = np.array(sided, dtype=bool)
        self.single: Booleans = np.array([len(own) == 1 for own in parts], dtype=bool)
        self.reach = np.array([max((p.reach for p in own), default=np.inf) for own in parts])

    def close(
        self, pair: tuple[int, int], here: Coordinates, there: Coordinates
    ) -> Iterator[tuple[Both, Both]]:
        """Yield the parts of two bodies that may be in each other there, here and there."""
        a, b = pair
        near = np.argwhere(self._between(pair, there) < 0).tolist()
        for first, second in near:
            one, other = self._parts[a][first], self._parts[b][second]
            yield (
                (_placed(one, a, here), _placed(other, b, here)),
                (_placed(one, a, there), _placed(other, b, there)),
            )

    def gap(self, pair: tuple[int, int], here: Coordinates) -> float:
        """Return how far two bodies are apart at the least [m]: nothing if that is not seen."""
        a, b = pair
        if self.single[a] and self.single[b]:
            return self._plain[a][0].placed(a, here).gap(self._plain[b][0].placed(b, here))
        between = self._between(pair, here)
        least = np.inf
        for at in np.argsort(between, axis=None):
            first, second = divmod(int(at), between.shape[1])
            if between[first, second] >= least:
                break
            one, other = self._plain[a][first].placed(a, here), self._plain[b][second]
            least = min(least, one.gap(other.placed(b, here)))
        return least

    def _between(self, pair: tuple[int, int], place: Coordinates) -> Array:
        """Return how far the discs around the parts of two bodies are apart: (k, l) [m]."""
        a, b = pair
        one, other = (place.plane[c] + self._middle[c] * place.turned[c] for c in pair)
        return np.asarray(np.abs(one[:, None] - other) - self._radius[a][:, None] - self._radius[b])


def _placed(part: Part, body: int, place: Coordinates) -> Part:
    return part.placed(complex(place.plane[body]), complex(place.turned[body]))
