"""Work that takes for ever, so that it must be ended, and a check whether it has."""

import os
import sys
import time
from pathlib import Path

from sandbox.parallel_processes import spread


def linger(folder: str) -> None:
    """Leave the process ID as the name of a file in a folder, and never finish."""
    (Path(folder) / str(os.getpid())).touch()
    time.sleep(600)


def alive(pid: int) -> bool:
    """Return whether a process is running; an ended one may still be a zombie."""
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    try:
        status = Path(f"/proc/{pid}/stat").read_text()
    except OSError:  # it has just gone, or there are no such files here
        return not Path("/proc/self/stat").exists()
    return status.rpartition(")")[2].split()[0] != "Z"


if __name__ == "__main__":
    from sandbox import interrupts

    interrupts.install()
    list(spread(linger, [sys.argv[1]] * 2, 2))
