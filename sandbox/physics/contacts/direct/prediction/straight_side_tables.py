"""The straight sides of bodies, as tables."""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.prediction.convex_parts import ConvexPart
from sandbox.physics.contacts.direct.rows.contact_outlines import PARALLEL
from sandbox.physics.engine.space_arrays import Booleans, Integers
from sandbox.physics.state.joint_anchors import Complexes

NEAR = 1e-6
"""m, the largest distance of a contact point from its side, and between sides in one line.
Overlaps and the roundings of sharp corners are smaller."""

DIGITS = 5
"""Normals are only compared if they agree to this many digits: lines have thousands of sides."""


class Side(NamedTuple):
    """A straight side, along the axes of its body.

    `normal` is its outward unit normal n; positions along it count along i n. `height` is the
    distance of its surface from the centre of mass along n, `begin` and `end` are the positions of
    its ends, and `rounding` is the radius of its corners [m].
    """

    normal: complex
    height: float
    begin: float
    end: float
    rounding: float


class Sides:
    """The sides of n bodies, at most s each; sides of one body in one line count as one.

    They are found from the convex parts of the bodies. The fields of a `Side` are tables here,
    (n, s), with NaN where a body has fewer; `any`, (n,), tells whether a body has sides.
    """

    def __init__(self, parts: Sequence[Sequence[ConvexPart]]) -> None:
        sides = [_joined(side for part in own for side in _sides(part)) for own in parts]
        table = np.full((5, len(sides), max(1, *map(len, sides))), np.nan, dtype=complex)
        for row, own in enumerate(sides):
            table[:, row, : len(own)] = np.array(own, dtype=complex).reshape(-1, 5).T
        self.normal: Complexes = table[0]
        self.height, self.begin, self.end, self.rounding = table[1:].real.copy()
        self.any: Booleans = np.array([bool(own) for own in sides], dtype=bool)

    def facing(self, body: Integers, out: Complexes, at: Complexes) -> tuple[Booleans, Array]:
        """Return which sides face a direction and go through a point, or past the core of one.

        These are (k, s). Also the positions of the points along them, (k,) [m]. `body`, (k,), are
        the bodies; `out` and `at`, (k,), are the directions and the points, along the axes of
        these.
        """
        seen = at * out.conj()
        depth = self.height[body] - seen.real[:, None]
        level = (np.abs(depth) < NEAR) | (np.abs(depth - self.rounding[body]) < NEAR)
        return level & (np.abs(self.normal[body] - out[:, None]) < PARALLEL), seen.imag

    def at(self, body: int, corner: complex) -> Iterator[tuple[complex, complex, int]]:
        """Yield the sides that end at the core of a corner, along the axes of its body.

        Yields their normals, the points of their surfaces at that end, and the signs with which
        positions along them change from there.
        """
        seen = corner * self.normal[body].conj()
        level = np.abs(self.height[body] - self.rounding[body] - seen.real) < NEAR
        for direction, ends in ((1, self.begin[body]), (-1, self.end[body])):
            for side in np.flatnonzero(level & (np.abs(ends - seen.imag) < NEAR)).tolist():
                normal = complex(self.normal[body, side])
                yield normal, complex(self.height[body, side], ends[side]) * normal, direction


def _sides(part: ConvexPart) -> Iterator[Side]:
    """Yield the sides of a convex part."""
    for corner, normal, length in zip(part.corners, part.normals, part.lengths, strict=False):
        seen = corner * normal.conjugate()
        height = seen.real + part.rounding
        yield Side(normal, height, seen.imag, seen.imag + length, part.rounding)


def _joined(sides: Iterable[Side]) -> list[Side]:
    """Return sides, with those that continue each other as one."""
    found = defaultdict[complex, list[Side]](list)
    for side in sorted(sides, key=lambda one: one.begin):
        near = complex(round(side.normal.real, DIGITS), round(side.normal.imag, DIGITS))
        for row, old in enumerate(found[near]):
            alike = abs(old.normal - side.normal) < PARALLEL
            if alike and abs(old.height - side.height) < NEAR and side.begin < old.end + NEAR:
                found[near][row] = old._replace(end=max(old.end, side.end))
                break
        else:
            found[near].append(side)
    return [side for some in found.values() for side in some]
