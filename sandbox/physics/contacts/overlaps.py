"""Bodies that overlap at the start, which is a mistake in the level.

What takes overlaps back would throw them apart, or leave them in each other. So a level in which
bodies overlap says that it wants it, or is refused.
"""

from collections.abc import Iterator, Mapping
from itertools import islice
from typing import TYPE_CHECKING

import pymunk

from sandbox.model.effects.contact import Contact
from sandbox.model.expressions import Values
from sandbox.model.message import Message
from sandbox.physics.contacts.contact_queries import touched
from sandbox.physics.contacts.hollow_contacts import Hollows
from sandbox.physics.contacts.shapes import slop_of
from sandbox.physics.state.errors import SimulationError

if TYPE_CHECKING:
    from sandbox.physics.contacts.one_way import Gates

TOUCHING = 1e-6
"""m, by which what touches may overlap: skins of 1e-9 m, and decimals that somebody left out."""

ENOUGH = 1000
"""How many overlaps are looked at for the worst: in one place, each body overlaps all others."""


def refuse_overlaps(
    space: pymunk.Space,
    bodies: Mapping[str, pymunk.Body],
    contact: Contact,
    values: Values,
    hollows: Hollows | None,
    gates: "Gates | None",
) -> None:
    """Refuse bodies that overlap by more than what is left alone; the worst is told.

    Those that never collide, for they are welded or neither moves, do not overlap.

    Raises
    ------
    SimulationError
        If two do.
    """
    least = max(TOUCHING, slop_of(space, contact, values))
    found = max(islice(_pairs(space, bodies, least, hollows, gates), ENOUGH), default=None)
    if found:
        depth, one, other = found
        rule = Message(
            "'{one}' and '{other}' overlap by {depth:.3g} m at the start; move them apart, or let"
            " 'contact' say \"overlaps\": true",
            one=one,
            other=other,
            depth=depth,
        )
        raise SimulationError(one, 0.0, rule)


def _pairs(
    space: pymunk.Space,
    bodies: Mapping[str, pymunk.Body],
    least: float,
    hollows: Hollows | None,
    gates: "Gates | None",
) -> Iterator[tuple[float, str, str]]:
    """Yield by how much two bodies overlap that do so by more than the least [m], and their names.

    These are in order.
    """
    names = {body: name for name, body in bodies.items()}
    for name, body in bodies.items():
        for shape in body.shapes if body.body_type == pymunk.Body.DYNAMIC else ():
            for found in touched(space, shape, hollows, gates):
                if found.depth > least and found.body is not body:
                    other = names[found.body]
                    yield found.depth, min(name, other), max(name, other)
