"""Selects the springs that pymunk applies itself, and checks the rate for all forces."""

from collections.abc import Iterator, Sequence

import numpy as np
import pymunk

from sandbox.model.contact_solver_choice import has_one_sided_joints
from sandbox.model.level import Stepping
from sandbox.physics.forces.law import Law, VelocityRotation
from sandbox.physics.forces.spring import SpringForce
from sandbox.physics.forces.variable_mass import MassFlows, MassFraction
from sandbox.physics.scene.build_context import BuildContext
from sandbox.physics.scene.stability_limits import check_drag, check_springs, check_turn
from sandbox.physics.state.motion import Reading


def check_rate(
    made: BuildContext, forces: Sequence[Law], turns: Sequence[VelocityRotation]
) -> None:
    """Refuse a rate that is too low for springs, drags, or forces that turn velocities."""
    joints, inverse_mass, stepping = made.joints, made.inverse_mass, made.stepping
    drags = [law for law in forces if law.effect.depends_on_velocity and not stepping.is_stock]
    if not (joints.springs or drags or turns):
        return
    start = Reading(np.zeros(()), made.batch.state())
    reach = _reach(stepping, held=bool(joints.together))
    check_springs(joints.springs, inverse_mass, start.angle, stepping.rate, reach)
    names = list(made.bodies)
    for turn in turns:
        check_turn(turn, names, start, stepping.rate)
    for law in drags:
        check_drag(law, names, start, joints, inverse_mass, stepping.rate)


def _reach(stepping: Stepping, *, held: bool) -> float:
    """Return the largest ω h at which the scheme is stable; 2 for leapfrog."""
    if not stepping.is_composed:
        return 2.0
    from sandbox.physics.scene.composition_schemes import composition

    return composition(stepping.order, is_constrained=held).stability_limit


def hooked_springs(made: BuildContext, share: MassFraction) -> Iterator[SpringForce]:
    """Add plain springs to pymunk's space, and yield all others.

    pymunk applies none in a level with contacts, or with one-sided joints that may catch, where
    other forces must be known; none where masses change, as these are known only in the hook; and
    none in schemes other than leapfrog.
    """
    level, bodies = made.level, list(made.bodies.values())
    space, flows = bodies[0].space, isinstance(share, MassFlows)
    known = level.effects.contact or has_one_sided_joints(level, made.stepping)
    simple = made.stepping.scheme == "leapfrog" and not (known or flows)
    moves = [body.body_type == pymunk.Body.DYNAMIC for body in bodies]
    for spring in made.joints.springs.values():
        held = any(end.body is not None and moves[end.body] for end in spring.ends)
        plain = not (spring.damping or spring.pushes_only or spring.law or spring.switch)
        if simple and space and held and plain:
            from sandbox.physics.joints.pymunk_joints import pull_by_pymunk

            pull_by_pymunk(spring, bodies, space)
        else:
            yield spring
