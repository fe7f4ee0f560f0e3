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
from sandbox.physics.engine.space_arrays import Booleans
from sandbox.physics.state.motion import Reading

if TYPE_CHECKING:
    from sandbox.physics.contacts.direct.drifts.fallback_subdivision import DividedDrift
    from sandbox.physics.contacts.impacts.impact_outcome import ImpactOutcome


def weighted_motions(
    last: Reading,
    now: Reading,
    dt: float,
    struck: "ImpactOutcome | None",
    landed: "DividedDrift | None",
) -> tuple[tuple[float, Reading], ...]:
    """Return the motions that the next kick is to see besides `now`, and their weights.

    The last kick saw the motion `last`, and the drift of dt [s] since then leads to `now`; `struck`
    are the impacts in that kick, and `landed` is the drift, if bodies landed in it. All motions are
    at the place and time of `now`. The weights add up to 0, so they cancel for whatever does not
    depend on velocities. A body without impacts has the velocity of `now` in all of them.
    """
    given, coming = last.state[:, 3:], now.state[:, 3:]
    begun, hit = given, np.zeros(len(now.state), dtype=bool)
    motions: list[tuple[float, tuple[Array, Booleans]]] = []
    if struck is not None:
        begun = np.where(struck.struck[:, None], struck.velocity, given)
    if landed is not None:
        hit = landed.reached
        nodes = [(0.0, begun), *_within(landed, dt), (dt, coming)]
        times = np.array([time for time, _ in nodes])
        weights = (np.convolve(np.diff(times), (0.5, 0.5)) / dt).tolist()
        motions += [(weight, (at[1], hit)) for weight, at in zip(weights, nodes, strict=True)]
        motions += [(-0.5, (given, hit)), (-0.5, (coming, hit))]
    if struck is not None and (only := struck.struck & ~hit).any():
        motions += [(0.5, (begun, only)), (-0.5, (given, only))]
    return tuple((weight, _with_velocity(now, *seen)) for weight, seen in motions)


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
