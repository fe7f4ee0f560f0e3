"""Measures the time from the start of the program to its first picture."""

import subprocess
import sys
from time import perf_counter

from sandbox.model.errors import SandboxError
from sandbox.model.message import Message

STARTS = 2
"""The number of starts. The fastest one counts, since disturbances only add."""

LIMIT = 120.0
"""The longest time of a start [s]."""


def first_picture(level: str) -> float:
    """Return the time from the start of a program that plays a level to its first picture [s].

    Raises `SandboxError` if a program ends without a picture, or shows none within `LIMIT`.
    """
    return min(_start(level) for _ in range(STARTS))


def _start(level: str) -> float:
    """Return the time of one start [s]; `perf_counter` is the same clock in both processes."""
    command = [sys.executable, "-m", "sandbox", "play", "--first-picture", "--", level]
    begun = perf_counter()
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=LIMIT, check=False)
    except subprocess.TimeoutExpired as error:
        raise SandboxError(
            "{level}: a window that was started on it showed no picture in {limit:g} s",
            level=level,
            limit=LIMIT,
        ) from error
    if done.returncode != 0:
        reason = done.stderr.strip().rpartition("\n")[2] or Message(
            "exit status {status}", status=done.returncode
        )
        raise SandboxError(
            "{level}: a window that was started on it showed no picture: {reason}",
            level=level,
            reason=reason,
        )
    return float(done.stdout) - begun
