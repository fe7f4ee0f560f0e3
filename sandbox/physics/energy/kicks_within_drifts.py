"""The kicks within a drift that was divided into parts, for the ledger."""

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.impacts.contact_work import KickRecord
from sandbox.physics.energy.energy_and_momentum import velocity_of
from sandbox.physics.engine.space_arrays import Contacts
from sandbox.physics.state.motion import Instant

if TYPE_CHECKING:
    from sandbox.physics.contacts.direct.drifts.fallback_subdivision import DividedDrift


class InnerKick(NamedTuple):
    """A kick within a drift; n bodies, m equations of joints."""

    kick: KickRecord
    """The kick, for the books."""
    change: Array
    """(n, 3), the change of the velocities [m/s, rad/s]."""
    impulses: Array
    """(m,), the impulses of the joints; positive where they pull."""
    jacobian: Array
    """(m, n, 3), the derivatives of the joints' equations by positions and angles."""
    contacts: Contacts
    """The contacts, with their impulses."""


def kicks_within(
    divided: "DividedDrift", start: Instant, last: KickRecord, inertia: Callable[[float], Array]
) -> Iterator[InnerKick]:
    """Yield the kicks between the parts of a drift; there is at least one.

    The last one takes back the excess of the next whole kick.

    In a divided drift, laws act as they did in the kick before it, and only on the bodies that move
    in parts. The kick after it is booked as a whole one, although it begins in the middle of a
    part; the excess is taken back before it.

    `start` is the motion in the middle of the first part, and `last` is the kick before it.
    `inertia` returns masses, masses and moments at a time [s]: (n, 3) [kg, kg m²].
    """
    t, velocity_before = float(start.t), np.column_stack((start.velocity, start.angular_velocity))

    def kick(t: float, duration: float, pose: Array, velocity_after: Array) -> KickRecord:
        kicked = np.where(divided.reached[:, None], inertia(t), 0.0)
        part = last.part(duration, (velocity_before + velocity_after) / 2, first=False)
        return part._replace(t=t, positions=pose[:, :2], inertia=kicked)

    for pose, jacobian, (
        duration,
        velocity_after,
        joint_impulses,
        contacts,
    ) in divided.kicks_between:
        record = kick(t + duration / 2, duration, pose, velocity_after)
        yield InnerKick(
            record, velocity_after - velocity_before, joint_impulses, jacobian, contacts
        )
        t, velocity_before = t + duration, velocity_after


def before_landings(foreseen: Instant, divided: "DividedDrift", t: float, dt: float) -> Instant:
    """Return the motion in the middle of the first part of a drift whose joints changed at first.

    `foreseen` is the motion that was expected in the drift; it began at `t` and lasts `dt` [s].
    """
    velocity, half = divided.stages_before[-1].velocity, divided.first_fraction * dt / 2
    pose = np.column_stack((foreseen.position, foreseen.angle))
    pose += (t - float(foreseen.t)) * velocity_of(foreseen)
    return Instant.at(t + half, pose + half * velocity, velocity)
