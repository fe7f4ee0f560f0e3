"""A level tried in a separate process, which may end, hang, or exhaust its resources."""

import os
import signal
import sys
import warnings
from contextlib import suppress
from dataclasses import dataclass
from multiprocessing import get_context
from multiprocessing.connection import Connection
from multiprocessing.context import SpawnProcess
from typing import Any, NamedTuple

from sandbox.model import level_catalog
from sandbox.model.errors import LevelError, SandboxError
from sandbox.model.level import Stepping
from sandbox.model.loading import parse
from sandbox.parallel_processes import starting
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import BreakdownError

SECONDS = 2.0
"""The processor time that an answer may take [s]."""

HANGS = 30.0
"""The time after which a process that computes nothing counts as hung [s]."""

BYTES = 500_000_000
"""The memory that an answer may take, in addition to that of the libraries."""

STARTS = 300.0
"""The time that the process may take to start on a busy machine [s]."""

STEPS = 8

MUCH = "hard/two-capstans"
"""A level that needs most of the modules."""

RUNS, REFUSED, STOPPED = "runs", "refused", "stopped"
ANSWERS = (RUNS, REFUSED, STOPPED)
"""The good outcomes: the level runs, is refused, or has to stop."""

SLOW, ENDED, UNTOLD = "slow", "ended", "not told"
"""The bad outcomes: no answer in time, a crash, or an unforeseen exception."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """The outcome of a level."""

    kind: str
    """One of `ANSWERS`, or the kind of failure."""
    what: str = ""
    """Details, in words."""
    mistakes: tuple[tuple[str, str], ...] = ()
    """The paths in a refused level, and what is wrong there."""

    @property
    def passed(self) -> bool:
        """Whether it is an answer."""
        return self.kind in ANSWERS


class Tried(NamedTuple):
    """A level, its origin, and its outcome."""

    number: int
    data: dict[str, Any]
    outcome: Outcome


NO_ANSWER = Outcome(SLOW, f"no answer in {HANGS:g} s")


def attempt(text: str) -> Outcome:
    """Read a level, build it and take a few steps, in this process."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            return _attempt(text)
    except Exception as error:  # noqa: BLE001 (that is what is looked for)
        return Outcome(UNTOLD, f"{type(error).__name__}: {error}"[:300])


def _attempt(text: str) -> Outcome:
    try:
        level = parse(text)
    except LevelError as error:
        return _of(error, REFUSED)
    try:
        stepping = Stepping() if level.stepping.accuracy is not None else level.stepping
        world = build(level, stepping=stepping)
        for _ in range(STEPS):
            world.advance()
    except SandboxError as error:
        return _of(error, STOPPED)
    return Outcome(RUNS)


def _of(error: SandboxError, answer: str) -> Outcome:
    """Return the outcome of an error; an unforeseen one is not an answer."""
    unforeseen = isinstance(error, BreakdownError)
    if unforeseen or (isinstance(error, LevelError) and error.__cause__ is not None):
        return Outcome(UNTOLD, f"{type(error.__cause__).__name__}: {error.__cause__}"[:300])
    found = error.mistakes if isinstance(error, LevelError) else ()
    return Outcome(answer, "", tuple((mistake.path, mistake.rule) for mistake in found))


class Trial:
    """A separate process that tries levels one after the other, restarted whenever it has ended.

    An answer may take some seconds of processor time.
    """

    def __init__(self, seconds: float = SECONDS) -> None:
        self._seconds = seconds
        self._process: SpawnProcess | None = None
        self._line: Connection | None = None

    def run(self, text: str) -> Outcome:
        """Return the outcome of a level; a level without an answer is tried twice.

        On a busy machine, a process may get no processor time for as long as an answer may take.
        """
        first = self._ask(text)
        return self._ask(text) if first == NO_ANSWER else first

    def _ask(self, text: str) -> Outcome:
        process, line = self._begun()
        try:
            line.send(text)
            if line.poll(HANGS):
                outcome: Outcome = line.recv()
                return outcome
            self.close()
            return NO_ANSWER
        except (EOFError, OSError):
            process.join(HANGS)
            status = process.exitcode
            self.close()
        if hasattr(signal, "SIGPROF") and status == -signal.SIGPROF:
            return Outcome(SLOW, f"no answer after {self._seconds:g} s of computing")
        return Outcome(ENDED, f"the process ended with {status}")

    def _begun(self) -> tuple[SpawnProcess, Connection]:
        if self._process is None or self._line is None:
            context = get_context("spawn")
            self._line, theirs = context.Pipe()
            self._process = context.Process(
                target=_serve, args=(theirs, self._seconds), daemon=True
            )
            with starting():
                self._process.start()
            theirs.close()
            if self._line.poll(STARTS):  # imports are not part of an answer
                with suppress(EOFError):
                    self._line.recv()
        return self._process, self._line

    def close(self) -> None:
        """End the separate process."""
        if self._process is not None and self._line is not None:
            self._process.kill()
            self._process.join()
            self._line.close()
        self._process = self._line = None


def _serve(line: Connection, seconds: float) -> None:
    """Answer requests in the separate process until the pipe closes."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    sys.stderr = open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115 (as long as it lives)
    load_libraries()
    limit_memory()
    line.send(None)
    while True:
        try:
            text = line.recv()
        except (EOFError, OSError):
            return
        line.send(attempt_within(seconds, text))


def load_libraries() -> None:
    """Import what levels need: that takes half a second, and is not part of an answer."""
    attempt(level_catalog.find(MUCH).read_text(encoding="utf-8"))


def attempt_within(seconds: float, text: str) -> Outcome:
    """Try a level in this process, which is killed after some processor time [s]."""
    _limit_time(seconds)
    outcome = attempt(text)
    _limit_time(0)
    return outcome


def _limit_time(seconds: float) -> None:
    """Kill this process after some processor time; never if it is 0."""
    if hasattr(signal, "ITIMER_PROF"):
        signal.setitimer(signal.ITIMER_PROF, seconds)


def limit_memory() -> None:
    """Allow this process at most `BYTES` more memory than it has."""
    if sys.platform == "linux":
        import resource

        with open("/proc/self/statm", encoding="ascii") as file:
            now = int(file.read().split()[0]) * os.sysconf("SC_PAGE_SIZE")
        resource.setrlimit(resource.RLIMIT_AS, (now + BYTES, now + BYTES))
