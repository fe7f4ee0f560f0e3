"""Whether a motion is chaotic: how a change too small to be seen grows until the end of a run."""

import numpy as np

from sandbox.model.expressions import Array, Values
from sandbox.model.level import Level, Stepping
from sandbox.physics.accuracy.errors import Cancelled
from sandbox.physics.accuracy.runs import BLOCK, Stop
from sandbox.physics.measuring.recording import count_steps
from sandbox.physics.state.errors import SimulationError
from sandbox.physics.stepping.making import make_world
from sandbox.physics.stepping.world import World

NUDGE = 1e-9
"""m, by which one body is moved at the start."""

WILD = 1e4
"""By how much a change grows, at the least, in a chaotic motion; that of an orbit grows with the
number of its turns, some tenfold each."""


def growth(level: Level, values: Values, stepping: Stepping, stop: Stop) -> float:
    """Return how many times as large a small change of a place is at the end.

    Parameters
    ----------
    level, values, stepping
        The run, which is taken twice.
    stop
        Is asked now and then whether to give up.

    Raises
    ------
    Cancelled
        If `stop` said so.
    """
    name = next((n for n, body in level.bodies.items() if body.type == "dynamic"), None)
    if name is None:
        return 0.0
    try:
        first, other = make_world(level, values, stepping), make_world(level, values, stepping)
        x, y = other.snapshot.position[list(level.bodies).index(name)]
        other.place({name: (float(x) + NUDGE, float(y) + NUDGE)})
        ends = [_end(world, stop) for world in (first, other)]
    except SimulationError:
        return 0.0
    return float(np.abs(ends[0] - ends[1]).max()) / NUDGE


def _end(world: World, stop: Stop) -> Array:
    """Return where the bodies are when the run is over: (n, 2) [m]."""
    left = count_steps(world)
    while left:
        if stop():
            raise Cancelled
        steps = min(left, BLOCK)
        world.advance(steps)
        left -= steps
    return world.snapshot.position
