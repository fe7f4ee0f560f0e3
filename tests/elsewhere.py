"""Python in a process of its own, which is not waited for without end."""

import os
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

PATIENCE = 300.0
"""s, many times what anything takes that the tests run elsewhere."""


def python(
    *arguments: object, environment: Mapping[str, str] = os.environ
) -> subprocess.CompletedProcess[str]:
    """Run Python in the project's folder, and return what came of it.

    Raises
    ------
    subprocess.TimeoutExpired
        If it has not ended after `PATIENCE`; then it is killed.
    """
    return subprocess.run(
        [sys.executable, *map(str, arguments)],
        env=environment, cwd=ROOT, capture_output=True, text=True, encoding="utf-8",
        timeout=PATIENCE, check=False,
    )  # fmt: skip


def move_home(folder: object) -> None:
    """Let this process keep a person's files, such as settings, in a folder."""
    for name in ("HOME", "XDG_DATA_HOME", "XDG_CACHE_HOME", "XDG_CONFIG_HOME"):
        os.environ[name] = str(folder)


def limited(seconds: float = 60.0) -> str:
    """Return a line of Python from which on a process lasts so long at the most [s].

    Whoever waits for what it writes waits no longer; it says where it was.
    """
    return f"import faulthandler; faulthandler.dump_traceback_later({seconds}, exit=True)\n"
