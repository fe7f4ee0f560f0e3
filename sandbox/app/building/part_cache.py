"""A cache of parsed parts: a part whose text has not changed is not read again."""

from collections.abc import Callable
from typing import Generic, TypeVar

from pydantic import ValidationError

Part = TypeVar("Part")


class Readings(Generic[Part]):
    """Reads parts, and reuses those that are unchanged in the next scene.

    `read` makes a part from its JSON text, or raises a `ValidationError`.
    """

    def __init__(self, read: Callable[[str], Part]) -> None:
        self._read = read
        self._now: dict[str, Part | None] = {}
        self._before: dict[str, Part | None] = {}

    def __len__(self) -> int:
        return len(self._now.keys() | self._before.keys())

    def begin(self) -> None:
        """Begin the next scene, after which parts that are not in it are dropped."""
        self._before, self._now = self._now, {}

    def __call__(self, text: str) -> Part | None:
        """Return the part; None if it cannot be read."""
        if text not in self._now:
            known = text in self._before
            self._now[text] = self._before[text] if known else self._made(text)
        return self._now[text]

    def _made(self, text: str) -> Part | None:
        try:
            return self._read(text)
        except ValidationError:
            return None
