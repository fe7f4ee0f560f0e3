"""The unsaved run of a window, kept in a run file by which it survives if the window dies."""

from collections.abc import Sequence
from heapq import nlargest
from pathlib import Path
from time import perf_counter
from typing import NamedTuple

from sandbox.app.runs import run_file
from sandbox.app.runs.session import Session
from sandbox.model.atomic_file_writing import data_folder
from sandbox.model.errors import SandboxError
from sandbox.model.translatable_message import NOTHING, Message
from sandbox.model.unsaved_files import UnsavedFile, delete, leftovers

OFTEN = 1.0  # s, between two writings
SPARING = 50.0  # a run that takes long to write is written this many times as rarely

_NEVER = None, 0, 0


def folder() -> Path:
    """Return the folder of unsaved runs, which need not exist."""
    return data_folder() / "runs"


class LeftRun(NamedTuple):
    """A run left by a window that has ended."""

    file: Path
    when: float
    """s, since 1970, when it was written"""
    run: run_file.Run

    @property
    def title(self) -> str:
        """The title of the level."""
        return str(self.run.level.get("title", ""))

    def session(self) -> Session:
        """Return a session that goes to where the run was, in some frames if that takes long.

        Raises `SandboxError` if the level cannot be run, as another version of the program may do.
        """
        session = run_file.session_of(self.run, patient=False)
        session.repeats = self.run.repeats
        session.resume(self.run.actions, self.run.steps)
        return session


class RunRecovery:
    """Keeps a file of the run of a window."""

    def __init__(self) -> None:
        self._file = UnsavedFile(run_file.SUFFIX)
        self._kept: tuple[object, int, int] = _NEVER  # the run, its steps and actions when written
        self._wait = OFTEN  # s
        self._replaced: Path | None = None
        self._told = NOTHING

    def follow(self, session: Session, seconds: float) -> Message:
        """Let time pass [s], and write the run if it has changed; return why that fails, once."""
        self._wait -= seconds
        now = session.run, session.world.steps, len(session.all_actions)
        if self._wait > 0 or now == self._kept or session.sought is not None:
            return NOTHING
        begun, why = perf_counter(), NOTHING
        if session.world.steps or session.touched:
            why = self._file.write(folder(), run_file.file_content(run_file.run_of(session)))
        else:
            self._file.forget(folder())
        self._kept, self._wait = now, max(OFTEN, SPARING * (perf_counter() - begun))
        if self._replaced is not None and not why:
            delete(self._replaced)
            self._replaced = None
        new, self._told = why != self._told, why
        return why if new else NOTHING

    def replace(self, earlier: LeftRun) -> None:
        """Delete the file of an earlier window's run as soon as this window keeps the run."""
        self._kept, self._wait, self._replaced = _NEVER, 0.0, earlier.file

    def delete(self) -> None:
        """Delete the file, as the window is closed on purpose."""
        self._file.forget(folder())


def left_runs(most: int) -> Sequence[LeftRun]:
    """Return the runs left by windows that have ended, the newest ones, these first."""
    found = []
    for file in nlargest(most, leftovers(folder(), run_file.SUFFIX), key=_written):
        try:
            found.append(LeftRun(file, _written(file), run_file.read(file)))
        except SandboxError:  # a file of another program
            continue
    return found


def _written(file: Path) -> float:
    try:
        return file.lstat().st_mtime
    except OSError:  # another window has taken it up
        return 0.0
