"""Writing files atomically: the old content or the new one, never a part."""

import errno
import os
import platform
import re
import stat
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from hashlib import sha256
from pathlib import Path
from uuid import uuid4

import platformdirs

from sandbox.model.errors import MisuseError, SandboxError
from sandbox.model.translatable_message import Message


class TakenError(MisuseError):
    """The path for a new file already exists."""


_FULL = (errno.ENOSPC, errno.EDQUOT)
_PART = re.compile(r"\.([0-9a-f]{8})-(\d+)-[0-9a-f]{32}\.part")
"""The name of an unfinished file: the machine, the process, and a number."""


def data_folder() -> Path:
    """Return the folder of a person's progress and unfinished work, which may not exist."""
    return platformdirs.user_data_path("mechanics-sandbox")


def write_atomically(
    path: Path, data: str | bytes, *, follow: bool = True, new: bool = False
) -> None:
    """Write a file under another name, then rename it, so that nobody ever reads half of it.

    Its permissions are kept, and its owner where that is allowed. Unfinished files that a killed
    process has left in the folder are removed. If `follow`, a link of that name is written through;
    otherwise the file replaces the link. If `new`, the path must be free, even of a link. Raises
    `TakenError` if the path is not free, but must be. Raises `SandboxError` if it cannot be
    written; the previous content is then unchanged.
    """
    if new and os.path.lexists(path):
        raise _taken(path)
    check_writable(path, follow=follow)
    target = Path(os.path.realpath(path)) if follow else path
    _sweep(target.parent)
    beside = target.with_name(f".{_machine()}-{os.getpid()}-{uuid4().hex}.part")
    try:
        with beside.open("xb") as file:
            file.write(data.encode() if isinstance(data, str) else data)
        _keep_access(target, beside)
        (_link if new else Path.replace)(beside, path if new else target)
    except BaseException as error:
        with suppress(OSError):
            beside.unlink(missing_ok=True)
        if new and isinstance(error, FileExistsError):
            raise _taken(path) from None
        if isinstance(error, OSError):
            raise SandboxError(_unwritable(path, error.strerror or str(error))) from error
        raise


def _keep_access(old: Path, made: Path) -> None:
    """Give a file the owner and permissions of the file that it replaces, if there is one.

    A user who may not give files away remains the owner. Bits that run a program as its owner are
    cleared, as by any write.
    """
    try:
        before = old.lstat()
    except FileNotFoundError:
        return
    if not stat.S_ISREG(before.st_mode):  # a replaced link has no permissions of its own
        return
    if hasattr(os, "chown") and (before.st_uid, before.st_gid) != _owner(made):
        with suppress(OSError):
            os.chown(made, before.st_uid, before.st_gid)
    if (mode := stat.S_IMODE(before.st_mode) & 0o777) != stat.S_IMODE(made.stat().st_mode):
        made.chmod(mode)


def _owner(path: Path) -> tuple[int, int]:
    status = path.stat()
    return status.st_uid, status.st_gid


def _link(made: Path, place: Path) -> None:
    """Move a file to a free path; the first process to do so wins.

    On a file system without links it only checks beforehand that the path is free.
    """
    try:
        os.link(made, place, follow_symlinks=False)
    except FileExistsError:
        raise
    except OSError:
        if os.path.lexists(place):
            raise FileExistsError from None
        made.replace(place)
    else:
        made.unlink()


def without_links(path: Path) -> Path:
    """Return a path with its links followed, as far as they lead anywhere.

    `Path.resolve` raises an error if they lead in a circle.
    """
    return Path(os.path.realpath(path))


def _sweep(folder: Path) -> None:
    """Remove the unfinished files in a folder that were left by processes that have ended."""
    with suppress(OSError), os.scandir(folder) as entries:
        for entry in entries:
            found = _PART.fullmatch(entry.name)
            if found and found[1] == _machine() and not lives(int(found[2])):
                with suppress(OSError):
                    os.unlink(entry.path)


def _machine() -> str:
    return sha256(platform.node().encode()).hexdigest()[:8]


def lives(process: int) -> bool:
    """Whether a process exists on this machine, as far as can be found out without ending it."""
    if os.name == "nt":  # a signal would end it; its open file cannot be removed anyway
        return process == os.getpid()
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except (OSError, OverflowError):
        return True
    return True


def check_writable(path: Path, *, follow: bool = True) -> None:
    """Refuse a path that cannot be written, as far as can be found out without writing.

    For `follow` see `write_atomically`. Raises `MisuseError` if the path is not a file, or its
    folder is missing or read-only.
    """
    try:
        target = os.path.realpath(path)
    except FileNotFoundError:  # part of the path is a file
        raise _refusal(path, Message("the working folder no longer exists")) from None
    folder = os.path.dirname(target)
    _check_kind(path, target, follow=follow)
    shown = folder if os.path.islink(path) else path.parent
    if not os.path.exists(folder):
        raise _refusal(path, Message("there is no folder {folder}", folder=shown))
    if not os.path.isdir(folder):
        raise _refusal(path, Message("{folder} is not a folder", folder=shown))
    if not os.access(folder, os.W_OK | os.X_OK):
        raise _refusal(path, Message("the folder {folder} is read-only", folder=shown))
    if os.path.exists(target) and not os.access(target, os.W_OK):
        raise _refusal(path, Message("it exists and is read-only"))


def _check_kind(path: Path, target: str, *, follow: bool) -> None:
    """Refuse a path, which leads to a target, if something else than a file is there."""
    if os.path.isdir(target):
        raise _refusal(path, Message("it is a folder"))
    if os.path.exists(path) and not os.path.isfile(path):  # a pipe's link leads to no path
        raise _refusal(path, Message("it is not an ordinary file"))
    if follow and os.path.islink(target):  # the end of a chain of links is none
        raise _refusal(path, Message("its links lead in a circle"))


def make_folder(folder: Path) -> None:
    """Make a folder if it is missing, and refuse it if no file can be written in it.

    Raises `MisuseError` if there cannot be such a folder, or it is read-only. Raises `SandboxError`
    if there is no space for it.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        reason = Message("it is a file") if folder.is_file() else error.strerror
        kind = SandboxError if error.errno in _FULL else MisuseError
        raise kind(
            Message("cannot make the folder {folder}: {reason}", folder=folder, reason=reason)
        ) from error
    if not os.access(folder, os.W_OK | os.X_OK):
        raise MisuseError("cannot write into the folder {folder}: it is read-only", folder=folder)


@contextmanager
def folder_of_files(folder: Path) -> Iterator[None]:
    """Make a folder for the files that are written within; remove it if it is still empty then.

    Raises what `make_folder` raises.
    """
    made = [each for each in (folder, *folder.parents) if not each.exists()]
    try:
        make_folder(folder)
        yield
    finally:
        with suppress(OSError):  # it holds files
            for each in made:
                each.rmdir()


def _taken(path: Path) -> TakenError:
    return TakenError("{path} already exists; nothing is overwritten", path=path)


def _refusal(path: Path, reason: str) -> MisuseError:
    return MisuseError(_unwritable(path, reason))


def _unwritable(path: Path, reason: str) -> Message:
    return Message("cannot write {path}: {reason}", path=path, reason=reason)


def generate(write: Callable[[], Iterable[Path]]) -> int:
    """Generate files, print their paths, and return the exit status."""
    try:
        for path in write():
            sys.stdout.write(f"{path}\n")
    except SandboxError as error:
        sys.stderr.write(f"{error}\n")
        return error.exit_status
    return 0
