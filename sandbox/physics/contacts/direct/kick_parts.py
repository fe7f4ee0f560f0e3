"""The parts of a kick, and what each did."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.constraint_rows import Active
from sandbox.physics.contacts.direct.kick_system import Kick
from sandbox.physics.contacts.sequential_impacts import Impacts
from sandbox.physics.engine.batch import Contacts


class Stage(NamedTuple):
    """A part of a kick with impacts: before them, the impacts, or after them.

    Attributes
    ----------
    lasts
        How long it is; 0 of the impacts [s].
    velocity
        (n, 3), the velocities that it ends with [m/s, rad/s].
    pulls
        (m,), the impulses along what joints keep; positive where they pull.
    contacts
        With the impulses in it.
    """

    lasts: float
    velocity: Array
    pulls: Array
    contacts: Contacts

    @classmethod
    def of(cls, kick: Kick, lasts: float, ended: Array, impulse: Array) -> "Stage":
        """Return what impulses, (r,), did in a part of a kick; for the others see above."""
        return cls(lasts, ended, impulse[kick.layout.joints], kick.pushing(impulse))

    def normal(self, count: int) -> Array:
        """Return what pushed each of so many bodies, whichever way: (n,) [N s]."""
        both = self.contacts.bodies.T.ravel()
        pushed = np.bincount(both, np.tile(self.contacts.normal, 2), count)
        return np.asarray(pushed, dtype=float)


class Taken(NamedTuple):
    """A kick that was taken; r rows, N bodies with the plane.

    Attributes
    ----------
    kick
        Which.
    moved
        (3 N,), the velocities after it [m/s, rad/s].
    forces
        (r,), since its impacts, if it had any [N].
    active
        Which rows hold since.
    total
        (r,), the impulses of the whole kick.
    impacts
        What impacts did in it.
    stages
        Its parts, if there were impacts; else none.
    """

    kick: Kick
    moved: Array
    forces: Array
    active: Active
    total: Array
    impacts: Impacts
    stages: tuple[Stage, ...] = ()


def halves(kick: Kick, total: Array, begun: Array, after: Array) -> tuple[Stage, ...]:
    """Return a kick without impacts as two alike.

    Parameters
    ----------
    total
        (r,), its impulses.
    begun, after
        (n, 3), the velocities before it and after it [m/s, rad/s].
    """
    first = Stage.of(kick, kick.joints.kick / 2, (begun + after) / 2, total / 2)
    return first, first._replace(velocity=after)


def with_landing(parts: Sequence[Stage], landing: Stage, jump: Array) -> tuple[Stage, ...]:
    """Return the parts of a kick with a landing in its middle.

    The forces of a kick act equally before and after its step, and an impact acts at the step. Thus
    energy books that are read in the middle of the drifts close.

    Parameters
    ----------
    parts
        Of the kick: at least one before the step, and one after it.
    landing
        What comes down.
    jump
        (n, 3), by how much it changes velocities [m/s, rad/s].
    """
    *before, rest = parts
    impact = landing._replace(velocity=before[-1].velocity + jump)
    return *before, impact, rest._replace(velocity=rest.velocity + jump)
