"""Levels that Atheris leads to: those that reach new code are changed and tried further."""

import json
import subprocess
import sys
from collections.abc import Generator, Iterator
from importlib.util import find_spec
from multiprocessing import Pipe
from multiprocessing.connection import Connection
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Any

from sandbox.model.errors import SandboxError
from sandbox.model.message import Message
from validation.fuzz.explorer import LONGEST
from validation.fuzz.trial import HANGS, STARTS, Outcome, Trial, Tried

FIRST = 200
"""The random inputs to begin with; by itself Atheris begins with empty ones."""


def available() -> bool:
    """Whether Atheris is installed; it has wheels for some systems only."""
    return find_spec("atheris") is not None


def guided(seed: int, trial: Trial) -> Generator[Tried]:
    """Yield the outcomes of the levels that Atheris makes, without end.

    What its process makes of a level counts if that is an answer. Else the level is tried once more
    by itself, for code whose branches are counted is slow, and a process that lasts has a past.

    Parameters
    ----------
    seed
        The seed; the rest depends on the code.
    trial
        Tries a level by itself.

    Raises
    ------
    SandboxError
        If its process ends before it tries anything.
    """
    before = 0
    with TemporaryDirectory() as folder:
        draw = Random(seed)
        for each in range(FIRST):
            Path(folder, str(each)).write_bytes(draw.randbytes(draw.randrange(50, LONGEST)))
        while True:
            last = -1
            for last, text, outcome in _explored(draw.randrange(1, 2**31), folder):
                known = outcome if outcome and outcome.passed else trial.run(text)
                yield Tried(before + last, json.loads(text), known)
            if last < 0:
                raise SandboxError(
                    Message("Atheris ended before it tried a level: uninstall it to go on")
                )
            before += last + 1


def _explored(seed: int, folder: str) -> Iterator[tuple[int, str, Outcome | None]]:
    """Yield what a process tries until it ends, and what it makes of that; None of the last."""
    ours, theirs = Pipe()
    command = [sys.executable, "-m", "validation.fuzz.explorer", str(theirs.fileno())]
    with (
        ours,
        subprocess.Popen(
            [*command, str(seed), folder],
            pass_fds=[theirs.fileno()],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        ) as process,
    ):
        theirs.close()
        try:
            wait = STARTS
            while told := _said(ours, wait):
                yield *told, _said(ours, wait := HANGS)
        finally:
            process.kill()


def _said(line: Connection, wait: float) -> Any:  # noqa: ANN401 (whatever is sent)
    """Return the output of the process; None if it ended or hangs."""
    try:
        return line.recv() if line.poll(wait) else None
    except (EOFError, OSError):
        return None
