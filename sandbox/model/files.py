"""Writing files whole or not at all."""

import os
from contextlib import suppress
from pathlib import Path
from uuid import uuid4

from sandbox.model.errors import SandboxError


def write_atomically(path: Path, data: str | bytes) -> None:
    """Write a file beside its place, then move it there: nobody ever finds half of it.

    Raises
    ------
    SandboxError
        If it cannot be written; what was there before is then still there.
    """
    check_writable(path)
    target = Path(os.path.realpath(path))  # a link stays a link
    beside = target.with_name(f".{uuid4().hex}.part")
    try:
        with beside.open("xb") as file:
            file.write(data.encode() if isinstance(data, str) else data)
        beside.replace(target)
    except BaseException as error:
        with suppress(OSError):
            beside.unlink(missing_ok=True)
        if isinstance(error, OSError):
            raise _refusal(path, error.strerror or str(error)) from error
        raise


def check_writable(path: Path) -> None:
    """Refuse a path at which no file can be written, as far as can be told without writing one.

    Raises
    ------
    SandboxError
        If the path is taken by something else, or its folder is missing or read-only.
    """
    target = os.path.realpath(path)
    folder = os.path.dirname(target)
    if os.path.isdir(target):
        raise _refusal(path, "it is a folder")
    if os.path.exists(target) and not os.path.isfile(target):
        raise _refusal(path, "it is not an ordinary file")
    if not os.path.exists(folder):
        raise _refusal(path, f"there is no folder {path.parent}")
    if not os.path.isdir(folder):
        raise _refusal(path, f"{path.parent} is not a folder")
    if not os.access(folder, os.W_OK | os.X_OK):
        raise _refusal(path, f"the folder {path.parent} is read-only")
    if os.path.exists(target) and not os.access(target, os.W_OK):
        raise _refusal(path, "it is there and read-only")


def _refusal(path: Path, reason: str) -> SandboxError:
    return SandboxError(f"cannot write {path}: {reason}")
