"""The steps of undo: each keeps only what it changed."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Step:
    """What a change made of a text: at one place, something else.

    Attributes
    ----------
    said
        The edit, in words.
    start
        Where in the text.
    old, new
        What stood there, and what stands there now.
    """

    said: str
    start: int
    old: str
    new: str

    def undone(self, text: str) -> str:
        """Return the text before it, from that after it."""
        return text[: self.start] + self.old + text[self.start + len(self.new) :]

    def done(self, text: str) -> str:
        """Return the text after it, from that before it."""
        return text[: self.start] + self.new + text[self.start + len(self.old) :]


def step(before: str, after: str, said: str) -> Step:
    """Return the step that leads from one text to another."""
    start = _common(before, after)
    most = min(len(before), len(after)) - start
    tail = _common(before[::-1][:most], after[::-1][:most])
    return Step(said, start, before[start : len(before) - tail], after[start : len(after) - tail])


def _common(one: str, other: str) -> int:
    """Return how many characters two texts have in common at their beginning."""
    low, high = 0, min(len(one), len(other))
    while low < high:
        middle = (low + high + 1) // 2
        if one[low:middle] == other[low:middle]:
            low = middle
        else:
            high = middle - 1
    return low
