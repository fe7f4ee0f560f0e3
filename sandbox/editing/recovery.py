"""Recovery files, by which unsaved drafts survive if the window dies.

Each draft has its own file in the user's data folder, written atomically. It is deleted when the
draft is saved or closed. The files left by a process that has ended can be recovered.
"""

import json
import os
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Annotated
from uuid import uuid4

from pydantic import BaseModel, Field, ValidationError

from sandbox.editing.draft import Draft
from sandbox.model.errors import SandboxError
from sandbox.model.file_writing import (
    data_folder,
    lives,
    make_folder,
    read_ordinary,
    write_atomically,
)
from sandbox.model.message import NOTHING, Message

LARGEST = 20_000_000
"""bytes, the largest file that is read; a larger one was not written by this program."""

LATEST = 32e9
"""s since 1970, the latest time, in the year 2984, before any system's calendar ends."""

_ENDING = ".draft.json"
_OPEN = set[str]()
"""The names of the files that this process keeps."""


def folder() -> Path:
    """Return the folder of the drafts, which need not exist."""
    return data_folder() / "drafts"


class Kept(BaseModel):
    """The content of a recovery file."""

    process: int
    """the id of the process that wrote it"""
    path: Path | None
    """the file of the draft, if it has one"""
    saved: str
    """the saved or the initial text"""
    text: str
    """the unsaved text"""
    when: Annotated[float, Field(ge=0, le=LATEST)]
    """s, since 1970"""


class Recovery:
    """Keeps a recovery file of one draft while it has unsaved changes."""

    def __init__(self) -> None:
        self._name = f"{uuid4().hex}{_ENDING}"
        self._text: str | None = None

    def keep(self, draft: Draft) -> Message:
        """Write the recovery file, and return the reason if that failed.

        A saved draft needs none, and an unchanged one is not written again, so that this may be
        called often.
        """
        if not draft.changed:
            self.forget()
        elif draft.text != self._text:
            try:
                make_folder(folder())
                _OPEN.add(self._name)
                write_atomically(folder() / self._name, _said(draft), follow=False)
            except SandboxError as error:
                return Message(
                    "unsaved changes cannot be stored, and are lost if this window crashes:"
                    " {error}",
                    error=error.message,
                )
            self._text = draft.text
        return NOTHING

    def forget(self) -> None:
        """Delete the recovery file, as the draft was saved, or closed on purpose."""
        with suppress(OSError):
            (folder() / self._name).unlink(missing_ok=True)
        self._text = None
        _OPEN.discard(self._name)


class Recoverable:
    """A draft left by a process that has ended."""

    def __init__(self, file: Path, kept: Kept) -> None:
        self._file = file
        self._kept = kept

    @property
    def path(self) -> Path | None:
        """The file of the draft, if it had one."""
        return self._kept.path

    @property
    def title(self) -> str:
        """The title of the level; empty if it has none."""
        try:
            said = json.loads(self._kept.text)
        except (ValueError, RecursionError):
            return ""
        return str(said.get("title", "")) if isinstance(said, dict) else ""

    @property
    def when(self) -> float:
        """The time at which it was written [s since 1970]."""
        return self._kept.when

    def draft(self) -> Draft:
        """Return the recovered draft, as an undoable change of the saved file.

        If the file has changed since, or is gone, the draft has no file, so that neither is lost.
        """
        kept = self._kept
        if kept.path is not None:
            with suppress(SandboxError):
                draft = Draft.open(kept.path)
                if draft.text == kept.saved:
                    draft.change(kept.text, "recover what was drawn")
                    return draft
        draft = Draft.of(kept.saved)
        draft.change(kept.text, "recover what was drawn")
        return draft

    def forget(self) -> None:
        """Delete the recovery file."""
        with suppress(OSError):
            self._file.unlink(missing_ok=True)


def recoverable() -> list[Recoverable]:
    """Return the drafts left by processes that have ended, the newest first."""
    return sorted(_left(), key=lambda one: -one.when)


def _left() -> Iterator[Recoverable]:
    for file in folder().glob(f"*{_ENDING}"):
        if file.name in _OPEN:
            continue
        with suppress(OSError, ValidationError):  # files of other programs are ignored
            kept = Kept.model_validate_json(read_ordinary(file, LARGEST) or b"")
            if kept.process == os.getpid() or not lives(kept.process):
                yield Recoverable(file, kept)


def _said(draft: Draft) -> str:
    return Kept(
        process=os.getpid(), path=draft.path, saved=draft.saved, text=draft.text, when=time.time()
    ).model_dump_json()
