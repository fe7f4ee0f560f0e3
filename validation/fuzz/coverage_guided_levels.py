"""Levels found by Atheris: those that reach new code are mutated further."""

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
from validation.fuzz.atheris_process import LONGEST
from validation.fuzz.isolated_trial import HANGS, STARTS, Outcome, Trial, Tried

FIRST = 200
"""The number of random inputs to begin with; Atheris itself begins with empty ones."""


def available() -> bool:
    """Whether Atheris is installed; it has wheels for some systems only."""
    return find_spec("atheris") is not None


def guided(seed: int, trial: Trial) -> Generator[Tried]:
    """Yield the outcomes of the levels that Atheris makes, endlessly.

    An outcome in its process counts if it is an answer. Otherwise the level is tried again by
    itself, since instrumented code is slow, and a long-running process has a history. The levels
    depend on the seed and on the code. Raises `SandboxError` if the process ends before its first
    attempt.
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
                raise SandboxError("Atheris ended before it tried a level: uninstall it to go on")
            before += last + 1


def _explored(seed: int, folder: str) -> Iterator[tuple[int, str, Outcome | None]]:
    """Yield the attempts of a process and their outcomes until it ends; the last may have None."""
    ours, theirs = Pipe()
    command = [sys.executable, "-m", "validation.fuzz.atheris_process", str(theirs.fileno())]
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
    """Return the next message of the process; None if it has ended or hangs."""
    try:
        return line.recv() if line.poll(wait) else None
    except (EOFError, OSError):
        return None
