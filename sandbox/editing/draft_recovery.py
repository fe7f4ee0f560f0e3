"""Recovery files, by which unsaved drafts survive if the window dies."""

import json
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Annotated

from pydantic import BaseModel, Field, ValidationError

from sandbox.editing.draft import Draft
from sandbox.model.atomic_file_writing import data_folder
from sandbox.model.errors import SandboxError
from sandbox.model.file_reading import read_ordinary
from sandbox.model.translatable_message import NOTHING, Message
from sandbox.model.unsaved_files import UnsavedFile, delete, leftovers

LARGEST = 20_000_000
"""bytes, the largest file that is read; a larger one was not written by this program."""

LATEST = 32e9
"""s since 1970, the latest time, in the year 2984, before any system's calendar ends."""

_ENDING = ".draft.json"


def folder() -> Path:
    """Return the folder of the drafts, which need not exist."""
    return data_folder() / "drafts"


class RecoveryFile(BaseModel):
    """The content of a recovery file."""

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
        self._file = UnsavedFile(_ENDING)
        self._text: str | None = None

    def keep(self, draft: Draft) -> Message:
        """Write the recovery file, and return the reason if that failed.

        A saved draft needs none, and an unchanged one is not written again, so that this may be
        called often.
        """
        if not draft.changed:
            self.forget()
        elif draft.text != self._text:
            if why := self._file.write(folder(), _said(draft)):
                return why
            self._text = draft.text
        return NOTHING

    def forget(self) -> None:
        """Delete the recovery file, as the draft was saved, or closed on purpose."""
        self._file.forget(folder())
        self._text = None


class Recoverable:
    """A draft left by a process that has ended."""

    def __init__(self, file: Path, recovery: RecoveryFile) -> None:
        self._file = file
        self._kept = recovery

    @property
    def path(self) -> Path | None:
        """The file of the draft, if it had one."""
        return self._kept.path

    @property
    def title(self) -> str:
        """The title of the level; empty if it has none."""
        try:
            document = json.loads(self._kept.text)
        except (ValueError, RecursionError):
            return ""
        return str(document.get("title", "")) if isinstance(document, dict) else ""

    @property
    def when(self) -> float:
        """The time at which it was written [s since 1970]."""
        return self._kept.when

    def draft(self) -> Draft:
        """Return the recovered draft, as an undoable change of the saved file.

        If the file has changed since, or is gone, the draft has no file, so that neither is lost.
        """
        recovery = self._kept
        if recovery.path is not None:
            with suppress(SandboxError):
                draft = Draft.open(recovery.path)
                if draft.text == recovery.saved:
                    draft.change(recovery.text, "recover what was drawn")
                    return draft
        draft = Draft.of(recovery.saved)
        draft.change(recovery.text, "recover what was drawn")
        return draft

    def forget(self) -> None:
        """Delete the recovery file."""
        delete(self._file)


def recoverable() -> list[Recoverable]:
    """Return the drafts left by processes that have ended, the newest first."""
    return sorted(_left(), key=lambda one: -one.when)


def _left() -> Iterator[Recoverable]:
    for file in leftovers(folder(), _ENDING):
        with suppress(OSError, ValidationError):  # files of other programs are ignored
            yield Recoverable(
                file, RecoveryFile.model_validate_json(read_ordinary(file, LARGEST) or b"")
            )


def _said(draft: Draft) -> str:
    return RecoveryFile(
        path=draft.path, saved=draft.saved, text=draft.text, when=time.time()
    ).model_dump_json()
