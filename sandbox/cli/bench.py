"""`bench`: the time of the window's start, of a change of level, and of each frame."""

import json
import re
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from sandbox import progress_bar
from sandbox.cli import argument_parsing
from sandbox.cli.render import go_headless
from sandbox.cli.text_columns import aligned
from sandbox.model import level_catalog
from sandbox.model.atomic_file_writing import check_writable, write_atomically

if TYPE_CHECKING:
    from sandbox.app.window_benchmark import Timing

LEAST, MOST = 480, 8000  # px, of a window's width and height
HELD = 0.98
"""From this share of real time on, a level counts as running in real time: its first frames are
slower."""

_HEADER = (
    *("level", "first picture", "switch", "per second", "median frame", "99 % of frames below"),
    *("speed", ""),
)


def measure(names: Sequence[str], size: str, seconds: float, json_file: Path | None) -> int:
    """Measure levels, print the table, write it if asked to, and return the exit status."""
    window = _size(size)
    if json_file is not None:
        check_writable(json_file)
    for name in names:
        level_catalog.find(name)
    go_headless()
    from sandbox.app.window_benchmark import time_window

    levels = names or level_catalog.names()
    timed = (time_window(name, window, seconds) for name in levels)
    found = progress_bar.consume(timed, "Playing", len(levels))
    try:
        for line in aligned([_HEADER, *_rows(found)]):
            typer.echo(line)
    finally:  # the reader of the output may be gone
        if json_file is not None:
            result = {
                "size": window,
                "seconds": seconds,
                "levels": [asdict(each) for each in found],
            }
            write_atomically(json_file, f"{json.dumps(result, indent=2)}\n".encode())
    return int(any(_counts(each) and not each.smooth for each in found))


def _size(text: str) -> tuple[int, int]:
    """Return a width and a height [px]."""
    match = re.fullmatch(r"(\d{3,4})x(\d{3,4})", text)
    if match is None or not all(LEAST <= int(part) <= MOST for part in match.groups()):
        raise argument_parsing.UsageError(
            f"--size {text}: a width and a height in pixels from {LEAST} to {MOST}"
        )
    return int(match[1]), int(match[2])


def _counts(found: "Timing") -> bool:
    """Whether a level runs in real time, so that the bound on its frames applies."""
    return found.speed >= HELD


def _rows(found: "Sequence[Timing]") -> Iterator[tuple[str, ...]]:
    """Yield the table's rows, the slowest first."""
    for each in sorted(found, key=lambda timing: -timing.frame_p99):
        verdict = "smooth" if each.smooth else "not smooth" if _counts(each) else "too slow to run"
        yield (
            each.level,
            f"{each.first_picture:.2f} s{_mark(each, 'first_picture')}",
            f"{each.switch:.2f} s{_mark(each, 'switch')}",
            f"{each.cost:.2f} s",
            f"{each.frame_p50 * 1e3:.1f} ms",
            f"{each.frame_p99 * 1e3:.1f} ms{_mark(each, 'frame_p99')}",
            f"{each.speed:.2f}×",
            verdict,
        )


def _mark(found: "Timing", name: str) -> str:
    """Return the mark after a figure: `!` if it exceeds its bound."""
    return " !" if name in found.beyond else ""
