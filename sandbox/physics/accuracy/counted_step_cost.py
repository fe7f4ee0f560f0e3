"""The cost of a step, counted instead of timed: the same on every machine under any load.

The search for an accuracy depends on the cost of runs. If that were timed, the same request could
have different results.
"""

import sys
from concurrent.futures import ThreadPoolExecutor
from types import FrameType

from sandbox.garbage_collection_pause import uncollected
from sandbox.model.expressions import Values
from sandbox.model.level import Level, Stepping
from sandbox.physics.measuring.recording import count_steps
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.stepping.make_world import make_world
from sandbox.physics.stepping.world import World

STEPS = 20
"""The number of steps counted, after as many uncounted ones."""

CALL = 0.3e-6
"""The time per Python call within a step, about [s]; measured: 0.2 to 0.9 µs."""

BODY = 0.1e-6
"""The time per body and pymunk step, about [s]."""

TOUCH = 0.05e-6
"""The time per contact and iteration of pymunk's solver, about [s]."""

LOOK = 40e-6
"""The time per observation of a run, about [s]."""


def counted_cost(level: Level, values: Values, stepping: Stepping) -> float:
    """Return the counted cost of a step [s], from the first ones; `CALL` if they fail."""
    rate = max(stepping.rate, level.stepping.rate)  # it may not run at a lower one
    try:
        world = make_world(level, values, stepping.model_copy(update={"rate": rate}))
        before = min(STEPS, count_steps(world) // 2)
        if before:
            world.advance(before)
        with ThreadPoolExecutor(1) as thread:  # a profiler of this thread stays in place
            calls = thread.submit(_calls, world, STEPS).result() / STEPS
        world.advance()
        touches = len(world.contacts.bodies)
    except SimulationError:
        return CALL
    own = len(world.kicks.parts) * (
        BODY * len(level.bodies) + TOUCH * touches * stepping.iterations
    )
    return CALL * (1 + calls) + own


def _calls(world: World, steps: int) -> int:
    """Return the number of Python calls in some steps.

    The garbage collector pauses: what it would call at the end of other objects is no part of them.
    """
    count = 0

    def note(_frame: FrameType, event: str, _arg: object) -> None:
        nonlocal count
        count += event in ("call", "c_call")

    with uncollected():
        sys.setprofile(note)
        try:
            for _ in range(steps):
                world.step()
        finally:
            sys.setprofile(None)
    return count
