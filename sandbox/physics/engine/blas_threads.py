"""Keeps NumPy's linear algebra in one thread while the Python in a step runs.

OpenBLAS shares large products and systems out to all cores. The bits of a run would then depend on
their number. A step gains nothing by it, and beside other processes the threads wait for each
other: 150 rows took 14 ms instead of 0.6 on a busy machine. The commands of the project ask for one
thread from the start; this is for programs that import it.
"""

import os
from collections.abc import Callable
from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING

from sandbox.physics.state.kick_context import Kick, Work

if TYPE_CHECKING:
    from threadpoolctl import ThreadpoolController

Call = Callable[[Work, Kick], None]

MANY = 8
"""Bodies, below which all systems are so small that OpenBLAS takes one thread by itself."""


def in_one_thread(call: Call, bodies: int) -> Call:
    """Return a call that does the same, in one thread if a scene has many bodies."""
    if bodies < MANY or (found := _threads()) is None:
        return call

    def alone(work: Work, kick: Kick) -> None:
        with found.limit(limits=1, user_api="blas"):
            call(work, kick)

    return alone


@cache
def _threads() -> "ThreadpoolController | None":
    """Find the libraries that share work out; None if there are none."""
    if os.environ.get("OPENBLAS_NUM_THREADS") == "1":
        return None
    from threadpoolctl import ThreadpoolController  # takes its time, and few programs need it

    import_module("scipy.linalg.lapack")  # brings a library of its own, for rows that repeat
    found = ThreadpoolController().select(user_api="blas")
    return found if any(one["num_threads"] > 1 for one in found.info()) else None
