"""The work of a step, counted and not timed: the same on every machine, however busy.

What a search finds depends on what runs cost. If that were timed, the same request could have
different answers.
"""

import sys
from concurrent.futures import ThreadPoolExecutor
from types import FrameType

from sandbox.model.expressions import Values
from sandbox.model.level import Level, Stepping
from sandbox.physics.measuring.recording import count_steps
from sandbox.physics.state.errors import SimulationError
from sandbox.physics.stepping.make_world import make_world
from sandbox.physics.stepping.world import World

STEPS = 20
"""How many steps are counted, after as many that are not."""

CALL = 0.3e-6
"""s, about, per Python call within a step; measured: 0.2 to 0.9 µs."""

BODY = 0.1e-6
"""s, about, per body and pymunk step."""

TOUCH = 0.05e-6
"""s, about, per contact and iteration of pymunk's solver."""

LOOK = 40e-6
"""s, about, per observation of a run."""


def step_work(level: Level, values: Values, stepping: Stepping) -> float:
    """Return the counted work of a step [s]; 0 if there is none.

    Parameters
    ----------
    level, values, stepping
        The run, of which the beginning is counted.
    """
    rate = max(stepping.rate, level.stepping.rate)  # at a lower one it may not run
    try:
        world = make_world(level, values, stepping.model_copy(update={"rate": rate}))
        before = min(STEPS, count_steps(world) // 2)
        if before:
            world.advance(before)
        with ThreadPoolExecutor(1) as thread:  # of its own: one that is profiled stays so
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
    """Return how many calls some steps make in Python."""
    count = 0

    def note(_frame: FrameType, event: str, _arg: object) -> None:
        nonlocal count
        count += event in ("call", "c_call")

    sys.setprofile(note)
    try:
        for _ in range(steps):
            world.step()
    finally:
        sys.setprofile(None)
    return count
