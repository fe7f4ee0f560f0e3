"""Running the whole sweep: errors on all cores, costs one after the other."""

import os
from collections.abc import Iterator, Sequence
from functools import partial

from sandbox.processes import spread
from validation.cost.sweep import Budget, Sweep, errors, timed


def sweeps(names: Sequence[str], budget: Budget) -> Iterator[Sweep]:
    """Yield the sweep of each level, in their order.

    The errors come first, all of them, for timing a run beside others would time those as well.
    """
    found = dict(spread(partial(errors, budget=budget), names, os.cpu_count() or 1))
    for number in range(len(names)):
        yield timed(found[number])
