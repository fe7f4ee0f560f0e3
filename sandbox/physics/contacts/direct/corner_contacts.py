"""Where a corner of a convex part comes down on a side of another."""

from collections.abc import Iterator
from typing import NamedTuple

from sandbox.physics.contacts.direct.convex_parts import Part

LEAST = 1e-8
"""m, how deep a corner must come down to count: a tenth of the overlap that is left alone."""

ALIKE = 1e-9
"""m: sides that are less deep by this are as deep, and corners that are so far beside one on it."""

Both = tuple[Part, Part]
"""Two parts in the plane."""


class Spot(NamedTuple):
    """Where a corner of a part comes down on the other part.

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


def on_side(both: Both, own: int, side: int, corner: int) -> Spot:
    """Return a corner of the other part as it comes down on a side; behind it, its gap is < 0."""
    owner, guest = both[own], both[1 - own]
    normal = owner.normals[side]
    tip = guest.corners[corner] - normal * guest.rounding
    return Spot(own, normal, tip, owner.seen(guest, side)[corner].real)


def within(ended: Both) -> Iterator[tuple[int, int, int]]:
    """Yield whose side a corner of the other part is behind, 0 or 1, which side, which corner.

    Of two parts that overlap these are the side that shows it least, and the one that faces it.
    """
    own, side, least = showing(ended)
    if least < -LEAST:
        yield from _behind(ended, own, side, LEAST)


def showing(both: Both) -> tuple[int, int, float]:
    """Return the side that shows best that two parts are apart: whose, which, by how much [m].

    By less than nothing where they overlap. Not both may be discs.
    """
    one, other = both
    first, second = one.shows(other), other.shows(one)
    own = int(second[0] >= first[0] - ALIKE)
    apart, side = (first, second)[own]
    return own, side, apart


def _behind(ended: Both, own: int, side: int, least: float) -> Iterator[tuple[int, int, int]]:
    """Yield the same as `within` of a side, and of the one that faces it."""
    for row, chosen in ((own, side), (1 - own, _facing(ended, own, side))):
        owner, guest = ended[row], ended[1 - row]
        if chosen is None:
            continue
        for corner, way in enumerate(owner.seen(guest, chosen)):
            if way.real < -least and -ALIKE < way.imag < owner.lengths[chosen] + ALIKE:
                yield row, chosen, corner


def _facing(both: Both, own: int, side: int) -> int | None:
    """Return which side of the other part faces one of a part; a disc has none."""
    sides, across = both[1 - own].normals, both[own].normals[side].conjugate()
    return min(range(len(sides)), key=lambda at: (sides[at] * across).real, default=None)
