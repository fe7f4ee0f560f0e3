"""From a level to a pymunk space, as the scene that a world runs.

What a level does not declare is not made: without contact no shape joins the space, without
rotation every moment is infinite, without friction or restitution the coefficients are zero.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
import pymunk

from sandbox.model.expressions import Array, Values
from sandbox.model.level import Level, Stepping, is_direct
from sandbox.physics.engine.batch import Batch
from sandbox.physics.engine.bodies import make_body
from sandbox.physics.forces.declared_laws import Gravity, Law, Turn, gravity, laws, mass_share
from sandbox.physics.forces.law import Given
from sandbox.physics.forces.variable_mass import Share
from sandbox.physics.joints.joints import Joints
from sandbox.physics.scene.build_context import Made, Pairs

if TYPE_CHECKING:
    from sandbox.physics.contacts.direct.solver import Direct
    from sandbox.physics.contacts.hollow_contacts import Hollows
    from sandbox.physics.contacts.one_way import Gates
    from sandbox.physics.contacts.sequential_impacts import Sequence as Sequential
    from sandbox.physics.contacts.static_friction import Sticking
    from sandbox.physics.forces.switch import Switches


@dataclass(frozen=True, slots=True)
class Scene:
    """A level's objects in pymunk, and what must be known of them to run and to measure.

    Attributes
    ----------
    bodies
        In the level's order, static and kinematic ones included; n of them.
    batch
        Reads and writes them.
    mass, moment
        (n,), of dynamic bodies at the start; 0 for others. The moment is 0, too, where nothing
        rotates.
    inertia
        (n, 3), mass, mass and moment [kg, kg m²].
    share
        How they change.
    inverse_mass
        (n, 3), what a force or torque is multiplied by to give an acceleration: one over the
        inertia, 0 of what nothing moves or turns [1/kg, 1/(kg m²)].
    joints
        The joints, in the level's order.
    pair_callbacks
        How many callbacks the pairs with coefficients of their own make, with a contact each.
    sticking
        The friction of pairs whose static coefficient is larger, by their bodies' numbers.
    sequence
        Lets impacts come one after the other; None where that is not how the level wants them.
    reach
        How far from the origin pymunk can look for pairs [m].
    direct
        Solves contacts and exact joints together; None where pymunk solves contacts.
    hollows
        The arcs, and the hoops that may have something in them; None if there are none.
    gates
        The surfaces that let bodies through one way; None if there are none.
    gravity, laws
        What acts on the bodies; gravity is pymunk's own.
    hooked
        The laws that need a hook: all but the springs that pymunk pulls.
    turns
        What turns velocities, and does no work.
    switches
        Of the forces that events switch, by name.
    happened
        The events that were, and when [s].
    """

    space: pymunk.Space
    bodies: dict[str, pymunk.Body]
    batch: Batch
    mass: Array
    moment: Array
    inertia: Array
    share: Share
    inverse_mass: Array
    joints: Joints
    pair_callbacks: int
    sticking: "Mapping[frozenset[int], Sticking]"
    sequence: "Sequential | None"
    reach: float
    direct: "Direct | None"
    hollows: "Hollows | None"
    gates: "Gates | None"
    gravity: Gravity | None
    laws: tuple[Law, ...]
    hooked: tuple[Law, ...]
    turns: tuple[Turn, ...]
    switches: "Switches"
    happened: dict[str, float] = field(default_factory=dict)


def make_scene(level: Level, values: Values, stepping: Stepping) -> Scene:
    """Make the pymunk objects of a level for the given parameters.

    Raises
    ------
    SimulationError
        If springs or drags are too strong for the rate, or bodies overlap that may not.
    """
    space, bodies = _make_space(level, values, stepping)
    pairs = _touching(space, bodies, level, values, stepping)
    mass, moment, inertia, inverse_mass = _inertia(list(bodies.values()))
    share = mass_share(level.effects, values, list(bodies), mass)
    if field := gravity(level.effects, values, mass, share):
        space.gravity = field.acceleration
    batch = Batch(space, list(bodies.values()))
    joints = _make_joints(level, values, stepping, bodies, batch, inverse_mass, pairs)
    switches = _make_switches(level, joints)
    given = Given(level, values, list(bodies), mass, share, 1 / stepping.rate, switches)
    forces, turns = laws(level.effects, given)
    made = Made(level, values, stepping, bodies, batch, joints, inertia, inverse_mass)
    solver, sequence = _solvers(made, pairs)
    hooked = _hooked(made, forces, turns, share)
    return Scene(
        space=space,
        bodies=bodies,
        batch=batch,
        mass=mass,
        moment=moment,
        inertia=inertia,
        share=share,
        inverse_mass=inverse_mass,
        joints=joints,
        pair_callbacks=pairs.callbacks,
        sticking=pairs.sticking,
        sequence=sequence,
        reach=pairs.reach,
        direct=solver,
        hollows=pairs.hollows,
        gates=pairs.gates,
        gravity=field,
        laws=(*forces, *joints.springs.values()),
        hooked=hooked,
        turns=turns,
        switches=switches,
    )


def _make_space(
    level: Level, values: Values, stepping: Stepping
) -> tuple[pymunk.Space, dict[str, pymunk.Body]]:
    """Make the space, and the bodies in it."""
    space = pymunk.Space()
    space.iterations = stepping.iterations
    bodies = {name: make_body(name, level, values) for name in level.bodies}
    space.add(*bodies.values())
    return space, bodies


def _hooked(
    made: Made, forces: tuple[Law, ...], turns: tuple[Turn, ...], share: Share
) -> tuple[Law, ...]:
    """Return the laws that are called in each step, if the rate is high enough for all."""
    if not (made.joints.springs or forces or turns):
        return forces
    from sandbox.physics.scene.springs import check_rate, hooked_springs

    check_rate(made, forces, turns)
    return (*forces, *hooked_springs(made, share))


def _inertia(bodies: Sequence[pymunk.Body]) -> tuple[Array, Array, Array, Array]:
    """Return masses and moments, 0 where nothing moves or turns [kg, kg m²].

    (n,) and (n,), and for the coordinates x, y, θ: (n, 3), and the inverse of that, 0 for 0.
    """
    dynamic = [body.body_type == pymunk.Body.DYNAMIC for body in bodies]
    moment = np.array([body.moment for body in bodies])
    mass = np.where(dynamic, [body.mass for body in bodies], 0.0)
    moment = np.where(np.isfinite(moment) & dynamic, moment, 0.0)
    inertia = np.stack((mass, mass, moment), axis=1)
    inverse = np.divide(1.0, inertia, out=np.zeros_like(inertia), where=inertia > 0)
    return mass, moment, inertia, inverse


def _touching(
    space: pymunk.Space,
    bodies: dict[str, pymunk.Body],
    level: Level,
    values: Values,
    stepping: Stepping,
) -> Pairs:
    """Give bodies the shapes with which they touch, if they do."""
    if not level.effects.contact:
        return Pairs()
    from sandbox.physics.scene.contact_setup import make_contacts

    return make_contacts(space, bodies, level, values, stepping)


def _make_joints(
    level: Level,
    values: Values,
    stepping: Stepping,
    bodies: dict[str, pymunk.Body],
    batch: Batch,
    inverse_mass: Array,
    pairs: Pairs,
) -> Joints:
    """Make the joints, if anything may ever hold bodies together."""
    contact = level.effects.contact
    if not (level.joints or contact or level.effects.sticking):
        return Joints()
    from sandbox.physics.joints.assembly import assemble
    from sandbox.physics.scene.contact_setup import touches_of

    space = next(iter(bodies.values())).space
    assert space
    touches, direct = touches_of(space, level), is_direct(level, stepping)
    joints = assemble(level, values, bodies, batch, inverse_mass, touches, direct=direct)
    if contact and not contact.overlaps:
        from sandbox.physics.contacts.overlaps import refuse_overlaps

        refuse_overlaps(space, bodies, contact, values, pairs.hollows, pairs.gates)
    return joints


def _make_switches(level: Level, joints: Joints) -> "Switches":
    """Make what events switch on and off, if anything ever happens."""
    if not level.happens:
        return {}
    from sandbox.physics.scene.switches import make_switches

    return make_switches(level, joints)


def _solvers(made: Made, pairs: Pairs) -> "tuple[Direct | None, Sequential | None]":
    """Make what solves contacts, or impacts, where that is not pymunk."""
    if not made.level.effects.contact:
        return None, None
    from sandbox.physics.scene.contact_setup import make_direct, make_sequence

    return make_direct(made, pairs), make_sequence(made, pairs.restitution)
