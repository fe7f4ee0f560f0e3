"""Runs work in a background process, so that the window never waits for it.

The process has a time limit and a lower priority, and ends when the window does, however that ends.
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
from sandbox.parallel_processes import starting

LIMIT = 120.0  # s, the longest lifetime of a process
POLITE = 5  # added to the process's niceness, where there is one

Work = Callable[..., Iterator[Any]]


class Background:
    """Runs one task at a time, and receives its results one by one."""

    def __init__(self) -> None:
        self._process: SpawnProcess | None = None
        self._findings: Connection | None = None
        self._orders: Connection | None = None  # to work that listens

    @property
    def running(self) -> bool:
        """Whether a task is running."""
        return self._process is not None

    @property
    def pid(self) -> int | None:
        """The process ID; None if no task is running."""
        return self._process.pid if self._process else None

    def start(self, work: Work, *arguments: object, listens: bool = False) -> None:
        """Start a task, and cancel the one in progress.

        Parameters
        ----------
        work, arguments
            A function that yields findings, and its arguments.
        listens
            Whether the function also gets a connection from which it receives what is sent.
        """
        self.cancel()
        task = ForkingPickler.dumps((work, arguments, listens, theme.used(), language.used()))
        self._findings, sender = SpawnContext().Pipe(duplex=False)
        orders, order = SpawnContext().Pipe(duplex=False)
        self._process = SpawnProcess(target=_run, args=(sender, orders), daemon=True, name="study")
        with starting():
            self._process.start()
        sender.close()
        orders.close()
        if listens:
            order.send_bytes(task)
            self._orders = order
        else:
            Thread(target=_hand_over, args=(order, task), daemon=True).start()

    def send(self, order: object) -> None:
        """Send something small to work that listens."""
        if self._orders is not None:
            with suppress(BrokenPipeError):  # the work has ended, as `results` will notice
                self._orders.send(order)

    def results(self) -> Iterator[Any]:
        """Yield the results that have come in since the last call, without waiting."""
        while self._findings is not None:
            try:
                if not self._findings.poll():
                    return
                finding = self._findings.recv()
            except (EOFError, OSError):  # at the end, or in the middle of a result
                self.cancel()
                return
            yield finding

    def cancel(self) -> None:
        """End the task at once."""
        if self._process is not None:
            self._process.kill()  # terminate() would be a request, which it may ignore
            self._process.join()
            self._process.close()
        for end in (self._findings, self._orders):
            if end is not None:
                end.close()
        self._process = self._findings = self._orders = None


class BackgroundTask:
    """Something that has its work done in the background."""

    def __init__(self) -> None:
        self._work = Background()
        self.news = object()
        """An object that differs whenever the display must change."""

    @property
    def running(self) -> bool:
        """Whether work is under way."""
        return self._work.running

    def cancel(self) -> None:
        """Cancel the work."""
        self._work.cancel()
        self.news = object()


def _hand_over(order: Connection, task: memoryview) -> None:
    """Send a task, in a thread: one that fills the pipe blocks until the process reads it."""
    with order, suppress(BrokenPipeError):  # cancelled before it started
        order.send_bytes(task)


def _run(sender: Connection, orders: Connection) -> None:
    """Run the task in the other process, and send its results."""
    Thread(target=_end_with_the_window, daemon=True).start()
    limit = Timer(LIMIT, os._exit, (1,))
    limit.daemon = True
    limit.start()
    if hasattr(os, "nice"):
        os.nice(POLITE)
    try:
        work, arguments, listens, look, spoken = orders.recv()
        theme.use(look)  # so that its pictures match the window
        language.use(spoken)  # so that its texts match the window
        for finding in work(*arguments, *((orders,) if listens else ())):
            sender.send(finding)
    except (BrokenPipeError, EOFError):
        pass  # nobody reads the results, or gives orders, any more
    finally:
        sender.close()


def _end_with_the_window() -> None:
    window = parent_process()
    if window is not None:
        window.join()
        os._exit(1)
