"""The text that a level was read from, by which messages locate its parts."""

from collections.abc import Callable
from functools import cached_property

from sandbox.model import json_positions
from sandbox.model.errors import brief
from sandbox.model.json_positions import Path, Value


def _there(path: Path) -> Path:
    return path


class Origin:
    """A JSON text, and the positions of its values.

    All origins are equal, so that equal levels compare equal wherever they were read. `typed` maps
    a path in the level to that in the text, by default to itself.
    """

    def __init__(self, text: str, source: str, typed: Callable[[Path], Path] = _there) -> None:
        self.text = text
        self.source = source
        self.typed = typed

    def __eq__(self, other: object) -> bool:
        return True

    def __hash__(self) -> int:
        return 0

    @cached_property
    def values(self) -> dict[Path, Value]:
        """Every value of the text, by its path."""
        return {value.path: value for value in json_positions.values(self.text)}

    def has(self, path: Path) -> bool:
        """Whether the text has a value for a path of the level."""
        return self.typed(path) in self.values

    def nearest(self, path: Path) -> Value:
        """Return the value at a path or, if it is missing, what encloses it."""
        path = self.typed(path)
        while path not in self.values:
            path = path[:-1]
        return self.values[path]

    def place(self, path: Path) -> str:
        """Return the file, line, column and path of a part, for the beginning of a message."""
        line, column = json_positions.position(self.text, self.nearest(path).start)
        return f"{self.source}:{line}:{column}: {'.'.join(brief(str(step)) for step in path)}"
