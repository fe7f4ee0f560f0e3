"""The parts of a kick with a landing in its middle.

The forces of a kick act equally before and after its step, and an impact acts at the step. Thus
energy books that are read in the middle of the drifts close. The impulses that were found for a
landing hold until the end of the drift. After the landing a body turns at another rate, so its
joints hold it with another force; and a body that it throws off is no longer pressed. These
differences are not part of the impact itself.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.kick_parts import Stage
from sandbox.physics.contacts.direct.kick_system import LIFTS, Kick
from sandbox.physics.contacts.direct.landing_impacts import Landed
from sandbox.physics.contacts.direct.linear_systems import solved
from sandbox.physics.engine.batch import Booleans, Contacts, Integers


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


def with_landing(
    parts: Sequence[Stage], kick: Kick, later: Array, landed: Landed, order: Integers
) -> tuple[Stage, ...]:
    """Return the parts of a kick with a landing in its middle.

    Parameters
    ----------
    parts
        Of the kick: at least one before the step, and one after it.
    kick, later
        The kick, and its impulses after the step, (r,).
    landed
        What comes down in the drift after it.
    order
        (n, 3), where the coordinates of each body are.
    """
    *before, rest = parts
    pulled = sum((part.pulls for part in parts), np.zeros_like(rest.pulls)) > 0
    begun = np.empty_like(landed.moved)
    begun[order] = before[-1].velocity
    impact = _Impact.of(kick, _thrown(kick, later, landed.moved), landed, pulled)
    if impact.work(begun) > 0:  # none gives energy: what parts there is pressed on afterwards, too
        impact = _Impact.of(kick, np.zeros_like(later), landed, pulled)
    struck = Stage.of(landed.kick, 0.0, (begun + impact.jump)[order], impact.strikes)
    struck = struck._replace(contacts=_added(struck.contacts, kick.pushing(impact.thrown)))
    gained = landed.impulse @ landed.kick.response
    rest = Stage.of(kick, rest.lasts, rest.velocity + gained[order], later - impact.thrown)
    holds = (landed.impulse - impact.strikes)[kick.layout.joints]
    return *before, struck, rest._replace(pulls=rest.pulls + holds)


class _Impact(NamedTuple):
    """The impact of a landing.

    Attributes
    ----------
    kick, landed
        The kick in whose middle it is, and what comes down.
    thrown
        (r,), the impulses of the kick that belong to it.
    strikes
        (r,), the impulses of the landing that do.
    """

    kick: Kick
    landed: Landed
    thrown: Array
    strikes: Array

    @classmethod
    def of(cls, kick: Kick, thrown: Array, landed: Landed, pulled: Booleans) -> "_Impact":
        """Return an impact in which these impulses of the kick are thrown off; see `_strikes`."""
        return cls(kick, landed, thrown, _strikes(landed, thrown @ kick.response, pulled))

    @property
    def jump(self) -> Array:
        """(3 N,), by how much it changes velocities [m/s, rad/s]."""
        thrown: Array = self.thrown @ self.kick.response
        return thrown + self.strikes @ self.landed.kick.response

    def work(self, begun: Array) -> float:
        """Return what it gives bodies of velocities (3 N,) [J]."""
        thrown: Array = self.thrown @ self.kick.here.jacobian
        given = thrown + self.strikes @ self.landed.kick.here.jacobian
        return float(given @ (begun + self.jump / 2))


def _thrown(kick: Kick, later: Array, moved: Array) -> Array:
    """Return the impulses after the step of those contacts whose bodies part in a landing: (r,).

    What parts no faster than the forces after the step make it does so by them, not by the landing.
    """
    layout, parts = kick.layout, np.zeros(len(later), dtype=bool)
    rates = kick.here.jacobian[layout.gaps] @ np.stack((moved, later @ kick.response), axis=1)
    leaves = rates[:, 0] > np.abs(rates[:, 1]) + LIFTS / kick.joints.drift
    parts[layout.gaps], parts[layout.slips] = leaves, leaves[layout.touching.rubs]
    return np.where(parts, later, 0.0)


def _strikes(landed: Landed, thrown: Array, pulled: Booleans) -> Array:
    """Return the impulses of a landing that leave the rates of joints as they are: (r,).

    Those at contacts are what they are, and so are those of ropes that it catches.

    Parameters
    ----------
    landed
        What comes down.
    thrown
        (3 N,), by how much else velocities change at the same time [m/s, rad/s].
    pulled
        (m,), which joints pulled before it.
    """
    kick, found = landed.kick, landed.impulse.copy()
    pulls = found[kick.layout.joints]
    rows = np.flatnonzero((pulls != 0) & (pulled | ~kick.joints.pulls_only))
    if len(rows):
        found[rows] = 0.0
        jacobian, response = kick.here.jacobian[rows], kick.response[rows]
        rates = jacobian @ (found @ kick.response + thrown)
        found[rows] = solved(jacobian @ response.T, -rates)[0]
    return found


def _added(contacts: Contacts, first: Contacts) -> Contacts:
    """Return contacts with more impulses at the first of them."""
    more = len(contacts.bodies) - len(first.bodies)
    return contacts._replace(
        normal=contacts.normal + np.pad(first.normal, (0, more)),
        friction=contacts.friction + np.pad(first.friction, (0, more)),
        impulse=contacts.impulse + np.pad(first.impulse, ((0, more), (0, 0))),
    )
