"""The pairs of bodies that never collide although the level has contacts."""

from collections.abc import Iterator
from itertools import combinations

from sandbox.model.joints import bodies_of
from sandbox.model.level import Level

Pair = tuple[str, str]
"""Two bodies, in the order of their names."""


def excluded_pairs(level: Level) -> frozenset[Pair]:
    """Return the pairs of bodies that never collide, if at least one of them can move."""
    movable = {name for name, body in level.bodies.items() if body.type == "dynamic"}
    pairs = ((min(pair), max(pair)) for pair in _pairs(level))
    return frozenset((a, b) for a, b in pairs if a in movable or b in movable)


def _pairs(level: Level) -> Iterator[Pair]:
    contact = level.effects.contact
    if contact is None:
        return
    for group in contact.apart:
        yield from combinations(group, 2)
    if not contact.jointed:
        for joint in level.joints.values():
            yield from combinations(dict.fromkeys(bodies_of(joint)), 2)
