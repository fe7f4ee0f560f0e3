"""The cost of a step is counted, and nothing else is counted with it."""

import gc
from collections.abc import Mapping

from sandbox.model.level import Stepping
from sandbox.physics.accuracy.counted_step_cost import counted_cost
from tests.physics.scenes import incline


def test_what_the_garbage_collector_calls_meanwhile_is_not_counted() -> None:
    """Objects of others may end in these steps; a request then got one of two answers."""
    level = incline(0.3)
    alone = counted_cost(level, {}, Stepping(rate=60))
    before = gc.get_threshold()

    def collected(_phase: str, _info: Mapping[str, object]) -> None:
        for _ in range(100):
            len(())

    gc.callbacks.append(collected)
    gc.set_threshold(1)
    try:
        beside = counted_cost(level, {}, Stepping(rate=60))
    finally:
        gc.set_threshold(*before)
        gc.callbacks.remove(collected)

    assert beside == alone
