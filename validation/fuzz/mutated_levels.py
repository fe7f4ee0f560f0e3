"""The project's levels with a few random changes."""

import json
from collections.abc import Iterator
from copy import deepcopy
from random import Random
from typing import Any

from sandbox.model import level_catalog
from validation.fuzz.schema_grammar import HOSTILE

Place = tuple[Any, Any]
"""An object or a list, and the key or index of one of its members."""


def mutated(random: Random) -> dict[str, Any]:
    """Return a level of the catalog with a few changes."""
    name = random.choice(level_catalog.names())
    data: dict[str, Any] = json.loads(level_catalog.find(name).read_text(encoding="utf-8"))
    change(random, data)
    return data


def change(random: Random, data: Any) -> None:  # noqa: ANN401 (whatever JSON holds)
    """Change a few values in an object or a list, as far as it has any."""
    for _ in range(random.choice((1, 1, 2, 3, 6))):
        if found := list(places(data)):
            part, key = random.choice(found)
            _change(random, part, key, found)


def places(part: Any) -> Iterator[Place]:  # noqa: ANN401 (whatever JSON holds)
    """Yield the places of all members in a part of a level, outer ones first."""
    keys: list[Any] = list(part) if isinstance(part, dict) else []
    if isinstance(part, list):
        keys = list(range(len(part)))
    for key in keys:
        yield part, key
        yield from places(part[key])


def _change(random: Random, part: Any, key: Any, found: list[Place]) -> None:  # noqa: ANN401
    """Change the value at a place: to another value, to none, or to one from elsewhere."""
    value = part[key]
    if isinstance(value, int | float) and random.random() < 0.8:
        factors = (-1, 0, 1e3, 1e-3, 1e9, 1e-9, 1e30, 0.5, 2)
        part[key] = random.choice((random.choice(HOSTILE), value * random.choice(factors)))
    elif isinstance(value, str) and value and random.random() < 0.6:
        at = random.randrange(len(value))
        part[key] = random.choice((value[:at] + value[at + 1 :], f"{value}{value[at]}", "0", value))
    elif random.random() < 0.5:
        del part[key]
    else:
        other, step = random.choice(found)
        if isinstance(other, dict | list) and (isinstance(other, list) or step in other):
            there = isinstance(other, dict) or step < len(other)
            part[key] = deepcopy(other[step]) if there else 1
