"""Makes a pymunk space from a level, as the scene that a world runs.

Only effects that a level declares are set up: without contact there are no shapes in the space,
without rotation every moment is infinite, without friction or restitution coefficients are zero.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
import pymunk

from sandbox.garbage_collection_pause import uncollected
from sandbox.model.contact_solver_choice import has_one_sided_joints, is_direct
from sandbox.model.expressions import Array, Values
from sandbox.model.level import Level, Stepping
from sandbox.physics.engine.pymunk_bodies import make_body
from sandbox.physics.engine.space_arrays import Batch
from sandbox.physics.forces.declared_laws import gravity, laws, mass_fraction_of
from sandbox.physics.forces.gravity import Gravity
from sandbox.physics.forces.law import Law, LawInputs, VelocityRotation
from sandbox.physics.forces.variable_mass import MassFraction
from sandbox.physics.joints.scene_joints import Joints
from sandbox.physics.scene.build_context import BuildContext, Pairs

if TYPE_CHECKING:
    from sandbox.physics.contacts.coefficients.static_friction import Sticking
    from sandbox.physics.contacts.direct.solver import DirectSolver
    from sandbox.physics.contacts.impacts.sequential_impacts import Sequence as Sequential
    from sandbox.physics.contacts.shapes.arc_contact_correction import Hollows
    from sandbox.physics.contacts.shapes.one_way_surfaces import Gates
    from sandbox.physics.forces.force_switch import Switches


@dataclass(frozen=True, slots=True)
class Scene:
    """A level's objects in pymunk, with the data for running and measuring it."""

    space: pymunk.Space
    """pymunk's space."""
    bodies: dict[str, pymunk.Body]
    """The n bodies in the level's order, with static and kinematic ones."""
    batch: Batch
    """Reads and writes the bodies."""
    mass: Array
    moment: Array
    """(n,), of dynamic bodies at the start, 0 for others [kg, kg m²]. The moment is also 0 in a
    level without rotation."""
    inertia: Array
    """(n, 3), mass, mass and moment [kg, kg m²]."""
    mass_fraction: MassFraction
    """The masses over those at the start, as a function of time."""
    inverse_mass: Array
    """(n, 3), one over the inertia, 0 of bodies that do not move or turn [1/kg, 1/(kg m²)]."""
    joints: Joints
    """The joints, in the level's order."""
    pair_callbacks: int
    """The number of callbacks by the pairs with coefficients of their own, with one contact each.
    """
    sticking: "Mapping[frozenset[int], Sticking]"
    """The friction of pairs whose static coefficient is larger, by the indices of their bodies."""
    sequence: "Sequential | None"
    """The solver of impacts in sequence; None if the level does not use it."""
    reach: float
    """The distance from the origin within which pymunk finds pairs [m]."""
    direct: "DirectSolver | None"
    """The solver of contacts together with exact joints; None if pymunk solves contacts."""
    hollows: "Hollows | None"
    """The arcs, and the hoops that may have bodies inside; None if there are none."""
    gates: "Gates | None"
    """The surfaces that let bodies through one way; None if there are none."""
    gravity: Gravity | None
    laws: tuple[Law, ...]
    """Uniform gravity, which pymunk applies, and the force laws."""
    hooked_laws: tuple[Law, ...]
    """The laws that need a hook: all but the springs that pymunk applies."""
    rotations: tuple[VelocityRotation, ...]
    """The laws that turn velocities, and do no work."""
    switches: "Switches"
    """The switches of forces that events turn on and off, by name."""
    event_times: dict[str, float] = field(default_factory=dict)
    """The times of the events so far, by name [s]."""


@uncollected()
def make_scene(level: Level, values: Values, stepping: Stepping) -> Scene:
    """Make the pymunk objects of a level for the given parameters.

    Raises `SimulationError` if springs or drags are too strong for the rate, or bodies overlap that
    must not.
    """
    space, bodies = _make_space(level, values, stepping)
    pairs = _set_up_contacts(space, bodies, level, values, stepping)
    mass, moment, inertia, inverse_mass = _inertia(list(bodies.values()))
    mass_fraction = mass_fraction_of(level.effects, values, list(bodies), mass)
    if field := gravity(level.effects, values, mass, mass_fraction):
        space.gravity = field.acceleration
    batch = Batch(space, list(bodies.values()))
    joints = _make_joints(level, values, stepping, bodies, batch, inverse_mass, pairs)
    switches = _make_switches(level, joints)
    inputs = LawInputs(
        level, values, list(bodies), mass, mass_fraction, 1 / stepping.rate, switches
    )
    forces, rotations = laws(level.effects, inputs)
    context = BuildContext(level, values, stepping, bodies, batch, joints, inertia, inverse_mass)
    solver, sequence = _solvers(context, pairs)
    hooked = _hooked(context, forces, rotations, mass_fraction)
    return Scene(
        space=space,
        bodies=bodies,
        batch=batch,
        mass=mass,
        moment=moment,
        inertia=inertia,
        mass_fraction=mass_fraction,
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
        hooked_laws=hooked,
        rotations=rotations,
        switches=switches,
    )


def _make_space(
    level: Level, values: Values, stepping: Stepping
) -> tuple[pymunk.Space, dict[str, pymunk.Body]]:
    """Make the space with its bodies."""
    space = pymunk.Space()
    space.iterations = stepping.iterations
    bodies = {name: make_body(name, level, values) for name in level.bodies}
    space.add(*bodies.values())
    return space, bodies


def _hooked(
    context: BuildContext,
    forces: tuple[Law, ...],
    rotations: tuple[VelocityRotation, ...],
    mass_fraction: MassFraction,
) -> tuple[Law, ...]:
    """Return the laws that are called in each step; refuse a rate that is too low for any."""
    if not (context.joints.springs or forces or rotations):
        return forces
    from sandbox.physics.scene.pymunk_springs import check_rate, hooked_springs

    check_rate(context, forces, rotations)
    return (*forces, *hooked_springs(context, mass_fraction))


def _inertia(bodies: Sequence[pymunk.Body]) -> tuple[Array, Array, Array, Array]:
    """Return masses (n,), moments (n,), inertia (n, 3) and its inverse (n, 3); see `Scene`."""
    dynamic = [body.body_type == pymunk.Body.DYNAMIC for body in bodies]
    moment = np.array([body.moment for body in bodies])
    mass = np.where(dynamic, [body.mass for body in bodies], 0.0)
    moment = np.where(np.isfinite(moment) & dynamic, moment, 0.0)
    inertia = np.stack((mass, mass, moment), axis=1)
    inverse = np.divide(1.0, inertia, out=np.zeros_like(inertia), where=inertia > 0)
    return mass, moment, inertia, inverse


def _set_up_contacts(
    space: pymunk.Space,
    bodies: dict[str, pymunk.Body],
    level: Level,
    values: Values,
    stepping: Stepping,
) -> Pairs:
    """Set up contacts, if the level has any."""
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
    """Make the joints; also for contacts, which may be solved together with exact joints."""
    contact = level.effects.contact
    if not (level.joints or contact or level.effects.sticking):
        return Joints()
    from sandbox.physics.joints.make_joints import assemble
    from sandbox.physics.scene.contact_setup import touches_of

    space = next(iter(bodies.values())).space
    assert space
    touches, direct = touches_of(space, level), is_direct(level, stepping)
    bounces = direct and stepping.scheme == "leapfrog" and not level.changes_during_run
    made = bodies, batch, inverse_mass, touches
    joints = assemble(level, values, *made, direct=direct, bounces=bounces)
    if contact:
        from sandbox.physics.contacts.detection.overlaps_at_start import refuse_overlaps

        refuse_overlaps(space, bodies, contact, values, pairs.hollows, pairs.gates)
    return joints


def _make_switches(level: Level, joints: Joints) -> "Switches":
    """Make the switches of forces, if the level has events."""
    if not level.has_events:
        return {}
    from sandbox.physics.scene.make_force_switches import make_switches

    return make_switches(level, joints)


def _solvers(
    context: BuildContext, pairs: Pairs
) -> "tuple[DirectSolver | None, Sequential | None]":
    """Make the solvers of contacts and of impacts in sequence; None where pymunk solves them."""
    if not (context.level.effects.contact or has_one_sided_joints(context.level, context.stepping)):
        return None, None
    from sandbox.physics.scene.contact_setup import make_direct, make_sequence

    return make_direct(context, pairs), make_sequence(context, pairs.restitution)
