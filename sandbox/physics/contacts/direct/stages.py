"""What a kick did, part by part."""

from typing import NamedTuple

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.kick import Kick
from sandbox.physics.contacts.direct.problem import Active
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
