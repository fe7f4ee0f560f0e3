"""Where a person's own files are saved, and what they are called."""

import re
from pathlib import Path

import platformdirs


def folder() -> Path:
    """Return where the files go; it need not be there."""
    return platformdirs.user_documents_path() / "Mechanics sandbox"


def stem(title: str) -> str:
    """Return what a file about a level is called, from the level's title."""
    return re.sub(r"[^a-z0-9]+", "-", title.casefold()).strip("-") or "level"
