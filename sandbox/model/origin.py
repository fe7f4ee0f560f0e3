"""The text that a level was read from, so that messages can say where a part stands."""

from collections.abc import Callable
from functools import cached_property

from sandbox.model import json_positions
from sandbox.model.errors import brief
from sandbox.model.json_positions import Path, Value


def _there(path: Path) -> Path:
    return path


class Origin:
    """A JSON text, and where everything in it stands.

    All are equal: levels that say the same are, wherever they were read.

    Parameters
    ----------
    text
        The JSON.
    source
        The origin of the text, for the messages.
    typed
        Where in the text a part was typed, by its path in the level; the same if left out.
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
        """Whether something was typed for a path of the level."""
        return self.typed(path) in self.values

    def nearest(self, path: Path) -> Value:
        """Return what stands at a path, or what is around it if it is missing."""
        path = self.typed(path)
        while path not in self.values:
            path = path[:-1]
        return self.values[path]

    def place(self, path: Path) -> str:
        """Return the file, line and column of a part, and its path, as messages begin."""
        line, column = json_positions.position(self.text, self.nearest(path).start)
        return f"{self.source}:{line}:{column}: {'.'.join(brief(str(step)) for step in path)}"
