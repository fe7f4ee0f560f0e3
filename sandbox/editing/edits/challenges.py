"""Making a level a challenge: its parameters are free, and a body has to end in a region."""

from collections.abc import Sequence

from sandbox.editing.bodies_at_start import PlacedBody, bounding_box, placed
from sandbox.editing.cleanup_after_edit import accepted, without_meaning
from sandbox.editing.inserted_value_layout import Json, plain
from sandbox.editing.text_patches import put, remove
from sandbox.model.errors import SandboxError
from sandbox.model.level import Level

DIGITS = 6
"""Decimals of the bounds of the region [m]."""

STEP = 1.0
"""m, the distance to the right at which the region begins if there is no target, and its width."""


def add_challenge(text: str, level: Level, body: str, task: str, labels: Sequence[str]) -> str:
    """Return a level with a challenge: to bring a body to a target by setting the parameters.

    The target consists of all static bodies except the widest, the ground: the body must end
    between its sides, and not above its top. The present parameters are the solution. The labels
    are those of the horizontal and the vertical goal. Raises `SandboxError` if the level has no
    parameters, or a challenge already.
    """
    if not level.parameters:
        raise SandboxError(
            "a challenge needs something to change: make a number a parameter by its slider"
        )
    if level.challenge is not None:
        raise SandboxError("the level already has a challenge")
    at, (across, upwards) = level.duration.source, _bounds(level, body)
    goals: list[Json] = [
        {"label": label, "quantity": f"{body}.position.{axis}", "at": at, **bounds}
        for label, axis, bounds in zip(labels, "xy", (across, upwards), strict=True)
        if bounds
    ]
    challenge: dict[str, Json] = {
        "task": task,
        "free": list(level.parameters),
        "goals": goals,
        "solution": {name: plain(p.value) for name, p in level.parameters.items()},
    }
    return accepted(put(text, ("challenge",), challenge))


def drop_challenge(text: str) -> str:
    """Return a level without its challenge."""
    return without_meaning(remove(text, ("challenge",)))


def _bounds(level: Level, body: str) -> tuple[dict[str, Json], dict[str, Json]]:
    """Return the horizontal and the vertical bounds of the region [m]."""
    where = placed(level)
    target = _target(list(where.values()))
    if not target:
        x = where[body].center.real
        return {"above": _number(x + STEP), "below": _number(x + 2 * STEP)}, {}
    low, high = bounding_box(target)
    return {"above": _number(low.real), "below": _number(high.real)}, {"below": _number(high.imag)}


def _target(bodies: Sequence[PlacedBody]) -> list[PlacedBody]:
    """Return the static bodies without the ground."""
    still = [one for one in bodies if one.body.type == "static"]
    ground = max(still, key=lambda one: (one.bounds[1] - one.bounds[0]).real, default=None)
    return [one for one in still if one is not ground]


def _number(value: float) -> Json:
    return plain(round(value, DIGITS))
