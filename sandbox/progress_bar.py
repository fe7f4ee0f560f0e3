"""A progress bar on a terminal, and nothing elsewhere."""

from collections.abc import Iterable
from typing import TypeVar

from rich.console import Console
from rich.progress import track

T = TypeVar("T")


def consume(things: Iterable[T], label: str, total: int) -> list[T]:
    """Return the items of an iterable, with progress on the terminal while they are computed.

    The work is done by the iterable, so that an error in it ends the bar at once.
    """
    console = Console(stderr=True)
    hidden = not console.is_terminal
    return list(track(things, label, total, console=console, transient=True, disable=hidden))
