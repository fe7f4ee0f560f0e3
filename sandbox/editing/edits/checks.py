"""Checks and ghosts added and taken away, and the quantities that they may name."""

from collections.abc import Mapping, Sequence
from typing import Any, Literal

from sandbox.editing.layout import Json
from sandbox.editing.mending import accepted, without_meaning
from sandbox.editing.patches import Changes, put, put_all, remove
from sandbox.model.level import Level
from sandbox.model.quantities import quantities

MOST = 200
"""How many names are offered at the most."""


def add_checks(
    text: str, level: Level, checks: Sequence[Mapping[str, Any]], besides: Changes | None = None
) -> str:
    """Return a level with more checks, as they stand in a file, and with what else they need.

    Raises
    ------
    LevelError
        If the loader refuses it.
    """
    count = len(level.checks)
    new: Changes = {("checks", count + i): check for i, check in enumerate(checks)}
    return accepted(put_all(text, {**new, **(besides or {})}))


def set_ghost(text: str, body: str, place: tuple[Json, Json]) -> str:
    """Return a level with a ghost of a body, at [x, y] as formulas over the parameters and t.

    Raises
    ------
    LevelError
        If the loader refuses it.
    """
    return accepted(put(text, ("ghosts", body), list(place)))


def drop_told(text: str, part: Literal["checks", "ghosts"], which: int | str) -> str:
    """Return a level without a check or a ghost, and without the parameters that only it used.

    Raises
    ------
    PatchError
        If there is no such.
    """
    return without_meaning(remove(text, (part, which)))


def complete(level: Level, begun: str) -> list[str]:
    """Return the names of quantities that go on from what was typed, the likeliest first.

    Those that begin with it, then those that have it in them; `pos` finds `ball.position.x`.
    """
    typed = begun.strip().casefold()
    names = [quantity.name for quantity in quantities(level)]
    found = [name for name in names if typed in name.casefold()]
    return sorted(found, key=lambda name: not name.casefold().startswith(typed))[:MOST]
