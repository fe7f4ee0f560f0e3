"""Tunes glibc's memory allocator for the window."""

import ctypes
from collections.abc import Callable

_THRESHOLD_OPTION = -3  # M_MMAP_THRESHOLD of glibc's malloc.h
THRESHOLD = 128 * 1024
"""Blocks from this size on are returned to the system when freed; glibc's initial value [bytes]."""


def give_back_large_blocks() -> bool:
    """Keep large blocks out of the heap, where they leave gaps; return whether that was possible.

    By default glibc raises the threshold whenever a large block is freed. A window allocates and
    frees pictures and states all the time, and small blocks between them would keep freed memory
    from being returned. Other C libraries are not changed.
    """
    option = _function("mallopt")
    return option is not None and bool(option(_THRESHOLD_OPTION, THRESHOLD))


def give_back_gaps() -> bool:
    """Return free memory inside the heap to the system; return whether there was any.

    glibc by itself returns only free memory at the end of the heap. This takes up to some
    milliseconds.
    """
    trim = _function("malloc_trim")
    return trim is not None and bool(trim(0))


def _function(name: str) -> Callable[..., int] | None:
    """Return a function of glibc; None if the C library lacks it, or cannot be accessed."""
    try:
        found: Callable[..., int] = getattr(ctypes.CDLL(None), name)
    except (AttributeError, OSError, TypeError):
        return None
    return found
