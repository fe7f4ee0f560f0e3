"""Work spread over processes, none of which outlives the one that started it."""

import gc
import os
import signal
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from itertools import islice
from multiprocessing import get_all_start_methods, get_context
from multiprocessing.connection import Connection
from multiprocessing.forkserver import ensure_running, set_forkserver_preload
from threading import Thread
from typing import TypeVar

from sandbox import interrupts
from sandbox.model.errors import SandboxError
from sandbox.model.message import Message

Item = TypeVar("Item")
Result = TypeVar("Result")

AHEAD = 2
"""How many items each process has at a time: the current one, and the next."""

METHOD = "forkserver" if "forkserver" in get_all_start_methods() else "spawn"
"""How processes start: as copies of a server that has only loaded modules, which is fast. On
Windows each starts from nothing."""


def prepare(*modules: str) -> None:
    """Load modules for all processes to come, in their server, while this process goes on.

    What a server has not loaded, because it was there already or is not had at all, each process
    loads itself.
    """
    if METHOD != "forkserver":
        return
    set_forkserver_preload(list(modules))
    # Ctrl-C is for this process alone: the others end with it, and have nothing to say
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        ensure_running()
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def spread(
    work: Callable[[Item], Result], items: Iterable[Item], jobs: int
) -> Iterator[tuple[int, Result]]:
    """Yield the number of each item and what came of it, as they come in.

    However it ends, none of the processes goes on: each waits for the end of a pipe, which comes
    when this one lets go of it, or is no more.

    Parameters
    ----------
    work
        What is done with an item: a function of a module, where the other processes find it.
    items
        They are begun in this order, and asked for only when a process is about to need them.
    jobs
        How many processes share them at the most; each is started when there is work for it.

    Raises
    ------
    SandboxError
        If one of the processes is ended from outside.
    """
    prepare()
    context = get_context(METHOD)
    ending, life = context.Pipe(duplex=False)
    pool = ProcessPoolExecutor(max(jobs, 1), context, _begin, (ending,))
    coming = enumerate(items)
    numbers: dict[Future[Result], int] = {}
    try:
        while True:
            for number, item in islice(coming, AHEAD * max(jobs, 1) - len(numbers)):
                numbers[pool.submit(work, item)] = number
            if not numbers:
                break
            for done in wait(numbers, return_when=FIRST_COMPLETED).done:
                yield numbers.pop(done), done.result()
    except BaseException as error:
        life.close()  # nobody waits for what they are at
        if isinstance(error, BrokenProcessPool):
            raise SandboxError(
                Message(
                    "one of the processes that worked on it was ended from outside, perhaps for"
                    " want of memory"
                )
            ) from error
        raise
    finally:
        pool.shutdown(cancel_futures=True)
        life.close()
        ending.close()


def _begin(ending: Connection) -> None:
    """Prepare another process."""
    gc.freeze()  # what it was copied with is never garbage
    interrupts.install()
    Thread(target=_end_with, args=(ending,), daemon=True).start()


def _end_with(ending: Connection) -> None:
    try:
        ending.recv()  # nothing is ever sent
    except (EOFError, OSError):
        os._exit(1)
