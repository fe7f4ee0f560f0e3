"""Large blocks are given back when they are freed, where the C library can be told so."""

import ctypes
import platform
import subprocess
import sys

import pytest

from sandbox.app import malloc_tuning

FREED = """
from pathlib import Path
import ctypes, sys
import numpy as np
from sandbox.app.malloc_tuning import give_back_large_blocks

def held():
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096 / 1e6

if sys.argv[1] == "told":
    assert give_back_large_blocks()
for size in (10_000_000, 20_000_000):  # glibc takes what is smaller from the heap from now on
    np.ones(size // 8)
before = held()
blocks = [(np.ones(125_000), np.ones(500)) for _ in range(50)]  # large and small ones by turns
small = [small for _, small in blocks]
del blocks
print(held() - before)
"""


@pytest.mark.skipif(
    sys.platform != "linux" or platform.libc_ver()[0] != "glibc", reason="it is glibc's option"
)
def test_gaps_between_small_blocks_are_given_back() -> None:
    usual, told = (
        float(subprocess.check_output([sys.executable, "-c", FREED, how])) for how in ("", "told")
    )
    assert usual > 40  # MB
    assert told < 5


def test_a_library_without_the_option_is_left_as_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ctypes, "CDLL", lambda _: object())

    assert not malloc_tuning.give_back_large_blocks()
