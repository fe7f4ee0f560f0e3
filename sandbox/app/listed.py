"""What is known of a level before it is opened."""

from pathlib import Path
from typing import NamedTuple


class Entry(NamedTuple):
    """A level that can be chosen: its file, its chapter, what it is called, and is found by."""

    path: Path
    chapter: str
    title: str
    words: str
    summary: str = ""
