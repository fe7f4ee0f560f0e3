"""Adding and removing checks and ghosts, and the quantities that they may name."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Literal

from sandbox.editing.cleanup_after_edit import accepted, without_meaning
from sandbox.editing.inserted_value_layout import Json
from sandbox.editing.text_patches import Changes, put, put_all, remove
from sandbox.model.expressions import Expression
from sandbox.model.level import Level
from sandbox.model.quantities import quantities

MOST = 200
"""The largest number of names offered."""


def add_checks(
    text: str, level: Level, checks: Sequence[Mapping[str, Any]], besides: Changes | None = None
) -> str:
    """Return a level with additional checks, as in a file, and with other changes that they need.

    Raises `LevelError` if the loader refuses it.
    """
    count = len(level.checks)
    new: Changes = {("checks", count + i): check for i, check in enumerate(checks)}
    return accepted(put_all(text, {**new, **(besides or {})}))


def set_ghost(text: str, body: str, position: tuple[Json, Json]) -> str:
    """Return a level with a ghost of a body, at [x, y], formulas of the parameters and t.

    Raises `LevelError` if the loader refuses it.
    """
    return accepted(put(text, ("ghosts", body), list(position)))


def flight(level: Level, body: str) -> tuple[Json, Json]:
    """Return the closed form of free flight: x + v t + a t²/2."""
    spec, gravity = level.bodies[body], level.effects.gravity
    pull = gravity.acceleration if gravity is not None else (None, None)
    x, y = (
        " + ".join(_terms(place, speed, along))
        for place, speed, along in zip(spec.position, spec.velocity, pull, strict=True)
    )
    return x, y


def _terms(position: Expression, speed: Expression, along: Expression | None) -> Iterator[str]:
    yield f"({position.source})"
    if speed.source != 0:
        yield f"({speed.source})*t"
    if along is not None and along.source != 0:
        yield f"({along.source})*t**2/2"


def drop_check_or_ghost(text: str, part: Literal["checks", "ghosts"], which: int | str) -> str:
    """Return a level without a check or a ghost, and without parameters that only it used.

    Raises `PatchError` if there is none.
    """
    return without_meaning(remove(text, (part, which)))


def quantity_completions(level: Level, partial: str) -> list[str]:
    """Return the names of quantities that contain a typed text, the likeliest first.

    Names that begin with it precede those that contain it: `pos` finds `ball.position.x`. In both
    groups the quantities of static bodies come last.
    """
    typed = partial.strip().casefold()
    still = {name for name, body in level.bodies.items() if body.type == "static"}
    found = [quantity for quantity in quantities(level) if typed in quantity.name.casefold()]
    found.sort(key=lambda q: (not q.name.casefold().startswith(typed), q.subject in still))
    return [quantity.name for quantity in found[:MOST]]
