"""What follows from which of two bodies in contact has the side, and the radii that roll on it."""

from collections.abc import Sequence

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.rows.contact_points import ContactPoints, Sides
from sandbox.physics.contacts.direct.rows.curve_contacts import CurveContact, roll_on_curves
from sandbox.physics.engine.space_arrays import Booleans, Integers
from sandbox.physics.state.joint_anchors import Complexes


def sides_of(
    touching: ContactPoints,
    is_round: Booleans,
    owns: Booleans,
    sign: Array | None,
    bends: Booleans | None,
    curved: Sequence[CurveContact],
) -> Sides:
    """Return what follows from the bodies with the sides; for the arguments see `_rolls`."""
    rows, rubs = touching.rows, touching.friction_points
    side = np.where(owns[1], touching.bodies[1], touching.bodies[0])
    rolls = _rolls(touching, is_round, owns, sign, bends)
    if curved:
        roll_on_curves(curved, owns[0] | owns[1], rubs, touching.figures, rolls)
    is_owner = owns.take(rows, axis=1).astype(float)
    return Sides(side.take(rows), is_owner, rolls, _circles(sign, curved, rubs))


def _rolls(
    touching: ContactPoints,
    is_round: Booleans,
    owns: Booleans,
    sign: Array | None,
    bends: Booleans | None,
) -> Array:
    """Return the radii by which the angles of the two bodies count in the slip: (2, f) [m].

    `is_round` and `owns`, (2, k), tell whether the bodies are round there, and which has the side.
    `sign`, (k,), is that of the gap between discs, s in `gap_functions`, and 0 where there is a
    side; None if there is one everywhere. `bends`, (2, k), tells where they have rounded corners;
    None if nowhere.
    """
    outlines, rubs = touching.outlines, touching.friction_points
    if not len(rubs):
        return np.zeros((2, 0))
    if sign is None:
        radius = outlines.rolls(is_round, bends, None).take(rubs, axis=1)
        return np.where(owns.take(rubs, axis=1), radius[::-1], -radius)
    inner = None
    if touching.figures.hollow:
        inner = (sign < 0) & (outlines.inner > 0)
        inner[1] &= ~inner[0] | (outlines.inner[1] > outlines.inner[0])
        inner[0] &= ~inner[1]
    radius = outlines.rolls(is_round, bends, inner).take(rubs, axis=1)
    own = -radius if inner is None else np.where(inner.take(rubs, axis=1), radius, -radius)
    return np.where(owns.take(rubs, axis=1), radius[::-1], own)


def _circles(sign: Array | None, curved: Sequence[CurveContact], rubs: Integers) -> Array:
    """Return s for friction between discs, and 0 where there is a side or a curve: (f,)."""
    if sign is None:
        return np.zeros(len(rubs))
    circles = sign.copy()
    for one in curved:
        circles[one.point] = 0.0
    return circles.take(rubs)


def to_the_middle(rolls: Array, circles: Array, apart: Complexes) -> Array:
    """Return radii that end midway in the gap or overlap: (2, f) [m].

    Friction then acts on both bodies at one point, and leaves their angular momentum as it is. For
    `rolls` and `circles` see `Features`; `apart`, (f,), is from one centre to the other [m].
    """
    if not np.count_nonzero(circles):
        return rolls
    missing = np.where(circles, -circles * np.abs(apart) - rolls.sum(axis=0), 0.0)
    centred: Array = rolls + missing / 2
    return centred
