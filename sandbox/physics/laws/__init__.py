"""The force laws that a level may declare, one file each, with the energy beside the force."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from sandbox.model.effects import Effects
from sandbox.model.expressions import Array, Values
from sandbox.model.shapes import evaluate
from sandbox.physics.laws.attraction import Attraction
from sandbox.physics.laws.centrifugal import Centrifugal
from sandbox.physics.laws.drag import Drag
from sandbox.physics.laws.gravitation import Gravitation
from sandbox.physics.laws.gravity import Gravity
from sandbox.physics.laws.law import Law
from sandbox.physics.laws.massflow import Accretion, Thrust
from sandbox.physics.laws.push import Push
from sandbox.physics.laws.spring import SpringForce
from sandbox.physics.massflow import Share, accretion_flows, thrust_flows

__all__ = [
    "Accretion",
    "Attraction",
    "Centrifugal",
    "Drag",
    "Gravitation",
    "Gravity",
    "Law",
    "Push",
    "SpringForce",
    "Thrust",
    "gravity",
    "laws",
]


def gravity(effects: Effects, values: Values, mass: Array, share: Share) -> Gravity | None:
    """Return the level's uniform gravity, if it declares any."""
    if effects.gravity is None:
        return None
    return Gravity(evaluate(effects.gravity.acceleration, values), mass, share)


def laws(
    effects: Effects,
    values: Values,
    names: Sequence[str],
    mass: Array,
    share: Share,
    step: float,
) -> tuple[Law, ...]:
    """Return the declared laws that pymunk does not apply by itself.

    Parameters
    ----------
    effects, values
        Of the level.
    names, mass
        (n,), of its bodies; the mass [kg] is that at the start, 0 for those that nothing moves.
    share
        How the masses change.
    step
        How long a kick lasts [s].
    """
    found: list[Law] = [
        Attraction(a.mu(values), evaluate(a.center, values), mass, a.power(values), share)
        for a in effects.attraction or ()
    ]
    if pull := effects.gravitation:
        rows = _rows(pull.bodies, names, mass)
        constant, softening = pull.constant(values), pull.softening(values)
        found.append(Gravitation(constant, rows, mass, softening, share))
    if turning := effects.centrifugal:
        found.append(Centrifugal(turning.rate(values), turning.axis(values), mass, share))
    if drag := effects.drag:
        rows = _rows(drag.bodies, names, mass)
        found.append(Drag(drag.linear(values), drag.quadratic(values), rows))
    for force in effects.force or ():
        point = evaluate(force.at, values)
        turns = force.frame == "body"
        found.append(Push(force.force, values, names.index(force.body), point, turns))
    for thrust, flow in zip(
        effects.thrust or (), thrust_flows(effects, values, names), strict=True
    ):
        found.append(Thrust(flow, evaluate(thrust.exhaust, values), step))
    for accretion, flow in zip(
        effects.accretion or (), accretion_flows(effects, values, names), strict=True
    ):
        found.append(Accretion(flow, evaluate(accretion.velocity, values), step))
    return tuple(found)


def _rows(bodies: Sequence[str] | None, names: Sequence[str], mass: Array) -> NDArray[np.intp]:
    """Return the rows of the bodies that a law names, of all that move if it names none."""
    return np.flatnonzero(mass) if bodies is None else np.array([names.index(b) for b in bodies])
