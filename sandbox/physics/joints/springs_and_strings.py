"""Springs, and strings that are solved by themselves, made from their models in a level."""

from collections.abc import Mapping
from typing import cast

import pymunk

from sandbox.model.expressions import Values
from sandbox.model.joints import End, Pulley, Spring
from sandbox.model.shapes import XY, Point, evaluate
from sandbox.physics.forces.spring import Law, SpringForce
from sandbox.physics.joints.pulley import PulleyString
from sandbox.physics.state.anchor import Anchor


def make_string(
    name: str, spec: Pulley, bodies: Mapping[str, pymunk.Body], path: float, values: Values
) -> PulleyString:
    """Return a plain string over pegs; its length is that of its path [m] unless given."""
    first, second = (_holder(end, bodies, values) for end in spec.ends)
    pegs: tuple[XY, ...] = tuple(evaluate(cast("Point", peg), values) for peg in spec.over)
    length = spec.length(values) if spec.length else path
    return PulleyString(name, (first, second), pegs, length)


def _holder(end: End, bodies: Mapping[str, pymunk.Body], values: Values) -> pymunk.Body:
    if isinstance(end, str):
        return bodies[end]
    nail = pymunk.Body(body_type=pymunk.Body.STATIC)
    nail.position = evaluate(cast("Point", end), values)
    return nail


def make_spring(
    spec: Spring, path: tuple[Anchor, ...], distance: float, values: Values
) -> SpringForce:
    """Return the force law of a spring; its length is the distance of its ends [m] unless given."""
    length = distance if spec.length is None else spec.length(values)
    law = Law(spec.law, values) if spec.law else None
    return SpringForce(
        (path[0], path[-1]),
        spec.stiffness(values),
        length,
        spec.damping(values),
        spec.pushes_only,
        law,
        law.slope(distance - length) if law else 0.0,
    )
