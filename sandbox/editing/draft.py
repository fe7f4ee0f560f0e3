"""A draft: the text of a level under edit, the level that it loads as, its undo, and its file."""

import codecs
import os
from collections import deque
from dataclasses import dataclass
from pathlib import Path

from sandbox.model import templates
from sandbox.model.atomic_file_writing import write_atomically
from sandbox.model.errors import LevelError, Mistake, SandboxError
from sandbox.model.level import Level
from sandbox.model.loading import content, decoded, parse, read


@dataclass(frozen=True, slots=True)
class Step:
    """A step of undo, which stores only the piece of the text that was replaced."""

    description: str
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


def step(before: str, after: str, description: str) -> Step:
    """Return the step that leads from one text to another."""
    start = _common(before, after)
    most = min(len(before), len(after)) - start
    tail = _common(before[::-1][:most], after[::-1][:most])
    return Step(
        description, start, before[start : len(before) - tail], after[start : len(after) - tail]
    )


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


MOST_STEPS = 1000
"""The largest number of steps that can be undone."""

NEW = "<new level>"
"""The origin of a level without a file."""


class Draft:
    """A level under edit: its JSON text, which may have mistakes.

    `file_content` is the content of its file, if there is one.
    """

    def __init__(self, text: str, path: Path | None = None, file_content: bytes = b"") -> None:
        self.text = text
        """The present text."""
        self.path = path
        """The file; None if there is none yet."""
        self.saved = text
        """The saved text, or the initial one."""
        self._held = file_content
        self._done: deque[Step] = deque(maxlen=MOST_STEPS)
        self._undone: list[Step] = []
        self._merge: str | None = None
        self._loaded: tuple[str, Level | None, tuple[Mistake, ...]] | None = None

    @classmethod
    def empty(cls) -> "Draft":
        """Return a draft of the ground only."""
        return cls(read(templates.path("empty")))

    @classmethod
    def of(cls, text: str) -> "Draft":
        """Return a draft of the text of a level without a file of its own."""
        return cls(text)

    @classmethod
    def open(cls, path: Path) -> "Draft":
        """Return a draft of a file; raise `LevelError` if it cannot be read, or is not text."""
        file_content = content(path)
        return cls(decoded(file_content, str(path)), path, file_content)

    @property
    def source(self) -> str:
        """Its origin, for the start of messages."""
        return NEW if self.path is None else str(self.path)

    @property
    def level(self) -> Level | None:
        """The level that the text loads as; None if it does not load."""
        return self._now()[0]

    @property
    def mistakes(self) -> tuple[Mistake, ...]:
        """The mistakes because of which it does not load."""
        return self._now()[1]

    @property
    def changed(self) -> bool:
        """Whether the text differs from the saved or the initial one."""
        return self.text != self.saved

    @property
    def undo_description(self) -> str | None:
        """The description of the step that would be undone next; None if there is none."""
        return self._done[-1].description if self._done else None

    @property
    def redo_description(self) -> str | None:
        """The description of the step that would be redone next; None if there is none."""
        return self._undone[-1].description if self._undone else None

    @property
    def touched(self) -> bool:
        """Whether it has unsaved changes, or steps to undo or redo."""
        return self.changed or bool(self._done or self._undone)

    def drop_caches(self) -> None:
        """Drop everything that can be recomputed from the text."""
        self._loaded = None

    def change(self, text: str, description: str, merge: str | None = None) -> None:
        """Change the text, by one step of undo.

        Successive changes with the same key `merge` are one step, such as those of a drag.
        """
        if text == self.text:
            return
        before = self.text
        if merge is not None and merge == self._merge:
            before = self._done.pop().undone(before)
        if text != before:
            self._done.append(step(before, text, description))
        self._undone.clear()
        self.text, self._merge = text, merge if text != before else None

    def amend(self, text: str, description: str) -> None:
        """Change the text as a part of the last step, or by a step of its own if there is none."""
        if text != self.text:
            last = self._done.pop() if self._done else None
            before = last.undone(self.text) if last else self.text
            self._done.append(step(before, text, last.description if last else description))
            self._undone.clear()
            self.text, self._merge = text, None

    def undo(self) -> str | None:
        """Undo the last step, and return its description; None if there is none."""
        self._merge = None
        if not self._done:
            return None
        last = self._done.pop()
        self._undone.append(last)
        self.text = last.undone(self.text)
        return last.description

    def redo(self) -> str | None:
        """Redo the last undone step, and return its description; None if there is none."""
        self._merge = None
        if not self._undone:
            return None
        following = self._undone.pop()
        self._done.append(following)
        self.text = following.done(self.text)
        return following.description

    def save(self, path: Path | None = None, *, overwrite: bool = False) -> None:
        """Write the file; a draft without changes is written exactly as it was read.

        A path is that of the draft from now on. `overwrite` replaces changes by another program, or
        another file. Raises `SandboxError` if there is no file yet, it was changed since it was
        read, or it cannot be written.
        """
        target = path or self.path
        if target is None:
            raise SandboxError("the level has no file yet; choose where to save it")
        if not overwrite:
            self._refuse_to_overwrite(target)
        mark = codecs.BOM_UTF8 if self._held.startswith(codecs.BOM_UTF8) else b""
        file_content = mark + self.text.encode()
        write_atomically(target, file_content)
        self.path, self._held, self.saved = target, file_content, self.text
        self._merge = self._loaded = None

    def changed_outside(self) -> bool:
        """Return whether another program has written the file since it was read."""
        if self.path is None or not os.path.lexists(self.path):
            return False
        try:
            return content(self.path) != self._held
        except LevelError:  # now a folder, or not readable
            return True

    def reload(self) -> None:
        """Replace the text by the present content of the file, as an undoable step.

        Raises `SandboxError` if there is no file, or it cannot be read, or has mistakes.
        """
        if self.path is None:
            raise SandboxError("the level has no file yet; there is nothing to read again")
        file_content = content(self.path)
        text = decoded(file_content, str(self.path))
        parse(text, str(self.path))  # refuses a file with mistakes
        self.change(text, "read the file again")
        self._held, self.saved = file_content, text

    def _refuse_to_overwrite(self, target: Path) -> None:
        if target != self.path:
            if os.path.lexists(target):
                raise SandboxError("{target} already exists; choose another name", target=target)
        elif self.changed_outside():
            raise SandboxError(
                "{target} was changed outside since it was read; read it again, or overwrite it",
                target=target,
            )

    def _now(self) -> tuple[Level | None, tuple[Mistake, ...]]:
        if self._loaded is None or self._loaded[0] != self.text:
            try:
                self._loaded = self.text, parse(self.text, self.source), ()
            except LevelError as error:
                self._loaded = self.text, None, error.mistakes
        return self._loaded[1:]
