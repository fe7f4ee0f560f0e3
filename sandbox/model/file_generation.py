"""Generated files of the checkout."""

import sys
from collections.abc import Callable, Iterable
from pathlib import Path

from sandbox.model.errors import SandboxError


def generate(write: Callable[[], Iterable[Path]]) -> int:
    """Generate files, print their paths, and return the exit status."""
    try:
        for path in write():
            sys.stdout.write(f"{path}\n")
    except SandboxError as error:
        sys.stderr.write(f"{error}\n")
        return error.exit_status
    return 0
