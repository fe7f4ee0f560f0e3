"""Contacts between a corner of one convex part and a side of another."""

from collections.abc import Iterator
from typing import NamedTuple

from sandbox.physics.contacts.direct.prediction.convex_parts import ConvexPart

LEAST = 1e-8
"""m, the least depth of a corner that counts: a tenth of the overlap that is left alone."""

ALIKE = 1e-9
"""m, the tolerance for equal depths of sides, and for corners beyond the end of a side."""

Both = tuple[ConvexPart, ConvexPart]
"""Two parts in the plane."""


class CornerOnSide(NamedTuple):
    """A corner of one part, and the side of the other part that it meets.

    `own` is the part with the side, 0 or 1, and `normal` is the outward unit normal of the side.
    `tip` is the point of the corner that is nearest to the side [m]; `gap` is its distance from the
    side, negative behind it [m].
    """

    own: int
    normal: complex
    tip: complex
    gap: float


def on_side(both: Both, own: int, side: int, corner: int) -> CornerOnSide:
    """Return the contact of a side of part `own` with a corner of the other part."""
    owner, guest = both[own], both[1 - own]
    normal = owner.normals[side]
    tip = guest.corners[corner] - normal * guest.rounding
    offset = (guest.corners[corner] - owner.corners[side]) * normal.conjugate()
    return CornerOnSide(own, normal, tip, offset.real - (owner.rounding + guest.rounding))


def within(ended: Both) -> Iterator[tuple[int, int, int]]:
    """Yield the corners that are inside the other part, as (part with the side, side, corner).

    The sides are that of least overlap of two parts, and the side of the other that faces it.
    """
    own, side, least = showing(ended)
    if least < -LEAST:
        yield from _behind(ended, own, side, LEAST)


def showing(both: Both) -> tuple[int, int, float]:
    """Return the side of largest separation: its part, its index, and the separation [m].

    The separation is negative where the parts overlap. At most one of them may be a disc.
    """
    one, other = both
    first, second = one.shows(other), other.shows(one)
    own = int(second[0] >= first[0] - ALIKE)
    apart, side = (first, second)[own]
    return own, side, apart


def _behind(ended: Both, own: int, side: int, least: float) -> Iterator[tuple[int, int, int]]:
    """Yield the corners behind a side, and those behind the side that faces it; see `within`."""
    for row, chosen in ((own, side), (1 - own, _facing(ended, own, side))):
        owner, guest = ended[row], ended[1 - row]
        if chosen is None:
            continue
        for corner, offset in enumerate(owner.seen(guest, chosen)):
            if offset.real < -least and -ALIKE < offset.imag < owner.lengths[chosen] + ALIKE:
                yield row, chosen, corner


def _facing(both: Both, own: int, side: int) -> int | None:
    """Return the side of the other part that faces a side of part `own`; None for a disc."""
    sides, across = both[1 - own].normals, both[own].normals[side].conjugate()
    return min(range(len(sides)), key=lambda at: (sides[at] * across).real, default=None)
