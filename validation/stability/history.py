"""Where the frontiers lay: a file that the project keeps."""

import json
from collections.abc import Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import TypedDict

from sandbox import __version__
from sandbox.model.files import write_atomically

FILE = Path(__file__).parent / "frontiers.json"


class Entry(TypedDict):
    """A frontier at a date."""

    date: str
    version: str
    figure: float
    naive: float


History = dict[str, list[Entry]]
"""The entries of each frontier by its name, the newest last."""


def read(file: Path = FILE) -> History:
    """Return what the file says; nothing if there is none."""
    if not file.is_file():
        return {}
    found: History = json.loads(file.read_text(encoding="utf-8"))
    return found


def last(history: Mapping[str, list[Entry]], name: str) -> Entry | None:
    """Return where a frontier lay when it was last written down."""
    entries = history.get(name)
    return entries[-1] if entries else None


def moved_inward(figure: float, before: Entry | None, tolerance: float) -> bool:
    """Return whether a frontier lies further in than it did, by more than a factor."""
    return before is not None and figure * tolerance < before["figure"]


def update(found: Mapping[str, tuple[float, float]], file: Path = FILE) -> None:
    """Write down where frontiers lie now, those of the sandbox and of pymunk alone.

    A frontier that has not moved gets no new entry.
    """
    history = read(file)
    today = datetime.now(UTC).date().isoformat()
    for name, (figure, naive) in found.items():
        before = last(history, name)
        if before and abs(figure - before["figure"]) <= 1e-3 * figure:
            continue
        entry = Entry(date=today, version=__version__, figure=_short(figure), naive=_short(naive))
        history.setdefault(name, []).append(entry)
    write_atomically(file, json.dumps(history, indent=2, ensure_ascii=False) + "\n")


def _short(figure: float) -> float:
    return float(f"{figure:.4g}")
