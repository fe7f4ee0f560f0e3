"""The folder and the names of files that the user saves."""

import re
from pathlib import Path

import platformdirs


def folder() -> Path:
    """Return the folder for saved files; it need not exist."""
    return platformdirs.user_documents_path() / "Mechanics sandbox"


def stem(title: str) -> str:
    """Return the name of a file about a level, without suffix, from the level's title."""
    return re.sub(r"[^a-z0-9]+", "-", title.casefold()).strip("-") or "level"
