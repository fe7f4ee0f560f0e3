"""How much memory this process holds."""

import ctypes
import gc
import os
from pathlib import Path

STATM = Path("/proc/self/statm")


def held() -> float:
    """Return what is resident, after what is lost has been freed [MB]; Linux only."""
    gc.collect()
    _give_back()
    pages = int(STATM.read_text(encoding="ascii").split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6


def _give_back() -> None:
    """Let the C library return what is free between what is held: how much that is, is chance."""
    trim = getattr(ctypes.CDLL(None), "malloc_trim", None)
    if trim:
        trim(0)
