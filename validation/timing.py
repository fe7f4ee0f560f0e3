"""What a step costs."""

from time import perf_counter

from sandbox.model.expressions import Values
from sandbox.model.level import Level, Stepping
from sandbox.physics.trace import count_steps
from sandbox.physics.world import build

STEPS = 120
REPEATS = 5


def step_seconds(level: Level, values: Values, stepping: Stepping) -> float:
    """Return the least time that a step took [s], in fresh worlds over the level's duration."""
    best = float("inf")
    for _ in range(REPEATS):
        world = build(level, values, stepping)
        steps = min(count_steps(world), STEPS)
        start = perf_counter()
        for _ in range(steps):
            world.step()
        best = min(best, (perf_counter() - start) / steps)
    return best
