"""A cache of a function's last result, for parts of a level that are asked about repeatedly.

Parts never change, so a result holds for as long as the part is the same object.
"""

from collections.abc import Callable
from typing import TypeVar

Part = TypeVar("Part")
Found = TypeVar("Found")


def of_the_last(find: Callable[[Part], Found]) -> Callable[[Part], Found]:
    """Return the same function, which remembers the result for its last argument."""
    last: list[tuple[Part, Found]] = []

    def found(part: Part) -> Found:
        for known, answer in last[:1]:
            if known is part:
                return answer
        answer = find(part)
        last[:] = [(part, answer)]
        return answer

    return found
