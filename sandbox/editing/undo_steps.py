"""The steps of undo, each of which stores only the difference."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Step:
    """One change of a text: a piece of it was replaced."""

    said: str
    """The description of the edit."""
    start: int
    """The index of the piece in the text."""
    old: str
    new: str
    """The piece before and after the change."""

    def undone(self, text: str) -> str:
        """Return the text before the change, given that after it."""
        return text[: self.start] + self.old + text[self.start + len(self.new) :]

    def done(self, text: str) -> str:
        """Return the text after the change, given that before it."""
        return text[: self.start] + self.new + text[self.start + len(self.old) :]


def step(before: str, after: str, said: str) -> Step:
    """Return the step that leads from one text to another."""
    start = _common(before, after)
    most = min(len(before), len(after)) - start
    tail = _common(before[::-1][:most], after[::-1][:most])
    return Step(said, start, before[start : len(before) - tail], after[start : len(after) - tail])


def _common(one: str, other: str) -> int:
    """Return the length of the common prefix of two texts."""
    low, high = 0, min(len(one), len(other))
    while low < high:
        middle = (low + high + 1) // 2
        if one[low:middle] == other[low:middle]:
            low = middle
        else:
            high = middle - 1
    return low
