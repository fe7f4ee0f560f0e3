"""Landings: bodies that meet within a drift are stopped by an impact before it.

A meeting that is found only at the end of the drift has become an overlap by then, and to correct
that lifts the body. So once a kick is known, its drift is followed to the end. Bodies that would
overlap there may close their gap, but go no further. The impulses for that act on the velocities
after the kick, as in an impact without rebound. They take away the part of the approach that is too
much for the drift; the impact at the next step, where the bodies touch, takes the rest. Neither
gives energy, and no body is lifted.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.constraint_impulses import hold
from sandbox.physics.contacts.direct.constraint_rows import Active
from sandbox.physics.contacts.direct.convex_parts import Pair
from sandbox.physics.contacts.direct.kick_system import Kick
from sandbox.physics.contacts.direct.speculative_contacts import LOOKS, SpeculativeContacts
from sandbox.physics.engine.batch import Contacts
from sandbox.physics.state.errors import JointFailure, NoForces


class Landed(NamedTuple):
    """What came down; r rows, N bodies with the plane.

    Attributes
    ----------
    kick
        The rows, those of what comes down among them.
    impulse
        (r,), of this impact alone.
    moved
        (3 N,), the velocities after it [m/s, rad/s].
    """

    kick: Kick
    impulse: Array
    moved: Array


def land(
    speculative: SpeculativeContacts,
    kick: Kick,
    motion: Array,
    pairs: Sequence[Pair],
    near: Callable[[Array], Sequence[Pair]],
    meeting: Callable[[Kick, Contacts], Kick],
    *,
    driven: bool,
) -> Landed | None:
    """Stop the bodies that would meet within the drift after a kick; None if none would.

    Parameters
    ----------
    speculative
        Knows what meets.
    kick, motion
        The kick, and the velocities after it, (3 N,) [m/s, rad/s].
    pairs
        Those that do not touch and might meet within the drift.
    near
        Returns them for other velocities, (3 N,).
    meeting
        Returns a kick with rows for what meets within the drift.
    driven
        Whether surfaces that run, or kinematic bodies, may give energy.
    """
    found: Landed | None = None
    moved = motion
    for _ in range(LOOKS):
        ahead = speculative.look(kick, moved, pairs)
        if ahead is None:
            break
        kick = meeting(kick, ahead)
        try:
            found = _stopped(kick, motion, driven=driven)
        except (JointFailure, NoForces):
            break  # found where the drift ends it is in the way no longer
        moved = found.moved
        pairs = near(moved)
    return found


def _stopped(kick: Kick, motion: Array, *, driven: bool) -> Landed:
    """Return the impulses that stop the landing bodies; unconnected bodies are not affected."""
    comes = np.zeros(len(kick.response), dtype=bool)
    comes[kick.layout.gaps] = kick.ahead
    kick = replace(kick, layout=kick.layout.around(comes))
    impulse, moved, active = hold(kick, motion, _guess(kick), driven=driven)
    leaning = kick.leaning(moved, impulse)
    if leaning is not None:
        kick = leaning
        impulse, moved, _ = hold(kick, motion, (impulse, active), driven=driven)
    return Landed(kick, impulse, moved)


def _guess(kick: Kick) -> tuple[Array, Active]:
    """Return no impulses, and that joints hold and what comes down."""
    layout, on = kick.layout, np.zeros(len(kick.response), dtype=bool)
    on[layout.gaps] = kick.ahead
    for rows, _, problem in layout.islands:
        on[rows] |= problem.free
    return np.zeros(len(on)), Active(on, np.zeros(len(layout.touching.rubs), dtype=np.intp))
