"""The kicks within a drift that was taken in parts, as the ledger books them."""

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.contact_work import Kick
from sandbox.physics.engine.batch import Contacts
from sandbox.physics.state.motion import Instant, Motion

if TYPE_CHECKING:
    from sandbox.physics.contacts.direct.drift_subdivision import Divided


class Within(NamedTuple):
    """A kick within a drift; n bodies, m equations of joints.

    Attributes
    ----------
    kick
        Which.
    change
        (n, 3), by how much it changes velocities [m/s, rad/s].
    impulses
        (m,), along what joints keep; positive where they pull.
    jacobian
        (m, n, 3), how that changes with the bodies' places and angles.
    contacts
        With their impulses.
    """

    kick: Kick
    change: Array
    impulses: Array
    jacobian: Array
    contacts: Contacts


def kicks_within(
    divided: "Divided", begin: Instant, seen: Motion, inertia: Callable[[float], Array]
) -> Iterator[Within]:
    """Yield the kicks between the parts of a drift, of which there is at least one.

    The last to be yielded takes back what the next whole kick gives too much.

    Laws act in a divided drift as they did in the kick before it, on what goes in parts: nothing
    else is kicked in it. The kick after it is a whole one, though it begins in the middle of a
    part: that much is taken back before it.

    Parameters
    ----------
    divided
        The drift.
    begin
        The motion in the middle of its first part.
    seen
        What the laws saw in the kick before it.
    inertia
        Returns masses, masses and moments at a time [s]: (n, 3) [kg, kg m²].
    """
    t, begun = float(begin.t), np.column_stack((begin.velocity, begin.angular_velocity))

    def kick(t: float, lasts: float, place: Array, ended: Array) -> Kick:
        kicked = np.where(divided.reached[:, None], inertia(t), 0.0)
        return Kick(t, lasts, seen, place[:, :2], (begun + ended) / 2, kicked)

    for place, jacobian, (lasts, ended, pulls, contacts) in divided.between:
        now = kick(t + lasts / 2, lasts, place, ended)
        yield Within(now, ended - begun, pulls, jacobian, contacts)
        t, begun = t + lasts, ended
