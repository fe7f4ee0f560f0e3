"""Large blocks are returned when they are freed, where the C library can be told to."""

import ctypes
import platform
import subprocess
import sys

import pytest

from sandbox.app import malloc_tuning, open_level_and_panels, window
from tests.app.person import Person

FREED = """
from pathlib import Path
import ctypes, sys
import numpy as np
from sandbox.app.malloc_tuning import give_back_gaps, give_back_large_blocks

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
if sys.argv[1] == "gaps":
    assert give_back_gaps()
print(held() - before)
"""


@pytest.mark.sweep
@pytest.mark.skipif(
    sys.platform != "linux" or platform.libc_ver()[0] != "glibc", reason="it is glibc's option"
)
def test_gaps_between_small_blocks_are_given_back() -> None:
    usual, *given_back = (
        float(subprocess.check_output([sys.executable, "-c", FREED, how]))
        for how in ("", "told", "gaps")
    )
    assert usual > 40  # MB
    assert max(given_back) < 5


def test_a_library_without_the_option_is_left_as_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ctypes, "CDLL", lambda _: object())

    assert not malloc_tuning.give_back_large_blocks()
    assert not malloc_tuning.give_back_gaps()


def test_a_window_that_comes_to_rest_gives_back_once(
    person: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    times = list[int]()
    monkeypatch.setattr(window, "give_back_gaps", lambda: times.append(1))
    person.move((100, 100))

    person.wait(0.9)
    assert not times
    person.wait(3)
    assert len(times) == 1


def test_a_level_that_is_opened_gives_back_what_the_last_one_has_left(
    person: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    times = list[int]()
    monkeypatch.setattr(open_level_and_panels, "give_back_gaps", lambda: times.append(1))

    person.window.open_level("newton/atwood")

    assert len(times) == 1
