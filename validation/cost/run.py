"""The whole sweep: errors in as many processes as there are cores, prices one after the other."""

import os
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from multiprocessing import get_context

from validation.cost.sweep import Budget, Sweep, errors, timed


def sweeps(names: Sequence[str], budget: Budget) -> Iterator[Sweep]:
    """Yield the sweep of each level, in their order.

    The errors come first, all of them, for timing a run beside others would time those as well.
    """
    context = get_context("spawn")
    with ProcessPoolExecutor(min(os.cpu_count() or 1, len(names)), context) as pool:
        found = list(pool.map(partial(errors, budget=budget), names))
    yield from map(timed, found)
