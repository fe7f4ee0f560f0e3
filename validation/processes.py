"""Work that is spread over processes, of which none outlives the one that has started it."""

import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from multiprocessing import get_context
from multiprocessing.connection import Connection
from threading import Thread
from typing import TypeVar

from sandbox import interrupts

Item = TypeVar("Item")
Result = TypeVar("Result")


def spread(
    work: Callable[[Item], Result], items: Sequence[Item], jobs: int
) -> Iterator[tuple[int, Result]]:
    """Yield the number of each item and what came of it, as they come in.

    However it ends, none of the processes goes on: each waits for the end of a pipe, which comes
    when this one lets go of it, or is no more.

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
    context = get_context("spawn")
    ending, life = context.Pipe(duplex=False)
    pool = ProcessPoolExecutor(jobs, context, _begin, (ending,))
    try:
        numbers = {pool.submit(work, item): number for number, item in enumerate(items)}
        for done in as_completed(numbers):
            yield numbers[done], done.result()
    except BaseException:
        life.close()  # nobody waits for what they are at
        raise
    finally:
        pool.shutdown(cancel_futures=True)
        life.close()
        ending.close()


def _begin(ending: Connection) -> None:
    """Prepare another process."""
    interrupts.install()
    Thread(target=_end_with, args=(ending,), daemon=True).start()


def _end_with(ending: Connection) -> None:
    try:
        ending.recv()  # nothing is ever sent
    except (EOFError, OSError):
        os._exit(1)
