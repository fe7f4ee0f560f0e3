"""Keeps NumPy's linear algebra in one thread while a large island is solved.

From some 60 rows on OpenBLAS shares products and systems out to all cores. A step gains nothing by
that, and beside other processes its threads wait for each other: 150 rows took 14 ms instead of
0.6 on a busy machine. The commands of the project ask for one thread from the start; this is for
programs that import it.
"""

from contextlib import AbstractContextManager, nullcontext
from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from threadpoolctl import ThreadpoolController

LARGE = 50
"""Rows, below which OpenBLAS takes one thread by itself."""


def single_thread(rows: int) -> AbstractContextManager[object]:
    """Return what keeps systems of so many rows in one thread, as long as it lasts."""
    if rows < LARGE or (found := _threads()) is None:
        return nullcontext()
    return found.limit(limits=1, user_api="blas")


@cache
def _threads() -> "ThreadpoolController | None":
    """Find the libraries that share work out; None if there are none."""
    from threadpoolctl import ThreadpoolController  # takes its time, and few scenes need it

    import_module("scipy.linalg.lapack")  # brings a library of its own, for rows that repeat
    found = ThreadpoolController().select(user_api="blas")
    return found if any(one["num_threads"] > 1 for one in found.info()) else None
