"""The force laws that a level may declare, one file each, with the energy beside the force."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from sandbox.model.effects import Effects
from sandbox.model.expressions import Array, Values
from sandbox.model.shapes import evaluate
from sandbox.physics.laws.attraction import Attraction
from sandbox.physics.laws.drag import Drag
from sandbox.physics.laws.gravitation import Gravitation
from sandbox.physics.laws.gravity import Gravity
from sandbox.physics.laws.law import Law
from sandbox.physics.laws.push import Push
from sandbox.physics.laws.spring import SpringForce

__all__ = [
    "Attraction",
    "Drag",
    "Gravitation",
    "Gravity",
    "Law",
    "Push",
    "SpringForce",
    "gravity",
    "laws",
]


def gravity(effects: Effects, values: Values, mass: Array) -> Gravity | None:
    """Return the level's uniform gravity, if it declares any."""
    if effects.gravity is None:
        return None
    return Gravity(evaluate(effects.gravity.acceleration, values), mass)


def laws(effects: Effects, values: Values, names: Sequence[str], mass: Array) -> tuple[Law, ...]:
    """Return the declared laws that pymunk does not apply by itself.

    Parameters
    ----------
    effects, values
        Of the level.
    names, mass
        (n,), of its bodies; the mass [kg] is 0 for those that nothing moves.
    """
    found: list[Law] = [
        Attraction(a.mu(values), evaluate(a.center, values), mass, a.power(values))
        for a in effects.attraction or ()
    ]
    if pull := effects.gravitation:
        rows = _rows(pull.bodies, names, mass)
        constant, softening = pull.constant(values), pull.softening(values)
        found.append(Gravitation(constant, rows, mass[rows], softening))
    if drag := effects.drag:
        rows = _rows(drag.bodies, names, mass)
        found.append(Drag(drag.linear(values), drag.quadratic(values), rows))
    for force in effects.force or ():
        point = evaluate(force.at, values)
        found.append(Push(force.force, values, names.index(force.body), point))
    return tuple(found)


def _rows(bodies: Sequence[str] | None, names: Sequence[str], mass: Array) -> NDArray[np.intp]:
    """Return the rows of the bodies that a law names, of all that move if it names none."""
    return np.flatnonzero(mass) if bodies is None else np.array([names.index(b) for b in bodies])
