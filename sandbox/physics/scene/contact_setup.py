"""Sets up contacts: shapes, the choice of solver, and bodies that stick together."""

from typing import TYPE_CHECKING

import pymunk

from sandbox.model.contact_solver_choice import has_one_sided_joints, is_direct
from sandbox.model.excluded_pairs import excluded_pairs
from sandbox.model.expressions import Array, Values
from sandbox.model.level import Level, Stepping
from sandbox.physics.contacts.coefficients.pymunk_coefficients import (
    add_skin,
    correct_contacts,
    give_coefficients,
    take_bounces,
)
from sandbox.physics.contacts.detection.pair_limit import (
    MOST_HOLLOW,
    most_pairs,
    refuse_crowd,
)
from sandbox.physics.contacts.shapes.closing_corner_gaps_at_start import reach_out
from sandbox.physics.contacts.shapes.hollow_shapes import HollowShape, make_hollow
from sandbox.physics.contacts.shapes.pymunk_shapes import (
    DIRECT_SKIN,
    SKIN,
    choose_correction,
    leave_contacts,
    make_surfaces,
    run_belts,
    skip_ids,
)
from sandbox.physics.engine.broadphase import add_shapes
from sandbox.physics.joints.composite_bodies import Touches
from sandbox.physics.scene.build_context import BuildContext, Pairs

if TYPE_CHECKING:
    from sandbox.physics.contacts.direct.solver import DirectSolver
    from sandbox.physics.contacts.impacts.sequential_impacts import Sequence as Sequential
    from sandbox.physics.contacts.shapes.one_way_surfaces import Gates


def make_contacts(
    space: pymunk.Space,
    bodies: dict[str, pymunk.Body],
    level: Level,
    values: Values,
    stepping: Stepping,
) -> Pairs:
    """Give bodies their shapes, and set up the handling of their contacts."""
    ours = not stepping.is_stock
    if ours:
        skip_ids(space, level)
    direct = ours and is_direct(level, stepping)
    sequence = level.effects.in_sequence and ours and not direct
    skin = _skin(ours=ours, direct=direct)
    most = most_pairs(stepping.iterations, direct=direct)
    shapes = _make_shapes(space, bodies, level, values, skin, most)
    every = [shape for made in shapes.values() for shape in made]
    reach = add_shapes(space, every)  # last of all, as pymunk looks for pairs at once
    follows = ours and not (sequence or direct)
    drift = 1 / stepping.rate if follows else None
    hollows = make_hollow(space, level, values, shapes, skin, drift)
    gates = _make_gates(level, values, bodies, skin)
    run_belts(level, values, bodies)
    if sequence or direct:
        bounces = take_bounces(space, level, values) if sequence else None
        if not sequence:
            add_skin(space)
        count = correct_contacts(space, level, hollows, gates)
        pairs = Pairs(count, {}, bounces, reach, hollows, gates)
    else:
        given = give_coefficients(space, level, values, hollows, gates)
        pairs = Pairs(*given, None, reach, hollows, gates)
    if ours:
        reach_out(space)
        _choose_solver(space, level, values, 1 / stepping.rate, direct=direct)
    return pairs


def _make_shapes(
    space: pymunk.Space,
    bodies: dict[str, pymunk.Body],
    level: Level,
    values: Values,
    skin: float,
    most: int,
) -> dict[str, list[pymunk.Shape]]:
    """Make the shapes of bodies; refuse too many pairs."""
    shapes = {
        name: make_surfaces(spec, bodies[name], level, values, skin, kind)
        for kind, (name, spec) in enumerate(level.bodies.items(), start=1)
    }
    if pairs_apart := sorted(excluded_pairs(level)):
        from sandbox.physics.contacts.shapes.pair_exclusion import keep_apart

        keep_apart(space, bodies, pairs_apart)
    refuse_crowd(shapes, most)
    hollow = {n: s for n, s in shapes.items() if isinstance(level.bodies[n].shape, HollowShape)}
    refuse_crowd(hollow, MOST_HOLLOW)
    return shapes


def _make_gates(
    level: Level, values: Values, bodies: dict[str, pymunk.Body], skin: float
) -> "Gates | None":
    """Make the gates of surfaces that let bodies through one way, if there are any."""
    if not any(body.one_way for body in level.bodies.values()):
        return None
    from sandbox.physics.contacts.shapes.one_way_surfaces import Gates

    return Gates(level, values, bodies, skin)


def _choose_solver(
    space: pymunk.Space, level: Level, values: Values, dt: float, *, direct: bool
) -> None:
    """Leave contacts to the direct solver, or set pymunk's correction of overlaps."""
    if direct:
        leave_contacts(space)
    else:
        choose_correction(space, level, values, dt)


def _skin(*, ours: bool, direct: bool) -> float:
    """Return the thickness that is added to flat surfaces [m]."""
    if not ours:
        return 0.0
    return DIRECT_SKIN if direct else SKIN


def make_direct(made: BuildContext, pairs: Pairs) -> "DirectSolver | None":
    """Make the direct solver of contacts and exact joints, if the level uses it.

    It also locates one-sided joints that catch, in levels without contacts.
    """
    level, stepping = made.level, made.stepping
    direct = not stepping.is_stock and is_direct(level, stepping)
    if not (direct or has_one_sided_joints(level, stepping)):
        return None
    from sandbox.physics.contacts.detection.contact_queries import Query
    from sandbox.physics.contacts.direct.rows.contact_properties import surfaces_of
    from sandbox.physics.contacts.direct.solver import DirectSolver

    assert made.joints.together
    bodies = list(made.bodies.values())
    surfaces = surfaces_of(level, made.values, bodies)
    assert bodies[0].space
    query = Query(bodies[0].space, bodies, pairs.hollows, pairs.gates)
    dt = 1 / stepping.rate
    made.batch.solved_by_pymunk = False
    return DirectSolver(made.batch, made.joints.together, surfaces, made.inertia, dt, query)


def make_sequence(made: BuildContext, restitution: Array | None) -> "Sequential | None":
    """Make the solver of impacts in sequence, if there are coefficients for it."""
    if restitution is None:
        return None
    from sandbox.physics.contacts.impacts.sequential_impacts import Sequence

    return Sequence(made.batch, restitution, made.inverse_mass, 1 / made.stepping.rate)


def touches_of(space: pymunk.Space, level: Level) -> Touches | None:
    """Return the watch on pairs that are to stick together, if there are any."""
    sticking = level.effects.sticking
    if sticking is None:
        return None
    return Touches(space, list(level.bodies), [pair.bodies for pair in sticking.pairs])
