"""Pairs of bodies that never collide, whatever their shapes do.

pymunk skips pairs that are connected by a constraint with `collide_bodies` off, before it checks
their shapes: no callback is called, and no contact is made. The constraint is a motor without
force.
"""

from collections.abc import Iterable, Mapping

import pymunk


def keep_apart(
    space: pymunk.Space, bodies: Mapping[str, pymunk.Body], pairs: Iterable[tuple[str, str]]
) -> list[pymunk.Constraint]:
    """Exclude collisions of pairs, each with a dynamic body; return the constraints for it."""
    bars: list[pymunk.Constraint] = []
    for a, b in pairs:
        bar = pymunk.SimpleMotor(bodies[a], bodies[b], 0.0)
        bar.max_force, bar.collide_bodies = 0.0, False
        bars.append(bar)
    space.add(*bars)
    return bars


def meets(one: pymunk.Body, other: pymunk.Body) -> bool:
    """Return whether two bodies may touch each other."""
    return not any(
        (bar.a is other or bar.b is other) and not bar.collide_bodies for bar in one.constraints
    )
