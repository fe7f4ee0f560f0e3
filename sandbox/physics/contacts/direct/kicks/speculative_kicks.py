"""Kicks after which the gaps of slow corners close, and go no further."""

from collections.abc import Callable
from typing import Protocol, TypeVar

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.kicks.kick_builder import KickBuilder
from sandbox.physics.contacts.direct.prediction.speculative_contacts import (
    LOOKS,
    SpeculativeContacts,
)
from sandbox.physics.contacts.direct.rows.kick_system import Kick
from sandbox.physics.state.simulation_errors import JointFailure, NoForces


class SolvedKick(Protocol):
    """A solved kick: its rows, the velocities after it, and its forces; see `KickResult`."""

    @property
    def kick(self) -> Kick:
        """Its rows."""

    @property
    def velocity(self) -> Array:
        """(3 N,), the velocities after it [m/s, rad/s]."""

    @property
    def forces(self) -> Array:
        """(r,), its forces [N]."""


Some = TypeVar("Some", bound=SolvedKick)


def close_slow_corners(
    solved: Some,
    speculative: SpeculativeContacts,
    build: KickBuilder,
    laws: Array,
    again: Callable[[Some, Kick], Some],
    *,
    locates: bool = True,
) -> tuple[Some, bool]:
    """Return a kick after which slow corners have come down, and whether another one strikes.

    `solved` is the kick without these corners. `speculative` finds them, `build` builds the system
    with them, and `again` solves the kick with more rows. `laws`, (3 N,), are the accelerations by
    gravity and force laws [m/s², rad/s²]. `locates` tells whether corners that close faster than
    forces could cause are left to be located in the drift.
    """
    for _ in range(LOOKS):
        kick = solved.kick
        corners = speculative.corners(kick, solved.velocity)
        if not corners:
            break
        more = build.with_ahead(kick, speculative.contacts(corners, kick.pose, kick.joints.origin))
        if locates and more.strikes(solved.velocity, laws, solved.forces @ kick.response):
            return solved, True
        try:
            solved = again(solved, more)
        except (JointFailure, NoForces):
            break  # at the end of the drift it will be found as a contact
    return solved, False
