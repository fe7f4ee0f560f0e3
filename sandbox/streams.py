"""Standard output and error, whose reader may have gone or whose disk may be full."""

import io
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import NoReturn

FAILED = 1
UNHEARD = 141
"""The exit status if the reader of the output has gone, as shells have it: 128 and the number of
SIGPIPE."""


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
        with suppress(OSError, ValueError):  # what is left goes nowhere, without another error
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, self.fileno())
            os.close(nowhere)
        if isinstance(error, BrokenPipeError):
            sys.exit(UNHEARD)
        complain(f"cannot write to the standard output: {error.strerror or error}")
        sys.exit(FAILED)


def install() -> None:
    """Let the standard output end the process in good order where it cannot be written."""
    out = sys.stdout
    if isinstance(out, io.TextIOWrapper):
        buffering, encoding = out.line_buffering, out.encoding
        sys.stdout = Output(out.detach(), encoding, "replace", line_buffering=buffering)


@contextmanager
def standard() -> Iterator[None]:
    """Turn unhandled errors of the system into one sentence."""
    try:
        yield
    except OSError as error:
        place = f"{error.filename}: " if error.filename else ""
        complain(f"{place}{error.strerror or error}")
        sys.exit(FAILED)
    finally:
        if sys.stdout is not None:
            sys.stdout.flush()


def complain(message: str) -> None:
    """Say a sentence on the standard error, if anybody listens there."""
    with suppress(OSError, ValueError, AttributeError):
        sys.stderr.write(f"{message}\n")
        sys.stderr.flush()
