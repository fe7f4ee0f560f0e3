"""The force laws that a level may declare, one file each, with the energy beside the force.

A law is imported where a level declares it: what a scene does not call for is not even loaded.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from sandbox.model.accounts import does_work
from sandbox.model.effects import Effects
from sandbox.model.expressions import Array, Values
from sandbox.model.joints import Spring
from sandbox.model.level import Level
from sandbox.model.shapes import XY, evaluate
from sandbox.physics.engine.batch import in_place
from sandbox.physics.forces.gravity import Gravity
from sandbox.physics.forces.law import Law
from sandbox.physics.forces.variable_mass import Share, accretion_flows, thrust_flows

__all__ = ["Gravity", "Law", "any_law", "gravity", "laws"]


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
    given = _Given(effects, values, names, mass, share, step)
    declared = (make for name, make in _MAKERS.items() if getattr(effects, name) is not None)
    return tuple(law for make in declared for law in make(given))


def any_law(level: Level) -> bool:
    """Whether a level has forces that pymunk does not apply by itself, springs among them."""
    declared = any(name in _MAKERS for name in level.effects.declared)
    return declared or any(isinstance(joint, Spring) for joint in level.joints.values())


class _Given(NamedTuple):
    """What the laws of a level are made of; see `laws`."""

    effects: Effects
    values: Values
    names: Sequence[str]
    mass: Array
    share: Share
    step: float


def _attraction(given: _Given) -> Iterator[Law]:
    from sandbox.physics.forces.attraction import Attraction

    values = given.values
    for a in given.effects.attraction or ():
        center, power = evaluate(a.center, values), a.power(values)
        yield Attraction(a.mu(values), center, given.mass, power, given.share)


def _gravitation(given: _Given) -> Iterator[Law]:
    from sandbox.physics.forces.gravitation import Gravitation

    if pull := given.effects.gravitation:
        rows = _rows(pull.bodies, given.names, given.mass)
        constant, softening = pull.constant(given.values), pull.softening(given.values)
        yield Gravitation(constant, rows, given.mass, softening, given.share)


def _centrifugal(given: _Given) -> Iterator[Law]:
    from sandbox.physics.forces.centrifugal import Centrifugal

    if turning := given.effects.centrifugal:
        rate, axis = turning.rate(given.values), turning.axis(given.values)
        yield Centrifugal(rate, axis, given.mass, given.share)


def _drag(given: _Given) -> Iterator[Law]:
    from sandbox.physics.forces.drag import Drag

    if drag := given.effects.drag:
        rows = in_place(_rows(drag.bodies, given.names, given.mass))
        yield Drag(drag.linear(given.values), drag.quadratic(given.values), rows)


def _force(given: _Given) -> Iterator[Law]:
    from sandbox.physics.forces.applied import Push, Steady

    steady: list[tuple[int, XY, XY]] = []
    for force in given.effects.force or ():
        point, body = evaluate(force.at, given.values), given.names.index(force.body)
        if does_work(force):
            yield Push(force.force, given.values, body, point, force.frame == "body")
        else:
            x, y = (component(given.values) for component in force.force)
            steady.append((body, point, (x, y)))
    if steady:
        yield Steady.of(steady)


def _thrust(given: _Given) -> Iterator[Law]:
    from sandbox.physics.forces.thrust import Thrust

    flows = thrust_flows(given.effects, given.values, given.names)
    for thrust, flow in zip(given.effects.thrust or (), flows, strict=True):
        yield Thrust(flow, evaluate(thrust.exhaust, given.values), given.step)


def _accretion(given: _Given) -> Iterator[Law]:
    from sandbox.physics.forces.thrust import Accretion

    flows = accretion_flows(given.effects, given.values, given.names)
    for accretion, flow in zip(given.effects.accretion or (), flows, strict=True):
        yield Accretion(flow, evaluate(accretion.velocity, given.values), given.step)


_MAKERS: Mapping[str, Callable[[_Given], Iterator[Law]]] = {
    "attraction": _attraction,
    "gravitation": _gravitation,
    "centrifugal": _centrifugal,
    "drag": _drag,
    "force": _force,
    "thrust": _thrust,
    "accretion": _accretion,
}
"""What makes the laws of an effect, by its name in the manifest."""


def _rows(bodies: Sequence[str] | None, names: Sequence[str], mass: Array) -> NDArray[np.intp]:
    """Return the rows of the bodies that a law names, of all that move if it names none."""
    return np.flatnonzero(mass) if bodies is None else np.array([names.index(b) for b in bodies])
