"""Ctrl-C, requests to terminate and closed terminals: they end a run even in pymunk's callbacks."""

import signal
import sys
import time
from _thread import interrupt_main, start_new_thread
from types import FrameType

STATUS = 128
"""Shells add this to the number of the signal that ended a process."""

INTERRUPTED = STATUS + signal.SIGINT
ENDED = STATUS + signal.SIGTERM
"""The exit statuses."""

SIGNALS = tuple(
    signal.Signals[name] for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)
)
"""The signals that end the process in good order; there is no SIGHUP on Windows."""

_asked: list[int] = []  # the signals that have come

_CALLBACKS = "pymunk._callbacks"
_RETRY = 0.001  # s


def install() -> None:
    """End the process on each of `SIGNALS`, without a traceback.

    A closed terminal does not end what was started to outlive it, by `nohup`.
    """
    for number in SIGNALS:
        if number in (signal.SIGINT, signal.SIGTERM) or signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, _interrupt)
    sys.unraisablehook = _lost
    _asked.clear()


def insist() -> None:
    """Exit if a signal has come whose exit was lost: pydantic makes another error of it."""
    if _asked:
        sys.exit(STATUS + _asked[-1])


def _interrupt(number: int, frame: FrameType | None) -> None:
    """Exit, but not from inside a callback: there the exception would be printed and lost."""
    _asked.append(number)
    if not within_callback(frame):
        sys.exit(STATUS + number)
    start_new_thread(_again, (signal.Signals(number),))


def _lost(exception: "sys.UnraisableHookArgs") -> None:
    """Exit once more where nothing can be raised: while pymunk's objects are freed, say."""
    if isinstance(exception.exc_value, SystemExit):
        status = exception.exc_value.code
        ended_by = [number for number in SIGNALS if status == STATUS + number]
        start_new_thread(_again, (ended_by[0] if ended_by else signal.SIGINT,))
    else:
        sys.__unraisablehook__(exception)


def _again(number: signal.Signals) -> None:
    time.sleep(_RETRY)
    interrupt_main(number)


def within_callback(frame: FrameType | None) -> bool:
    """Whether a frame runs because pymunk has called it."""
    while frame is not None:
        if frame.f_globals.get("__name__") == _CALLBACKS:
            return True
        frame = frame.f_back
    return False
