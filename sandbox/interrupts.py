"""Ctrl-C, which must end a run even while pymunk calls back into Python."""

import signal
import sys
import time
from _thread import interrupt_main, start_new_thread
from types import FrameType

INTERRUPTED = 130
"""The exit status, as shells have it."""

_CALLBACKS = "pymunk._callbacks"
_RETRY = 0.001  # s


def install() -> None:
    """Let Ctrl-C end the process, whatever it does, without a traceback."""
    signal.signal(signal.SIGINT, _interrupt)
    sys.unraisablehook = _lost


def _interrupt(_signal: int, frame: FrameType | None) -> None:
    """Exit, but not from inside a callback: there the exception would be printed and lost."""
    if not within_callback(frame):
        sys.exit(INTERRUPTED)
    start_new_thread(_again, ())


def _lost(exception: "sys.UnraisableHookArgs") -> None:
    """Exit once more where nothing can be raised: while pymunk's objects are freed, say."""
    if exception.exc_type is SystemExit:
        start_new_thread(_again, ())
    else:
        sys.__unraisablehook__(exception)


def _again() -> None:
    time.sleep(_RETRY)
    interrupt_main()


def within_callback(frame: FrameType | None) -> bool:
    """Whether a frame runs because pymunk has called it."""
    while frame is not None:
        if frame.f_globals.get("__name__") == _CALLBACKS:
            return True
        frame = frame.f_back
    return False
