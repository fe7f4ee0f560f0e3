"""How the C library keeps the memory of the window."""

import ctypes

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
    try:
        option = ctypes.CDLL(None).mallopt
    except (AttributeError, OSError, TypeError):  # not glibc, or no C library to be asked
        return False
    return bool(option(_THRESHOLD_OPTION, THRESHOLD))
