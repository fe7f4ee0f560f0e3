"""Repairs levels that were refused, so that more code than the rules is tried."""

import json
from collections.abc import Callable, Iterator, Sequence
from copy import deepcopy
from typing import Any

from validation.fuzz.isolated_trial import Outcome

ROUNDS = 8
"""The most repairs of a level."""


def answered(
    data: dict[str, Any], run: Callable[[str], Outcome]
) -> Iterator[tuple[dict[str, Any], Outcome]]:
    """Yield a level with its outcome, and repaired versions for as long as it is refused.

    `run` returns the outcome of a level's text.
    """
    for _ in range(ROUNDS + 1):
        outcome = run(json.dumps(data))
        yield data, outcome
        if not outcome.mistakes:
            return
        data = mended(data, outcome.mistakes)


def mended(data: dict[str, Any], mistakes: Sequence[tuple[str, str]]) -> dict[str, Any]:
    """Return a level without the parts that were refused, as far as they can be removed."""
    made = deepcopy(data)
    for place, rule in reversed(mistakes):
        steps = place.split(".") if place else []
        part = _at(made, steps)
        if "needs a mass" in rule and isinstance(part, dict):
            part["mass"] = 1
        elif steps:
            _remove(made, steps[: -1 if part is None else None])
    return made


def _remove(data: dict[str, Any], steps: Sequence[str]) -> None:
    """Remove the value at a path, unless that is the whole level."""
    around = _at(data, steps[:-1]) if steps else None
    if isinstance(around, dict):
        around.pop(steps[-1], None)
    elif isinstance(around, list) and int(steps[-1]) < len(around):
        del around[int(steps[-1])]


def _at(data: Any, steps: Sequence[str]) -> Any:  # noqa: ANN401 (whatever JSON holds)
    """Return the value at a path; None if there is none."""
    for step in steps:
        if isinstance(data, dict):
            data = data.get(step)
        elif isinstance(data, list) and step.isdigit() and int(step) < len(data):
            data = data[int(step)]
        else:
            return None
    return data
