"""What the quick tests take of a claim about all levels; `make sweep` goes through the rest.

A quick test takes every twelfth level of each chapter. Each claim begins with another one, so that
together they reach many.
"""

from collections.abc import Iterable
from itertools import groupby
from pathlib import Path
from zlib import crc32

import pytest

STRIDE = 12


def is_quick(levels: Iterable[str | Path], claim: str) -> list[bool]:
    """Return for each level whether the quick tests take it; at least one of each chapter.

    Parameters
    ----------
    levels
        Names such as `newton/atwood`, or files, chapter by chapter.
    claim
        What is claimed of them, in a word: another word, another sample.
    """
    found: list[bool] = []
    for _, chapter in groupby(levels, lambda level: Path(level).parent.name):
        count = len(list(chapter))
        start = crc32(claim.encode()) % min(STRIDE, count)
        found += [i % STRIDE == start for i in range(count)]
    return found


def sampled(levels: Iterable[str | Path], claim: str) -> list[object]:
    """Return levels as test parameters, chosen by `is_quick`; the others are marked `sweep`."""
    found = list(levels)
    return [
        pytest.param(level, id=_name(level), marks=() if quick else pytest.mark.sweep)
        for level, quick in zip(found, is_quick(found, claim), strict=True)
    ]


def thinned(examples: Iterable[object], every: int) -> list[object]:
    """Return examples as parameters of a test: the quick tests take the first of each so many.

    Parameters
    ----------
    examples
        Each is one argument, or a tuple of them.
    every
        How many examples there are for each that is quick.
    """
    return [
        pytest.param(*(found if isinstance(found, tuple) else (found,)), marks=marks)
        for i, found in enumerate(examples)
        for marks in [() if i % every == 0 else pytest.mark.sweep]
    ]


def _name(level: str | Path) -> str:
    path = Path(level)
    return f"{path.parent.name}/{path.stem}"
