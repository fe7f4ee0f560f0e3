"""Work in another process, so that the window never waits for it.

The process is bounded in time, gives way to the window, and ends with it, however that ends.
"""

import os
from collections.abc import Callable, Iterator
from contextlib import suppress
from multiprocessing import parent_process
from multiprocessing.connection import Connection
from multiprocessing.context import SpawnContext, SpawnProcess
from multiprocessing.reduction import ForkingPickler
from threading import Thread, Timer
from typing import Any

from sandbox.app.drawing import theme
from sandbox.app.words import language

LIMIT = 120.0  # s, how long a process may live
POLITE = 5  # by how much its priority is lower, where there are priorities

Work = Callable[..., Iterator[Any]]


class Background:
    """One piece of work at a time, whose findings come in one by one.

    Attributes
    ----------
    running
        Whether something is being worked on.
    """

    def __init__(self) -> None:
        self._process: SpawnProcess | None = None
        self._findings: Connection | None = None

    @property
    def running(self) -> bool:
        """Whether something is being worked on."""
        return self._process is not None

    @property
    def pid(self) -> int | None:
        """The process that works; None if none does."""
        return self._process.pid if self._process else None

    def start(self, work: Work, *arguments: object) -> None:
        """Begin a piece of work, and drop the one in progress."""
        self.cancel()
        task = ForkingPickler.dumps((work, arguments, theme.used(), language.used()))
        self._findings, sender = SpawnContext().Pipe(duplex=False)
        orders, order = SpawnContext().Pipe(duplex=False)
        self._process = SpawnProcess(target=_run, args=(sender, orders), daemon=True, name="study")
        self._process.start()
        sender.close()
        orders.close()
        Thread(target=_hand_over, args=(order, task), daemon=True).start()

    def found(self) -> Iterator[Any]:
        """Yield the results that have come in since the last call, without waiting."""
        while self._findings is not None:
            try:
                if not self._findings.poll():
                    return
                finding = self._findings.recv()
            except (EOFError, OSError):  # at its end, or in the middle of a finding
                self.cancel()
                return
            yield finding

    def cancel(self) -> None:
        """End what is under way, at once."""
        if self._process is not None:
            self._process.kill()  # to terminate it would be a request, which it may ignore
            self._process.join()
            self._process.close()
        if self._findings is not None:
            self._findings.close()
        self._process = self._findings = None


def _hand_over(order: Connection, task: memoryview) -> None:
    """Send a task, in a thread: one that fills the pipe waits for the process to be there."""
    with order, suppress(BrokenPipeError):  # cancelled before it began
        order.send_bytes(task)


def _run(sender: Connection, orders: Connection) -> None:
    """Work, in the other process, and send what is found."""
    Thread(target=_end_with_the_window, daemon=True).start()
    limit = Timer(LIMIT, os._exit, (1,))
    limit.daemon = True
    limit.start()
    if hasattr(os, "nice"):
        os.nice(POLITE)
    try:
        work, arguments, look, spoken = orders.recv()
        theme.use(look)  # pictures that it draws look like the window
        language.use(spoken)  # and it tells what it finds as the window does
        for finding in work(*arguments):
            sender.send(finding)
    except BrokenPipeError:
        pass  # nobody wants to know any more
    finally:
        sender.close()


def _end_with_the_window() -> None:
    window = parent_process()
    if window is not None:
        window.join()
        os._exit(1)
