"""Standard output and error, whose reader may have gone or whose disk may be full."""

import io
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Literal, NoReturn

FAILED = 1
UNHEARD = 141
"""The exit status if the reader has gone, as in shells: 128 and the number of SIGPIPE."""


class Output(io.TextIOWrapper):
    """The standard output, which ends the process in good order where it cannot be written."""

    def write(self, text: str) -> int:
        """Write a text."""
        try:
            return super().write(text)
        except OSError as error:
            self._end(error)

    def flush(self) -> None:
        """Pass on what was written."""
        try:
            super().flush()
        except OSError as error:
            self._end(error)

    def _end(self, error: OSError) -> NoReturn:
        _give_up(self)
        if isinstance(error, BrokenPipeError):
            sys.exit(UNHEARD)
        complain(f"cannot write to the standard output: {error.strerror or error}")
        sys.exit(FAILED)


class Remarks(io.TextIOWrapper):
    """The standard error: what cannot be written there is dropped, and the work goes on."""

    def write(self, text: str) -> int:
        """Write a text."""
        try:
            return super().write(text)
        except OSError:
            _give_up(self)
            return len(text)

    def flush(self) -> None:
        """Pass on what was written."""
        try:
            super().flush()
        except OSError:
            _give_up(self)


def _give_up(stream: io.TextIOWrapper) -> None:
    """Redirect a stream to the null device, so that what is left raises no more errors."""
    with suppress(OSError, ValueError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, stream.fileno())
        os.close(nowhere)


def install() -> None:
    """Keep errors of the standard streams from causing tracebacks or losing results.

    A stream that is closed becomes the null device: the next file that is opened would get its
    number, and what a library prints.
    """
    sys.stdin = sys.stdin or _null("r")
    sys.stdout = sys.stdout or _null("w")
    sys.stderr = sys.stderr or _null("w")
    out, remarks = sys.stdout, sys.stderr
    if isinstance(out, io.TextIOWrapper):
        buffering, encoding = out.line_buffering, out.encoding
        sys.stdout = Output(out.detach(), encoding, "replace", line_buffering=buffering)
    if isinstance(remarks, io.TextIOWrapper):
        encoding = remarks.encoding
        sys.stderr = Remarks(remarks.detach(), encoding, "replace", line_buffering=True)


def _null(mode: Literal["r", "w"]) -> io.TextIOWrapper:
    """Return the null device, which stays open as long as the process lives."""
    return open(os.open(os.devnull, os.O_RDWR), mode, encoding="utf-8", closefd=False)


@contextmanager
def standard() -> Iterator[None]:
    """Turn unhandled errors of the system into one sentence.

    A `SystemExit` that another error wraps, as inside a class statement, still exits.
    """
    try:
        yield
    except OSError as error:
        place = f"{error.filename}: " if error.filename else ""
        complain(f"{place}{error.strerror or error}")
        sys.exit(FAILED)
    except RuntimeError as error:
        if isinstance(error.__cause__, SystemExit):
            raise error.__cause__ from None
        raise
    finally:
        sys.stdout.flush()


def complain(message: str) -> None:
    """Say a sentence on the standard error, if anybody listens there."""
    with suppress(OSError, ValueError, AttributeError):
        sys.stderr.write(f"{message}\n")
        sys.stderr.flush()
