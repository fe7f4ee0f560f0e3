"""Work spread over processes, none of which outlives the one that started it."""

import gc
import os
import signal
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from itertools import islice
from multiprocessing import get_all_start_methods, get_context, resource_tracker
from multiprocessing.connection import Connection
from multiprocessing.forkserver import ensure_running, set_forkserver_preload
from threading import Thread
from typing import TypeVar

from sandbox import interrupts
from sandbox.model.errors import SandboxError
from sandbox.model.translatable_message import Message

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
    with starting():
        ensure_running()


@contextmanager
def starting() -> Iterator[None]:
    """Start processes within this that hear no Ctrl-C, no request to end and no closed terminal.

    They are for this process alone: they end with it, and have nothing to say. A signal that comes
    meanwhile takes effect afterwards, since nobody would wait for a process that has half started.
    """
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, interrupts.SIGNALS)
    try:
        resource_tracker.ensure_running()  # it lets some signals through again when it starts
        signal.pthread_sigmask(signal.SIG_BLOCK, interrupts.SIGNALS)
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


_ENDED = Message(
    "one of the processes that worked on it was ended from outside, perhaps for want of memory"
)


def spread(
    work: Callable[[Item], Result], items: Iterable[Item], jobs: int | None = None
) -> Iterator[tuple[int, Result]]:
    """Yield the number and the result of each item, in the order in which they are done.

    There are as many processes as cores unless `jobs` gives their number. None outlives this one,
    however it ends: each waits for the end of a pipe, which comes when this process closes the pipe
    or dies. The work is a function of a module, so that other processes can import it. Items are
    taken in order, and only when a process is about to need them. Raises `SandboxError` if one of
    the processes is ended from outside.
    """
    prepare()
    jobs = jobs or os.cpu_count() or 1
    context = get_context(METHOD)
    ending, life = context.Pipe(duplex=False)
    pool = ProcessPoolExecutor(jobs, context, _begin, (ending,))
    coming = enumerate(items)
    numbers: dict[Future[Result], int] = {}
    try:
        while True:
            for number, item in islice(coming, AHEAD * jobs - len(numbers)):
                with starting():
                    numbers[pool.submit(work, item)] = number
            if not numbers:
                break
            for done in wait(numbers, return_when=FIRST_COMPLETED).done:
                yield numbers.pop(done), done.result()
    except BrokenProcessPool as error:
        life.close()
        raise SandboxError(_ENDED) from error
    except BaseException:
        life.close()  # nobody waits for what they are at
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
