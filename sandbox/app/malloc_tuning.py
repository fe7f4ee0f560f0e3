"""How the C library keeps the memory of the window."""

import ctypes
from collections.abc import Callable

_THRESHOLD_OPTION = -3  # M_MMAP_THRESHOLD of glibc's malloc.h
THRESHOLD = 128 * 1024
"""Bytes: blocks of this size and more are returned to the system when freed. glibc's initial
value."""


def give_back_large_blocks() -> bool:
    """Keep large blocks out of the heap, where they leave gaps; return whether that was possible.

    glibc does so as well until one of them is freed: from then on it takes larger and larger ones
    from the heap. Pictures and states come and go all the time in a window, and what little stays
    between them keeps the rest. Other libraries are left as they are.
    """
    option = _function("mallopt")
    return option is not None and bool(option(_THRESHOLD_OPTION, THRESHOLD))


def give_back_gaps() -> bool:
    """Give back what is free between what is held; return whether anything was.

    glibc itself gives back only what is free at the end. This takes up to some milliseconds.
    """
    trim = _function("malloc_trim")
    return trim is not None and bool(trim(0))


def _function(name: str) -> Callable[..., int] | None:
    """Return a function of glibc; None if this is another C library, or none that can be asked."""
    try:
        found: Callable[..., int] = getattr(ctypes.CDLL(None), name)
    except (AttributeError, OSError, TypeError):
        return None
    return found
