"""Files of the checkout that a program writes."""

import sys
from collections.abc import Callable, Iterable
from pathlib import Path

from sandbox.model.errors import SandboxError

FAILED = 2


def generate(write: Callable[[], Iterable[Path]]) -> int:
    """Write files, print their paths, and return the exit status."""
    try:
        for path in write():
            sys.stdout.write(f"{path}\n")
    except SandboxError as error:
        sys.stderr.write(f"{error}\n")
        return FAILED
    return 0
