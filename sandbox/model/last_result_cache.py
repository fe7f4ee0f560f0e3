"""What was found of the part of a level that was asked about last, and is asked again at once.

Parts never change, so that what is found of one holds as long as it is the very same.
"""

from collections.abc import Callable
from typing import TypeVar

Part = TypeVar("Part")
Found = TypeVar("Found")


def of_the_last(find: Callable[[Part], Found]) -> Callable[[Part], Found]:
    """Return the same function, which remembers what it returned for its last argument."""
    last: list[tuple[Part, Found]] = []

    def found(part: Part) -> Found:
        for known, answer in last[:1]:
            if known is part:
                return answer
        answer = find(part)
        last[:] = [(part, answer)]
        return answer

    return found
