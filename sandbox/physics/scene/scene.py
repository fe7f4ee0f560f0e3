"""From a level to a pymunk space, as the scene that a world runs.

What a level does not declare is not made: without contact no shape joins the space, without
rotation every moment is infinite, without friction or restitution the coefficients are zero.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import pymunk

from sandbox.model.expressions import Array, Values
from sandbox.model.level import Level, Stepping, is_direct
from sandbox.physics.contacts.corners import reach_out
from sandbox.physics.contacts.hollow_contacts import Hollows
from sandbox.physics.contacts.hollow_shapes import make_hollow
from sandbox.physics.contacts.materials import (
    correct_contacts,
    give_coefficients,
    stand_proud,
    take_bounces,
)
from sandbox.physics.contacts.overlaps import refuse_overlaps
from sandbox.physics.contacts.shapes import (
    DIRECT_HAIR,
    HAIR,
    choose_correction,
    leave_contacts,
    make_surfaces,
    run_belts,
    skip_ids,
)
from sandbox.physics.contacts.static_friction import Sticking
from sandbox.physics.engine.batch import Batch
from sandbox.physics.engine.bodies import make_body
from sandbox.physics.engine.broadphase import choose_broad_phase
from sandbox.physics.forces.declared import Gravity, Law, gravity, laws
from sandbox.physics.forces.spring import SpringForce
from sandbox.physics.forces.variable_mass import Share, mass_share
from sandbox.physics.joints.assembly import Joints
from sandbox.physics.joints.composites import Touches
from sandbox.physics.joints.native import pull_by_pymunk
from sandbox.physics.scene.stability_limits import check_drag, check_springs
from sandbox.physics.state.motion import Reading

if TYPE_CHECKING:
    from sandbox.physics.contacts.direct.solver import Direct
    from sandbox.physics.contacts.sequential_impacts import Sequence as Sequential


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
    agility
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
    gravity, laws
        What acts on the bodies; gravity is pymunk's own.
    hooked
        The laws that need a hook: all but the springs that pymunk pulls.
    """

    space: pymunk.Space
    bodies: dict[str, pymunk.Body]
    batch: Batch
    mass: Array
    moment: Array
    inertia: Array
    share: Share
    agility: Array
    joints: Joints
    pair_callbacks: int
    sticking: Mapping[frozenset[int], Sticking]
    sequence: "Sequential | None"
    reach: float
    direct: "Direct | None"
    hollows: Hollows | None
    gravity: Gravity | None
    laws: tuple[Law, ...]
    hooked: tuple[Law, ...]


def make_scene(level: Level, values: Values, stepping: Stepping) -> Scene:
    """Make the pymunk objects of a level for the given parameters.

    Raises
    ------
    SimulationError
        If springs are too stiff for the rate, or a drag too strong; if bodies overlap, and the
        level does not say that they may.
    """
    space = pymunk.Space()
    space.iterations = stepping.iterations
    bodies = {name: make_body(name, level, values) for name in level.bodies}
    space.add(*bodies.values())
    pairs = _make_contacts(space, bodies, level, values, stepping)
    mass, moment = _inertia(list(bodies.values()))
    inertia = np.stack((mass, mass, moment), axis=1)
    agility = np.divide(1.0, inertia, out=np.zeros_like(inertia), where=inertia > 0)
    share = mass_share(level.effects, values, list(bodies), mass)
    field = gravity(level.effects, values, mass, share)
    if field:
        space.gravity = field.acceleration
    batch = Batch(space, list(bodies.values()))
    joints = Joints(level, values, bodies, batch, agility, _touches(space, level))
    if level.effects.contact and not level.effects.contact.overlaps:
        refuse_overlaps(space, bodies, pairs.hollows)
    forces = laws(level.effects, values, list(bodies), mass, share, 1 / stepping.rate)
    direct = _make_direct(level, values, stepping, list(bodies.values()), joints, batch, inertia)
    _check_rate(list(bodies), batch, agility, joints, forces, stepping)
    return Scene(
        space=space,
        bodies=bodies,
        batch=batch,
        mass=mass,
        moment=moment,
        inertia=inertia,
        share=share,
        agility=agility,
        joints=joints,
        pair_callbacks=pairs.callbacks,
        sticking=pairs.sticking,
        sequence=_make_sequence(pairs.restitution, batch, agility, joints, 1 / stepping.rate),
        reach=pairs.reach,
        direct=direct,
        hollows=pairs.hollows,
        gravity=field,
        laws=(*forces, *joints.springs.values()),
        hooked=(*forces, *_hooked(joints.springs, list(bodies.values()), level, stepping)),
    )


def _inertia(bodies: Sequence[pymunk.Body]) -> tuple[Array, Array]:
    """Return masses and moments: (n,) each, 0 where nothing moves or turns [kg, kg m²]."""
    dynamic = [body.body_type == pymunk.Body.DYNAMIC for body in bodies]
    moment = np.array([body.moment for body in bodies])
    mass = np.where(dynamic, [body.mass for body in bodies], 0.0)
    return mass, np.where(np.isfinite(moment) & dynamic, moment, 0.0)


def _check_rate(
    names: Sequence[str],
    batch: Batch,
    agility: Array,
    joints: Joints,
    forces: Sequence[Law],
    stepping: Stepping,
) -> None:
    """Refuse a rate that is too low for the springs, or for the drags."""
    start = Reading(np.zeros(()), batch.state())
    reach = _reach(stepping, held=bool(joints.together))
    check_springs(joints.springs, agility, start.angle, stepping.rate, reach)
    for law in forces:
        if law.needs_velocity and not stepping.as_it_comes:
            check_drag(law, names, start, joints, agility, stepping.rate)


def _reach(stepping: Stepping, *, held: bool) -> float:
    """Return the largest ω h at which the scheme is stable; 2 for leapfrog."""
    if stepping.scheme != "fourth-order":
        return 2.0
    from sandbox.physics.scene.compositions import fourth_order

    return fourth_order(held=held).reach


def _hooked(
    springs: Mapping[str, SpringForce],
    bodies: Sequence[pymunk.Body],
    level: Level,
    stepping: Stepping,
) -> Iterator[SpringForce]:
    """Leave plain springs to pymunk, and yield the others.

    Where bodies touch, what pulls them apart from contacts must be known by itself; where matter
    flows, masses are known only in the hook; and pymunk's pulls are those of leapfrog.
    """
    effects, space = level.effects, bodies[0].space
    flows = effects.thrust or effects.accretion
    simple = stepping.scheme == "leapfrog" and not (effects.contact or flows)
    moves = [body.body_type == pymunk.Body.DYNAMIC for body in bodies]
    for spring in springs.values():
        held = any(end.body is not None and moves[end.body] for end in spring.ends)
        if simple and space and held and not (spring.damping or spring.pushes_only):
            pull_by_pymunk(spring, bodies, space)
        else:
            yield spring


class _Pairs(NamedTuple):
    """How many callbacks pairs of bodies make, and what `Scene` says of them."""

    callbacks: int
    sticking: Mapping[frozenset[int], Sticking]
    restitution: Array | None
    reach: float
    hollows: Hollows | None


def _make_contacts(
    space: pymunk.Space,
    bodies: dict[str, pymunk.Body],
    level: Level,
    values: Values,
    stepping: Stepping,
) -> _Pairs:
    """Give bodies the shapes with which they touch, and say what happens where they do."""
    if not level.effects.contact:
        return _Pairs(0, {}, None, inf, None)
    ours = not stepping.as_it_comes
    if ours:
        skip_ids(space, level)
    sequence = level.effects.in_sequence and ours
    direct = ours and is_direct(level)
    hair, shapes = _hair(ours=ours, direct=direct), {}
    for kind, (name, spec) in enumerate(level.bodies.items(), start=1):
        shapes[name] = make_surfaces(spec, bodies[name], level, values, hair, kind)
        space.add(*shapes[name])
    follows = ours and not (sequence or direct)
    drift = 1 / stepping.rate if follows else None
    hollows = make_hollow(space, level, values, shapes, hair, drift)
    reach = choose_broad_phase(space)
    run_belts(level, values, bodies)
    if sequence or direct:
        bounces = take_bounces(space, level, values) if sequence else None
        if not sequence:
            stand_proud(space)
        count = correct_contacts(space, level, hollows) if hollows else 0
        pairs = _Pairs(count, {}, bounces, reach, hollows)
    else:
        given = give_coefficients(space, level, values, hollows)
        pairs = _Pairs(*given, None, reach, hollows)
    if ours:
        reach_out(space)
        _choose_solver(space, level, values, 1 / stepping.rate)
    return pairs


def _choose_solver(space: pymunk.Space, level: Level, values: Values, dt: float) -> None:
    """Leave contacts to what solves them directly, or say how pymunk is to take overlaps back."""
    if is_direct(level):
        leave_contacts(space)
    else:
        choose_correction(space, level, values, dt)


def _hair(*, ours: bool, direct: bool) -> float:
    """Return how far flat surfaces stand proud [m]."""
    if not ours:
        return 0.0
    return DIRECT_HAIR if direct else HAIR


def _make_direct(
    level: Level,
    values: Values,
    stepping: Stepping,
    bodies: Sequence[pymunk.Body],
    joints: Joints,
    batch: Batch,
    inertia: Array,
) -> "Direct | None":
    """Make what solves contacts and exact joints together, where the level wants it."""
    if stepping.as_it_comes or not is_direct(level):
        return None
    from sandbox.physics.contacts.direct.solver import Direct
    from sandbox.physics.contacts.direct.surfaces import surfaces_of

    assert joints.together
    surfaces = surfaces_of(level, values, bodies)
    dt, strikes = 1 / stepping.rate, not level.effects.in_sequence
    return Direct(batch, joints.together, surfaces, inertia, dt, strikes=strikes)


def _make_sequence(
    restitution: Array | None, batch: Batch, agility: Array, joints: Joints, dt: float
) -> "Sequential | None":
    """Make what lets impacts come one after the other, where their coefficients say so."""
    if restitution is None:
        return None
    from sandbox.physics.contacts.sequential_impacts import Sequence as Sequential

    return Sequential(batch, restitution, agility, joints.together, dt)


def _touches(space: pymunk.Space, level: Level) -> Touches | None:
    """Watch the pairs that are to stick to each other, if there are any."""
    sticking = level.effects.sticking
    if sticking is None:
        return None
    return Touches(space, list(level.bodies), [pair.bodies for pair in sticking.pairs])
