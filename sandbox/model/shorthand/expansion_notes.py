"""Notes on the expansion of shorthand: where parts were typed, mistakes, and sizes."""

from dataclasses import dataclass, field

from sandbox.model.json_positions import Path
from sandbox.model.level_parts import Fault
from sandbox.model.translatable_message import Message

MOST = 5_000_000
"""The most characters in an expanded level, about: as many as in the largest file."""

PLAIN = 8
"""The number of characters that a number, a bracket or a comma counts for."""


Moves = dict[Path, Path]
"""The old paths of moved parts, by their new paths."""


def followed(path: Path, moves: Moves) -> Path:
    """Return the path of a part before it moved, by itself or with an enclosing part."""
    for length in range(len(path), 0, -1):
        if before := moves.get(path[:length]):
            return (*before, *path[length:])
    return path


class TooLongError(Exception):
    """An expansion longer than `MOST`; its argument is the path where that was typed."""


@dataclass(slots=True)
class Notes:
    """Notes on an expansion."""

    typed: Moves = field(default_factory=dict)
    """The paths at which parts of repeated members were typed, if they differ from their own."""
    placed: Moves = field(default_factory=dict)
    """The paths in their groups of parts that were placed."""
    faults: list[Fault] = field(default_factory=list)
    """The mistakes, with their paths in the text."""
    left: int = MOST
    """The number of characters that may still be added."""

    def refuse(self, path: Path, rule: Message) -> None:
        """Note a mistake."""
        self.faults.append(Fault(path, rule))

    def charge(self, characters: int, path: Path) -> None:
        """Deduct a number of characters before they are added.

        Raises `TooLongError` if there are too many.
        """
        self.left -= characters + PLAIN
        if self.left < 0:
            raise TooLongError(path)
