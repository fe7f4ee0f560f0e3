"""Limits the number of equations of exact joints, before any table is made.

Each equation is a row of a table with three entries for each body. Unless all are separate rods and
wires, every step multiplies the table by itself and solves the product. A chain of 800 rods takes
0.1 s a step, one of 2,000 more than a second and 500 MB.
"""

from collections.abc import Sequence

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.translatable_message import Message
from sandbox.physics.joints.exact.constraint_interface import Condition
from sandbox.physics.joints.exact.separate_joints import are_apart
from sandbox.physics.state.errors import JointFailure

MOST_TERMS = 2_000_000
"""The upper bound of equations times bodies: a table of 48 MB."""

MOST_PRODUCTS = 600_000_000
"""The upper bound of equations² times bodies: 1.8e9 products a step."""


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
