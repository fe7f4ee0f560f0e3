"""Reading files, whatever is at their paths: those that somebody has named, and one's own."""

import os
import stat
from pathlib import Path

from sandbox.model.errors import SandboxError
from sandbox.model.translatable_message import Message


class UnreadableError(SandboxError):
    """A file that cannot be read; the message is the reason, to be put after the file's path."""


_AT_ONCE = getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)


def read_named(path: Path, largest: int) -> bytes:
    """Return the content of a file; links are followed.

    Nothing but an ordinary file is opened, since reading a pipe or a device might never end. Raises
    `UnreadableError` if there is no such file, it cannot be read, or is larger [bytes].
    """
    try:
        _check(path.stat(), largest)
        with open(os.open(path, os.O_RDONLY | _AT_ONCE), "rb") as file:
            _check(os.fstat(file.fileno()), largest)  # it may have been replaced
            return file.read()
    except (FileNotFoundError, NotADirectoryError):
        link = Message("is a link to a file that does not exist")
        reason = link if path.is_symlink() else Message("there is no such file")
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or str(error)
        reason = Message("cannot be read: {reason}", reason=why)
    raise UnreadableError(reason)


def read_ordinary(path: Path, largest: int) -> bytes | None:
    """Return the content of a file that the program has written; None if it is anything else.

    That is a link, a pipe or a device, or a file that is larger [bytes]. Raises `OSError` if the
    file does not exist, or cannot be read.
    """
    if path.is_symlink():  # for systems without O_NOFOLLOW
        return None
    plain = _AT_ONCE | getattr(os, "O_NOFOLLOW", 0)
    with open(os.open(path, os.O_RDONLY | plain), "rb") as file:
        status = os.fstat(file.fileno())
        if not stat.S_ISREG(status.st_mode) or status.st_size > largest:
            return None
        return file.read(largest)


def _check(status: os.stat_result, largest: int) -> None:
    """Refuse what is no ordinary file, or too large."""
    if stat.S_ISDIR(status.st_mode):
        raise UnreadableError("is a folder, not a file")
    if not stat.S_ISREG(status.st_mode):
        raise UnreadableError("is not an ordinary file")
    if status.st_size > largest:
        raise UnreadableError("the file is larger than {most} kB", most=largest // 1000)
