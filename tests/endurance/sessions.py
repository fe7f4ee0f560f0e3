"""The processes that one has started, by its session; Linux only."""

from contextlib import suppress
from pathlib import Path
from time import monotonic, sleep

LINGERS = 10.0  # s, within which what an ended process has started must end


def alive(session: int) -> list[int]:
    """Return the processes of a session that still run."""
    found = []
    for place in Path("/proc").glob("[0-9]*/stat"):
        with suppress(OSError):
            state, _, _, of, *_ = place.read_text().rpartition(")")[2].split()
            if int(of) == session and state != "Z":
                found.append(int(place.parent.name))
    return found


def lingering(session: int) -> list[int]:
    """Return which of them have not ended in time."""
    end = monotonic() + LINGERS
    while (left := alive(session)) and monotonic() < end:
        sleep(0.01)
    return left
