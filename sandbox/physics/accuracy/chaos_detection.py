"""Whether a motion is chaotic, and how far ahead it can be predicted.

Both are measured: by the growth of a tiny disturbance, and by the time at which two runs separate.
"""

from collections.abc import Sequence
from math import log

import numpy as np

from sandbox.model.translatable_message import NOTHING, Message
from sandbox.physics.accuracy.compared_runs import BLOCK, Stop, Watched, departure
from sandbox.physics.accuracy.event_timing_errors import time_without_late_impact
from sandbox.physics.accuracy.exceptions import Cancelled
from sandbox.physics.accuracy.step_refinement import Refinement
from sandbox.physics.measuring.recording import Trace
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.stepping.make_world import make_world

NUDGE = 1e-9
"""The initial displacement of one body [m]."""

CHAOTIC = 1e4
"""The growth of a disturbance from which it is examined for chaos."""

STEADY = 0.75
"""The largest share of the lost digits that may be lost in one half of the time, if growth is
exponential. A first contact loses more of them at once; linear growth loses hardly any in the
second half."""


def chaotic(run: Trace, stop: Stop) -> Message:
    """Describe how a small change grows, if it grows repeatedly; return an empty message if not.

    The run has recorded the motion. It is taken once more with a body displaced, until that change
    has grown far enough. Raises `Cancelled` if `stop` returned true.
    """
    times = _growth(run, stop)
    at = len(times) - 1
    if at < 0 or not times[at] >= CHAOTIC:
        return NOTHING
    if log(max(1.0, *times[: at // 2 + 1])) > STEADY * log(times[at]):
        return NOTHING
    t = float(run.t[1 + at])
    return Message("a small change grows {times:.0e} times in {t:.3g} s", times=times[at], t=t)


def _growth(run: Trace, stop: Stop) -> list[float]:
    """Return the growth factor of a small displacement at each time of a run but the first.

    They end where it has grown far enough to be examined, or where the other run has to stop.
    """
    grown: list[float] = []
    positions = [
        ((row, axis), column)
        for row, name in enumerate(run.level.bodies)
        for axis, letter in enumerate("xy")
        if (column := run.columns.get(f"{name}.position.{letter}")) is not None
    ]
    name = next((n for n, body in run.level.bodies.items() if body.type == "dynamic"), None)
    if name is None or not positions:
        return grown
    rows, axes = np.transpose([position for position, _ in positions])
    recorded = np.array([column for _, column in positions]).T
    try:
        other = make_world(run.level, run.values, run.stepping)
        x, y = other.snapshot.position[list(run.level.bodies).index(name)]
        other.place({name: (float(x) + NUDGE, float(y) + NUDGE)})
        for look, steps in enumerate(np.rint(np.diff(run.t) * run.stepping.rate)):
            if look % BLOCK == 0 and stop():
                raise Cancelled
            now = other.advance(int(steps)).position[rows, axes]
            grown.append(float(np.abs(now - recorded[1 + look]).max()) / NUDGE)
            if grown[-1] >= CHAOTIC:
                break
    except SimulationError:
        return []
    return grown


def prediction_horizon(
    refinements: Sequence[Refinement], items: Sequence[Watched], error: float
) -> float:
    """Return until when the two finest runs of the best refinement agree on positions [s].

    They agree to within an error, and no impact before that time is found late enough to cause a
    larger one.
    """
    coarse, fine = refinements[0].traces[-2:]
    times = (departure(coarse, fine, item, error) for item in items)
    return min([time_without_late_impact(fine, items, error), *(t for t in times if t is not None)])
