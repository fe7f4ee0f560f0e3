"""The impacts of a step: which bodies collided, where, and with what impulse.

For a contact that begins in a step, the impulse is the one that the engine reports for the pair.
Bodies that touch already, as in a Newton's cradle, collide in turn (`sequential_impacts`) or
together (`contacts.direct`). Impacts at a step are reported per body; the impulse of a pair is then
taken as the smaller of its bodies' impulses, an upper bound. Landings are reported by pair.

A body at rest receives a contact impulse in every step, too, which changes its velocity by about as
much as gravity and force laws do in a step. An impact changes it by more.
"""

from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.detection.contact_queries import pairs_of
from sandbox.physics.engine.space_arrays import Integers
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
    """A body's largest momentum at the kick's beginning, after located impacts [kg m/s]."""


def impacts(world: World) -> Impacts | None:
    """Return the impacts of the last step that a world observed; None if there were none."""
    contacts, scene = world.contacts, world.scene
    if not len(contacts.bodies):
        return None
    struck, impulse, turn = contacts.first, contacts.normal, np.zeros(len(contacts.bodies))
    solver = scene.sequence or scene.direct
    if solver:
        found = solver.last
        struck = struck | found.struck[contacts.bodies].any(axis=1)
        impulse = impulse + found.impulse[contacts.bodies].min(axis=1)
    if scene.direct and (given := scene.direct.drifts.landings.pair_impulse):
        pairs, turns = pairs_of(contacts), [*given]
        landed = np.array([given.get(pair, 0.0) for pair in pairs])
        turn = np.array([turns.index(pair) if pair in given else -1 for pair in pairs])
        struck = struck | (landed > 0)
        impulse = np.where(landed > 0, contacts.normal + landed, impulse)
    rows = np.flatnonzero(struck)
    if not len(rows):
        return None
    rows = rows[np.argsort(turn[rows], kind="stable")]
    step, bodies = world.last, contacts.bodies[rows]
    yields = scene.inverse_mass[bodies, 0]
    gives = np.hypot(*step.law_acceleration[:, :2].T)[bodies].sum(axis=1) * step.dt
    sudden = impulse[rows] * yields.sum(axis=1) > SUDDEN * gives
    rows, bodies, yields = rows[sudden], bodies[sudden], yields[sudden]
    if not len(rows):
        return None
    two = (contacts.touches[rows] == 2)[:, None]
    first, second = contacts.points[rows].swapaxes(0, 1)
    at = np.where(two, (first + second) / 2, first)
    momentum = float((scene.mass * np.hypot(*step.pre_kick_velocity[:, :2].T)).max(initial=0.0))
    lighter = bodies[np.arange(len(rows)), yields.argmax(axis=1)]
    return Impacts(bodies, at, impulse[rows], lighter, momentum)
