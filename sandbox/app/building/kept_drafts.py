"""The drafts of a window, kept when another level is shown or the window closes."""

import os
from contextlib import suppress
from itertools import chain, count
from pathlib import Path

from sandbox.app.files import save_folder
from sandbox.editing.draft import Draft
from sandbox.editing.draft_recovery import Recoverable, Recovery, recoverable
from sandbox.model import level_catalog
from sandbox.model.atomic_file_writing import make_folder
from sandbox.model.errors import SandboxError
from sandbox.model.level import Level
from sandbox.model.translatable_message import NOTHING, Message

OFTEN = 1.0  # s, between two checks of drafts and files


class Drafts:
    """The drafts under edit, with or without a file."""

    def __init__(self) -> None:
        self._kept: dict[Draft, Recovery] = {}
        self.left: list[Recoverable] | None = None  # not searched yet
        """Unsaved drafts of earlier windows, the newest first; None before the first search."""
        self.outside = False
        """Whether another program has written the file of the draft that is shown."""
        self._mine: Draft | None = None  # to be written over the changes of another program
        self._since = OFTEN

    def of(self, level: Level) -> Draft:
        """Return the draft of a level, with its unsaved changes if it was edited before."""
        found = (draft for draft in reversed(self._kept) if _is_of(draft, level))
        draft = next(found, None) or self._read(level)
        if not draft.changed and draft.changed_outside():
            with suppress(SandboxError):  # a file with mistakes is offered instead
                draft.reload()
        self.add(draft)
        return draft

    @staticmethod
    def _read(level: Level) -> Draft:
        try:
            draft = Draft.open(Path(level.source))
        except SandboxError:
            return Draft.of(level.text)
        if draft.level is not None:
            return draft
        return Draft(level.text, draft.path, level.text.encode())  # the file has mistakes now

    def add(self, draft: Draft) -> None:
        """Keep a draft, and drop others that were not edited."""
        for other in [other for other in self._kept if other is not draft]:
            other.drop_caches()
            if not other.touched:
                self._kept.pop(other).forget()
        self._kept[draft] = self._kept.pop(draft, Recovery())  # the latest last
        self.outside, self._since = False, OFTEN

    def unsaved(self, besides: Draft) -> list[Draft]:
        """Return the unsaved drafts except one, the latest first."""
        return [draft for draft in reversed(self._kept) if draft.changed and draft is not besides]

    def follow(self, shown: Draft, seconds: float) -> bool:
        """Let time pass [s], and return whether the offers have changed."""
        self._since += seconds
        if self._since < OFTEN:
            return False
        before = self.outside, self.left
        self._since, self.outside = 0.0, shown is not self._mine and shown.changed_outside()
        if self.left is None:
            self.left = recoverable()
        self.keep()
        return before != (self.outside, self.left)

    def keep(self) -> Message:
        """Write recovery files for unsaved changes; return the reason if one cannot be written."""
        errors = [recovery.keep(draft) for draft, recovery in self._kept.items()]
        return next(filter(None, errors), NOTHING)

    def save(self, draft: Draft, path: Path | None, *, overwrite: bool) -> None:
        """Write a draft to its file, or to another.

        Raises `SandboxError` if it cannot be written, or would overwrite another file without
        consent.
        """
        mine = draft is self._mine and path in (None, draft.path)
        if path is not None and path.parent == save_folder.folder():
            make_folder(path.parent)
        draft.save(path, overwrite=overwrite or mine)
        self._mine, self.outside = None, False
        self.keep()

    @staticmethod
    def is_own(draft: Draft) -> bool:
        """Return whether a draft has a file that is not part of the project."""
        return draft.path is not None and not draft.path.is_relative_to(level_catalog.root())

    @classmethod
    def proposed(cls, draft: Draft, title: str) -> Path:
        """Return the file of a draft, or an unused name for one if it has none of its own."""
        if draft.path is not None and cls.is_own(draft):
            return draft.path
        stem, folder = save_folder.stem(title), save_folder.folder()
        names = chain((stem,), (f"{stem}-{number}" for number in count(2)))
        return next(path for name in names if not os.path.lexists(path := folder / f"{name}.json"))

    def forget(self, left: Recoverable) -> None:
        """Delete the unsaved draft of an earlier window."""
        left.forget()
        self.left = [each for each in self.left or () if each is not left]

    def keep_mine(self, draft: Draft) -> None:
        """Let the next save of a draft overwrite the changes of another program."""
        self._mine, self.outside = draft, False


def _is_of(draft: Draft, level: Level) -> bool:
    """Return whether a draft is of a level: of the same file, or, without one, of the same text."""
    if draft.path is None:
        return draft.text == level.text
    return draft.source == level.source
