"""Why exact joints fail: they are redundant or contradictory, too many, or a step is too long.

Each equation of an exact joint is a row of a table with three entries for each body. Unless all are
separate rods and wires, every step multiplies the table by itself and solves the product. A chain
of 800 rods takes 0.1 s a step, one of 2,000 more than a second and 500 MB: too many are refused
before any table is made.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.translatable_message import Message
from sandbox.physics.engine.space_arrays import Integers
from sandbox.physics.joints.exact.constraint_conditioning import independence, steps_needed
from sandbox.physics.joints.exact.constraint_interface import Condition, Coordinates, Rows
from sandbox.physics.joints.exact.distance_equations import Row
from sandbox.physics.joints.exact.equation_tables import Equations
from sandbox.physics.joints.exact.joint_system import JointSystem
from sandbox.physics.joints.exact.separate_joints import are_apart
from sandbox.physics.state.simulation_errors import JointFailure

SINGULAR = 1e-10
"""Joints are redundant if the ratio of smallest to largest singular value is below this."""

LOCKED = 0.1
"""Joints work against each other if this ratio falls below this share of its value at the start."""

REACHED = 1e-9
"""m, rad: a rope with no more slack than this counts as taut at the start."""

MOST_TERMS = 2_000_000
"""The upper bound of equations times bodies: a table of 48 MB."""

MOST_PRODUCTS = 600_000_000
"""The upper bound of equations² times bodies: 1.8e9 products a step."""


def overlapping(names: Sequence[str], row: int) -> JointFailure:
    """Return the failure of a joint that is redundant, given the joint of each equation (m,)."""
    name = names[row]
    reason = Message("'{name}' is redundant, or cannot hold; leave it out", name=name)
    if names.count(name) > 1:
        reason = Message(
            "{reason}, or use a rod or a rail, which holds less; what hangs between two fixed"
            " points has to sag",
            reason=reason,
        )
    return JointFailure(name, reason)


def check_independent(joints: JointSystem, here: Rows, response: Array, length: Array) -> float:
    """Return the ratio of smallest to largest singular value; 1 if nothing is taut.

    `here` has the values and the Jacobian at the present positions, `response` is J M⁻¹, (m, 3 N),
    and `length`, (m,), the values to keep [m, rad]. Raises `JointFailure` if some of the taut
    joints are redundant.
    """
    taut = np.flatnonzero(here.total - length > -REACHED)
    if not len(taut):
        return 1.0
    delassus = (here.jacobian @ response.T)[np.ix_(taut, taut)]
    if not delassus.diagonal().all():
        raise overlapping(joints.names, int(taut[np.argmin(delassus.diagonal())]))
    independent, shares = independence(delassus)
    if independent < SINGULAR:
        raise overlapping(joints.names, int(taut[np.flatnonzero(shares > 1e-3)[-1]]))
    return independent


def failure(
    joints: JointSystem, row: int, taut: Integers, independent: float, tension: Array, drift: float
) -> JointFailure:
    """Return why an equation fails: joints work against each other, or the step is too long.

    The row has the largest residual; `taut` are the taut equations, (k,), and `independent` is the
    ratio of smallest to largest singular value at the start. `tension` are the forces along all
    equations in the last kick, (m,) [N], `drift` the duration of a drift [s].
    """
    pose, motion = joints.coordinates()
    if _runs_up(joints, row, pose, motion, drift):
        name = joints.names[row]
        return JointFailure(name, Message("an end of '{name}' has run into a peg", name=name))
    jacobian = joints.evaluate(pose).jacobian
    delassus = np.asarray(jacobian * joints.inverse @ jacobian.T)[np.ix_(taut, taut)]
    finer = _finer(joints, pose, tension, drift)
    if delassus.any() and np.isfinite(delassus).all():
        free, shares = independence(delassus)
        if free < LOCKED * independent:
            name = joints.names[taut[np.argmax(shares)]]
            reason = Message(
                "'{name}' and the joints beside it are stretched, and none yields in a step",
                name=name,
            )
            return JointFailure(name, reason, None if joints.is_driven(motion.values) else finer)
    name = joints.names[row]
    reason = Message("nothing keeps '{name}' as it is through the next step", name=name)
    return JointFailure(name, reason, finer)


def _runs_up(
    joints: JointSystem, row: int, pose: Coordinates, motion: Coordinates, drift: float
) -> bool:
    """Return whether a string has no length left on one side of a peg within a drift."""
    string = joints.equations.all[row]
    if not isinstance(string, Row) or len(string.reaches) < 2:
        return False
    parts = [replace(string, reaches=[reach]) for reach in string.reaches]
    here = Equations(parts, (), joints.inverse[2 * len(joints.inverse) // 3 :]).evaluate(pose)
    return bool((here.total + drift * (here.jacobian @ motion.values) <= 0).any())


def _finer(joints: JointSystem, pose: Coordinates, tension: Array, drift: float) -> float:
    """Return the factor, at least 2, by which joints under tension need more steps."""

    def force(by: Array) -> Array:
        there = joints.equations.evaluate_without_memory(Coordinates(pose.values + by))
        return np.asarray(tension @ there.jacobian)

    return steps_needed(force, joints.inverse, drift)


def refuse_too_many(equations: Sequence[Condition], inverse: Array) -> None:
    """Refuse more equations than a step can solve, by a `JointFailure`.

    The equations are those of all exact joints that are solved together; `inverse`, (n,), are the
    inverse masses of the bodies, 0 of those that nothing moves [1/kg].
    """
    count, bodies = len(equations), len(inverse)
    solved = count**2 * bodies > MOST_PRODUCTS
    if count * bodies <= MOST_TERMS and not solved:
        return
    if count * bodies > MOST_TERMS or not are_apart(equations, np.append(inverse, 0.0)):
        most = min(MOST_TERMS // bodies, int((MOST_PRODUCTS / bodies) ** 0.5))
        reason = Message(
            "the exact joints make {count:,} equations among {bodies:,} bodies; at most"
            " {most:,} can be solved, so make most joints springs, or split the level",
            count=count,
            bodies=bodies,
            most=most,
        )
        raise JointFailure(equations[-1].joint, reason)
