"""The history of the frontiers, in a file of the project."""

import json
from collections.abc import Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import TypedDict

from sandbox.version import __version__
from validation.output import save

FILE = Path(__file__).parent / "frontiers.json"


NOISE = 2.0
"""The factor within which pymunk's frontiers vary, since they depend on timings."""


class Entry(TypedDict):
    """A frontier on a date."""

    date: str
    version: str
    figure: float
    naive: float


History = dict[str, list[Entry]]
"""The entries of each frontier by its name, the newest last."""


def read(file: Path = FILE) -> History:
    """Return the content of the file; empty if there is none."""
    if not file.is_file():
        return {}
    return json.loads(file.read_text(encoding="utf-8"))


def last(history: Mapping[str, list[Entry]], name: str) -> Entry | None:
    """Return the last entry of a frontier; None if there is none."""
    entries = history.get(name)
    return entries[-1] if entries else None


def moved_inward(figure: float, before: Entry | None, tolerance: float) -> bool:
    """Return whether a frontier has receded by more than a factor."""
    return before is not None and figure * tolerance < before["figure"]


def update(found: Mapping[str, tuple[float, float]], file: Path = FILE) -> None:
    """Record the present frontiers of the sandbox, and of pymunk alone.

    A frontier that has not moved gets no new entry, unless pymunk's has moved by more than its
    noise.
    """
    history = read(file)
    today = datetime.now(UTC).date().isoformat()
    for name, (figure, naive) in found.items():
        before = last(history, name)
        if (
            before
            and _is_near(figure, before["figure"], 1.001)
            and _is_near(naive, before["naive"], NOISE)
        ):
            continue
        entry = Entry(date=today, version=__version__, figure=_short(figure), naive=_short(naive))
        history.setdefault(name, []).append(entry)
    save(history, file)


def _is_near(figure: float, before: float, factor: float) -> bool:
    return before / factor <= figure <= before * factor


def _short(figure: float) -> float:
    return float(f"{figure:.4g}")
