"""Crowds: bodies of which so many land in one drift that their landings are not located.

When a car drives into a pile, each landing moves all bodies in contact, which causes further
landings. To solve the whole pile again for each of them would take longer than many short steps,
and their order is a matter of rounding. So the kick before the drift is solved once more, with a
row for everything that would land: gaps may close within the drift, but no further (Stewart and
Trinkle 1996; Anitescu and Potra 1997). If some have landed in the drift before, what is left of it
is solved in this way. That is of first order in the time step. Such landings do not rebound, so
bodies with a large restitution are never treated in this way.
"""

from collections.abc import Callable, Sequence
from typing import TypeVar

import numpy as np

from sandbox.physics.contacts.direct.complementarity.islands import islands
from sandbox.physics.contacts.direct.drifts.first_contact_or_edge import FirstMeeting
from sandbox.physics.contacts.direct.drifts.landing_record import LandingImpact
from sandbox.physics.contacts.direct.drifts.subdrift_records import around, movable
from sandbox.physics.contacts.direct.kicks.kick_builder import KickBuilder
from sandbox.physics.contacts.direct.kicks.speculative_kicks import SolvedKick
from sandbox.physics.contacts.direct.prediction.speculative_contacts import (
    LOOKS,
    SpeculativeContacts,
)
from sandbox.physics.contacts.direct.rows.kick_system import Kick
from sandbox.physics.engine.space_arrays import Booleans
from sandbox.physics.state.simulation_errors import JointFailure, NoForces

MANY = 3
"""More landings of one island than this in a drift make a crowd."""

FORESEEN = 24
"""If there are more landings in one drift, located or still ahead, all bodies are a crowd. This is
more than the 16 that are ever located, since a few of those ahead may come to nothing. Without it,
a pile that is thrown at a floor would have 16 located in vain."""

Some = TypeVar("Some", bound=SolvedKick)


def crowd(
    kick: Kick,
    met: FirstMeeting,
    dull: Booleans,
    struck: Sequence[LandingImpact],
    *,
    begins: bool,
) -> Booleans:
    """Return which bodies are in a crowd, (n,), from what meets in a part of a drift.

    `struck` landed in the parts before it. `dull`, (n, n), tells which pairs rebound so little that
    they may be stopped. `begins` tells whether the part is the whole drift: linkages are only
    stopped in that.
    """
    can_move = movable(kick)
    crowded = np.zeros(len(can_move), dtype=bool)
    pairs = *(one.bodies for one in struck), *met.impact_pairs, *met.corner_pairs
    landings = [pair for pair in pairs if dull[pair]]
    if len(landings) <= MANY:
        return crowded
    groups = [np.flatnonzero(kick.acts[rows].any(axis=0)) for rows, _, _ in kick.layout.islands]
    whole = [*groups, *(np.array(pair) for pair in landings)]
    for numbers in islands(whole, can_move):
        if np.count_nonzero(numbers >= len(groups)) > MANY:
            for number in numbers.tolist():
                crowded[whole[number]] = True
    crowded &= can_move
    if not begins and _is_linkage(kick, crowded):
        crowded[:] = False
    return crowded


def _is_linkage(kick: Kick, crowded: Booleans) -> bool:
    """Return whether joints hold most bodies of a crowd, (n,).

    Stopped in what is left of a drift, a ragdoll on stairs left 7 % of its energy unexplained.
    """
    jointed = kick.acts[kick.layout.joints].any(axis=0)
    return bool(2 * np.count_nonzero(crowded & jointed) > np.count_nonzero(crowded))


def stopped(
    solved: Some,
    crowded: Booleans,
    speculative: SpeculativeContacts,
    build: KickBuilder,
    again: Callable[[Some, Kick], Some],
) -> tuple[Some, Booleans]:
    """Return a kick after which what would land in a crowd comes to touch, and goes no further.

    Also the crowd with the bodies that it pushes, (n,). `again` solves the kick with more rows.
    What it finds no impulses for is left to land.
    """
    for _ in range(LOOKS):
        ahead = speculative.ahead(solved.kick, solved.velocity, crowded)
        if not len(ahead.bodies):
            break
        try:
            solved = again(solved, build.with_ahead(solved.kick, ahead))
        except (JointFailure, NoForces):
            break
        crowded = crowded | around(solved.kick, ahead.bodies.tolist())
    return solved, crowded
