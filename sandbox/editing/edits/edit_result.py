"""The result of an edit: the new text, and the name of the new part."""

from collections.abc import Container
from itertools import count
from typing import NamedTuple

from sandbox.model.level import Level


class Made(NamedTuple):
    """A text with something new in it."""

    text: str
    names: tuple[str, ...]
    """Of the bodies or the joint that were made."""

    @property
    def name(self) -> str:
        """The name, where there is but one."""
        (name,) = self.names
        return name


def new_name(kind: str, level: Level, besides: Container[str] = ()) -> str:
    """Return the first of `box1`, `box2` and so on that nothing in a level is called."""
    return next(
        name
        for number in count(1)
        if not taken(name := f"{kind}{number}", level) and name not in besides
    )


def taken(name: str, level: Level) -> bool:
    """Whether a body or a joint of a level is called that."""
    return name in level.bodies or name in level.joints
