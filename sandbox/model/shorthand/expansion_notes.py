"""Notes taken while shorthand is expanded: where parts were typed, mistakes, counts."""

from dataclasses import dataclass, field

from sandbox.model.json_positions import Path
from sandbox.model.level_parts import Fault
from sandbox.model.message import Message

MOST = 5_000_000
"""The most characters of an expanded level, about: as many as the largest file has."""

PLAIN = 8
"""How many characters a number, a bracket or a comma counts for."""


Moves = dict[Path, Path]
"""The new paths of moved parts, with their old paths."""


def followed(path: Path, moves: Moves) -> Path:
    """Return where something was before it moved, with what is around it or alone."""
    for length in range(len(path), 0, -1):
        if before := moves.get(path[:length]):
            return (*before, *path[length:])
    return path


class TooLongError(Exception):
    """What is written out would come to more than `MOST`; its argument is where that is typed."""


@dataclass(slots=True)
class Notes:
    """What is noted on the way.

    Attributes
    ----------
    typed
        Where parts were typed of what repeats, that do not stand at their own path in the text.
    placed
        Where parts of placed groups stand in those groups.
    faults
        The mistakes, at the paths of the text.
    left
        How many characters may still come.
    """

    typed: Moves = field(default_factory=dict)
    placed: Moves = field(default_factory=dict)
    faults: list[Fault] = field(default_factory=list)
    left: int = MOST

    def refuse(self, path: Path, rule: Message) -> None:
        """Note that something is wrong."""
        self.faults.append(Fault(path, rule))

    def charge(self, characters: int, path: Path) -> None:
        """Take what is to be written from what may be, before it is.

        Raises
        ------
        TooLongError
            If that is too much.
        """
        self.left -= characters + PLAIN
        if self.left < 0:
            raise TooLongError(path)
