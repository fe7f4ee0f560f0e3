"""The pairs of bodies that never collide although the level has contacts."""

from collections.abc import Iterator
from itertools import combinations

from sandbox.model.joints import bodies_of
from sandbox.model.level import Level

Pair = tuple[str, str]
"""Two bodies, in the order of their names."""


def apart(level: Level) -> frozenset[Pair]:
    """Return the pairs of bodies that never collide, if at least one of them can move."""
    moving = {name for name, body in level.bodies.items() if body.type == "dynamic"}
    pairs = ((min(pair), max(pair)) for pair in _pairs(level))
    return frozenset((a, b) for a, b in pairs if a in moving or b in moving)


def _pairs(level: Level) -> Iterator[Pair]:
    contact = level.effects.contact
    if contact is None:
        return
    for group in contact.apart:
        yield from combinations(group, 2)
    if not contact.jointed:
        for joint in level.joints.values():
            yield from combinations(dict.fromkeys(bodies_of(joint)), 2)
