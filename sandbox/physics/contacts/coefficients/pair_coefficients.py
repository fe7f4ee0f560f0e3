"""The coefficients of pairs: those that the level gives, or else products of the bodies'."""

from typing import Literal

import numpy as np

from sandbox.model.body import Body
from sandbox.model.expressions import Array, NonNegative, Values
from sandbox.model.level import Level

Rub = Literal["friction", "restitution"]


def pair_coefficients(level: Level, values: Values, kind: Rub) -> Array:
    """Return the coefficients of all pairs: (n, n)."""
    effect, names = getattr(level.effects, kind), list(level.bodies)
    if effect is None:
        return np.zeros((len(names), len(names)))
    own = [own_coefficient(body, values, kind) for body in level.bodies.values()]
    coefficients = np.outer(own, own)
    for pair in effect.pairs:
        a, b = (names.index(name) for name in pair.bodies)
        coefficients[a, b] = coefficients[b, a] = pair.coefficient(values)
    return coefficients


def own_coefficient(body: Body, values: Values, kind: Rub) -> float:
    """Return a body's factor in the coefficients of its pairs; 0 if it has none."""
    coefficient: NonNegative | None = getattr(body, kind)
    return coefficient(values) if coefficient else 0.0


def own_static_coefficient(body: Body, values: Values) -> float:
    """Return a body's factor of static friction; that of kinetic friction if the level has none."""
    if body.static_friction is None:
        return own_coefficient(body, values, "friction")
    return body.static_friction(values)
