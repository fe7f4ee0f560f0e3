"""The impacts of a step: which bodies collided, where, and with what impulse.

For a contact that begins in a step, the impulse is the one that the engine reports for the pair.
Bodies that touch already, as in a Newton's cradle, collide in turn (`sequential_impacts`) or
together (`contacts.direct`). Impacts in turn are reported per body; the impulse of a pair is then
taken as the smaller of its bodies' impulses, an upper bound.

A body at rest receives a contact impulse in every step, too, which changes its velocity by about as
much as gravity and force laws do in a step. An impact changes it by more.
"""

from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.batch import Integers
from sandbox.physics.stepping.world import World

SUDDEN = 2.0
"""The least change of velocity in an impact, as a multiple of what forces cause in a step."""


class Impacts(NamedTuple):
    """The impacts of one step; k pairs of bodies."""

    bodies: Integers
    """(k, 2), the bodies' indices."""
    at: Array
    """(k, 2), the contact point, or the midpoint of two [m]."""
    impulse: Array
    """(k,), the normal impulse [N s]."""
    lighter: Integers
    """(k,), the index of the lighter of the two bodies that can move."""
    momentum: float
    """The largest momentum of a body at the beginning of the kick, after located impacts [kg m/s].
    """


def impacts(world: World) -> Impacts | None:
    """Return the impacts of the last step that a world observed; None if there were none."""
    contacts, scene = world.contacts, world.scene
    if not len(contacts.bodies):
        return None
    struck, impulse = contacts.first, contacts.normal
    solver = scene.sequence or scene.direct
    if solver:
        found = solver.last
        struck = struck | found.struck[contacts.bodies].any(axis=1)
        impulse = impulse + found.impulse[contacts.bodies].min(axis=1)
    rows = np.flatnonzero(struck)
    if not len(rows):
        return None
    step, bodies = world.last, contacts.bodies[rows]
    yields = scene.inverse_mass[bodies, 0]
    gives = np.hypot(*step.smooth[:, :2].T)[bodies].sum(axis=1) * step.dt
    sudden = impulse[rows] * yields.sum(axis=1) > SUDDEN * gives
    rows, bodies, yields = rows[sudden], bodies[sudden], yields[sudden]
    if not len(rows):
        return None
    two = (contacts.touches[rows] == 2)[:, None]
    first, second = contacts.points[rows].swapaxes(0, 1)
    at = np.where(two, (first + second) / 2, first)
    momentum = float((scene.mass * np.hypot(*step.begun[:, :2].T)).max(initial=0.0))
    lighter = bodies[np.arange(len(rows)), yields.argmax(axis=1)]
    return Impacts(bodies, at, impulse[rows], lighter, momentum)
