"""Work that takes for ever, to be ended."""

import os
import sys
import time
from pathlib import Path

from sandbox.processes import spread


def linger(folder: str) -> None:
    """Say which process this is, and never come back."""
    (Path(folder) / str(os.getpid())).touch()
    time.sleep(600)


if __name__ == "__main__":
    from sandbox import interrupts

    interrupts.install()
    list(spread(linger, [sys.argv[1]] * 2, 2))
