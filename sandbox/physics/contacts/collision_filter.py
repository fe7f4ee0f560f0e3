"""Pairs of bodies that never collide, whatever their shapes do.

pymunk leaves out pairs between which a constraint says so, before it looks at their shapes: nothing
is called, and nothing is made of a contact. The constraint is a motor without strength.
"""

from collections.abc import Iterable, Mapping

import pymunk


def keep_apart(
    space: pymunk.Space, bodies: Mapping[str, pymunk.Body], pairs: Iterable[tuple[str, str]]
) -> list[pymunk.Constraint]:
    """Let pairs of bodies not meet, of which one is dynamic at least; return what sees to it."""
    bars: list[pymunk.Constraint] = []
    for a, b in pairs:
        bar = pymunk.SimpleMotor(bodies[a], bodies[b], 0.0)
        bar.max_force, bar.collide_bodies = 0.0, False
        bars.append(bar)
    space.add(*bars)
    return bars


def meets(one: pymunk.Body, other: pymunk.Body) -> bool:
    """Whether two bodies may touch each other."""
    return not any(
        not bar.collide_bodies and (bar.a is other or bar.b is other) for bar in one.constraints
    )
