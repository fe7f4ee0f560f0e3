"""The result of an edit: the new text, and the names of the new parts."""

from collections.abc import Container
from itertools import count
from typing import NamedTuple

from sandbox.model.level import Level


class EditResult(NamedTuple):
    """A text with new parts."""

    text: str
    names: tuple[str, ...]
    """The names of the new bodies, or of the new joint."""

    @property
    def name(self) -> str:
        """The name, if there is only one."""
        (name,) = self.names
        return name


def new_name(kind: str, level: Level, besides: Container[str] = ()) -> str:
    """Return the first of `box1`, `box2` and so on that is free in a level."""
    return next(
        name
        for number in count(1)
        if not taken(name := f"{kind}{number}", level) and name not in besides
    )


def taken(name: str, level: Level) -> bool:
    """Return whether a body or a joint of a level has a name."""
    return name in level.bodies or name in level.joints
