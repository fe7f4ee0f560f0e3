"""Work that is spread over processes."""

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from multiprocessing import get_context
from typing import TypeVar

from sandbox import interrupts

Item = TypeVar("Item")
Result = TypeVar("Result")


def spread(
    work: Callable[[Item], Result], items: Sequence[Item], jobs: int
) -> Iterator[tuple[int, Result]]:
    """Yield the number of each item and what came of it, as they come in.

    Parameters
    ----------
    work
        What is done with an item: a function of a module, where the other processes find it.
    items
        They are begun in this order.
    jobs
        How many processes share them at the most.
    """
    jobs = max(min(jobs, len(items)), 1)
    pool = ProcessPoolExecutor(jobs, get_context("spawn"), interrupts.install)
    try:
        numbers = {pool.submit(work, item): number for number, item in enumerate(items)}
        for done in as_completed(numbers):
            yield numbers[done], done.result()
    finally:
        pool.shutdown(cancel_futures=True)
