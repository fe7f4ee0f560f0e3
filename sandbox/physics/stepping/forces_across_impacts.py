"""Forces that depend on velocities, where impacts change velocities at once.

Leapfrog takes half of the forces of one kick before the middle of a drift, and half of those of the
next kick after it. If bodies collide at the first of these kicks, or land in the drift, their
velocities jump in between, and so do such forces. The mean along the path, by the trapezoidal rule
between the jumps, is then to replace the two halves. The difference is made up for in the next
kick: it sees several motions, each with a weight.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.impacts.impact_outcome import ImpactOutcome
from sandbox.physics.engine.space_arrays import Booleans
from sandbox.physics.state.motion import Reading

if TYPE_CHECKING:
    from sandbox.physics.contacts.direct.drifts.fallback_subdivision import DividedDrift


def weighted_motions(
    last: Reading,
    now: Reading,
    dt: float,
    struck: ImpactOutcome | None,
    landed: "DividedDrift | None",
) -> tuple[tuple[float, Reading], ...]:
    """Return the motions that the next kick is to see besides `now`, and their weights.

    The last kick saw the motion `last`, and the drift of dt [s] since then leads to `now`; `struck`
    are the impacts in that kick, and `landed` is the drift, if bodies landed in it. All motions are
    at the place and time of `now`. The weights add up to 0, so they cancel for whatever does not
    depend on velocities. A body without impacts has the velocity of `now` in all of them.
    """
    hit = np.zeros(len(now.state), dtype=bool) if landed is None else landed.reached
    given = last.state[:, 3:]
    begun = given if struck is None else np.where(struck.struck[:, None], struck.velocity, given)
    nodes = [(0.0, begun), *(_within(landed, dt) if landed else ()), (dt, now.state[:, 3:])]
    times = np.array([time for time, _ in nodes])
    weights = [*(np.convolve(np.diff(times), (0.5, 0.5)) / dt).tolist(), -0.5, -0.5]
    velocities = [*(velocity for _, velocity in nodes), given, now.state[:, 3:]]
    collided = hit if struck is None else hit | struck.struck
    reached = [collided, *(hit for _ in nodes[1:]), collided, hit]
    return tuple(
        (weight, _with_velocity(now, velocity, some))
        for weight, velocity, some in zip(weights, velocities, reached, strict=True)
    )


def _within(landed: "DividedDrift", dt: float) -> Sequence[tuple[float, Array]]:
    """Return the velocities at the kicks within a drift of dt [s], and the times since it began."""
    t, nodes = landed.first_fraction * dt / 2, []
    if landed.first_fraction < 1:
        nodes.append((t, landed.stages_before[-1].velocity))
    for _, _, stage in landed.kicks_between[:-1]:
        t += stage.duration
        nodes.append((t, stage.velocity))
    return nodes


def _with_velocity(now: Reading, velocity: Array, some: Booleans) -> Reading:
    """Return a motion with other velocities, (n, 3), of some bodies, (n,) [m/s, rad/s]."""
    state = now.state.copy()
    state[:, 3:] = np.where(some[:, None], velocity, state[:, 3:])
    return Reading(now.t, state)
