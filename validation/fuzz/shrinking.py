"""The smallest part of a level that still fails."""

from collections.abc import Callable
from copy import deepcopy
from typing import Any

from validation.fuzz.mutation import places

TRIES = 120


def shrunk(data: dict[str, Any], wrong: Callable[[dict[str, Any]], bool]) -> dict[str, Any]:
    """Return a failing level without everything that the failure does not need.

    `wrong` tells whether another level fails in the same way.
    """
    tries, number = 0, 0
    while tries < TRIES:
        smaller = deepcopy(data)
        found = list(places(smaller))
        if number >= len(found):
            return data
        part, key = found[number]
        del part[key]
        tries += 1
        if wrong(smaller):
            data = smaller
        else:
            number += 1
    return data
