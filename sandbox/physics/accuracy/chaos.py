"""Whether a motion is chaotic, and how far ahead it can be predicted.

Both are measured: by the growth of a tiny disturbance, and by the time at which two runs separate.
"""

from collections.abc import Sequence
from math import log

import numpy as np

from sandbox.model.expressions import Array, Values
from sandbox.model.level import Level, Stepping
from sandbox.model.message import NOTHING, Message
from sandbox.physics.accuracy.compared_runs import BLOCK, Stop, Watched, departure
from sandbox.physics.accuracy.event_timing_errors import timely
from sandbox.physics.accuracy.exceptions import Cancelled
from sandbox.physics.accuracy.refinement import Refinement
from sandbox.physics.measuring.recording import count_steps
from sandbox.physics.state.errors import SimulationError
from sandbox.physics.stepping.make_world import make_world
from sandbox.physics.stepping.world import World

NUDGE = 1e-9
"""The initial displacement of one body [m]."""

CHAOTIC = 1e4
"""The growth of a disturbance from which it is examined for chaos."""

STEADY = 0.75
"""The largest share of the lost digits that may be lost in one half of the time, if growth is
exponential. A first contact loses more of them at once; linear growth loses hardly any in the
second half."""


def chaotic(level: Level, values: Values, stepping: Stepping, stop: Stop) -> Message:
    """Describe how a small change grows, if it grows repeatedly; return an empty message if not.

    The run is taken twice. Raises `Cancelled` if `stop` returned true.
    """
    t, times = _growth(level, values, stepping, stop)
    chaotic = np.flatnonzero(times >= CHAOTIC)
    if not len(chaotic):
        return NOTHING
    at = int(chaotic[0])
    half = float(times[: at // 2 + 1].max())
    if log(max(half, 1.0)) > STEADY * log(times[at]):
        return NOTHING
    return Message("a small change grows {times:.0e} times in {t:.3g} s", times=times[at], t=t[at])


def _growth(level: Level, values: Values, stepping: Stepping, stop: Stop) -> tuple[Array, Array]:
    """Return times [s], and the growth factor of a small displacement until then: (T,) each."""
    name = next((n for n, body in level.bodies.items() if body.type == "dynamic"), None)
    nothing = np.zeros(0), np.zeros(0)
    if name is None:
        return nothing
    try:
        first, other = make_world(level, values, stepping), make_world(level, values, stepping)
        x, y = other.snapshot.position[list(level.bodies).index(name)]
        other.place({name: (float(x) + NUDGE, float(y) + NUDGE)})
        return _parting(first, other, stop)
    except SimulationError:
        return nothing


def _parting(first: World, other: World, stop: Stop) -> tuple[Array, Array]:
    """Return times [s], and the distance of two worlds relative to the initial one: (T,) each."""
    left, t, apart = count_steps(first), [], []
    block = max(min(BLOCK, left // BLOCK), 1)
    while left:
        if stop():
            raise Cancelled
        steps = min(left, block)
        now = [world.advance(steps).position for world in (first, other)]
        t.append(first.t)
        apart.append(float(np.abs(now[0] - now[1]).max()) / NUDGE)
        left -= steps
    return np.array(t), np.array(apart)


def foretold(refinements: Sequence[Refinement], wanted: Sequence[Watched], error: float) -> float:
    """Return until when the two finest runs of the best refinement agree on positions [s].

    They agree to within an error, and no impact before that time is found late enough to cause a
    larger one.
    """
    coarse, fine = refinements[0].traces[-2:]
    times = (departure(coarse, fine, item, error) for item in wanted)
    return min([timely(fine, wanted, error), *(t for t in times if t is not None)])
