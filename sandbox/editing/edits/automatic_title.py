"""The automatic title and summary of a level that started empty."""

import json
import re
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

from sandbox.editing.text_patches import put, remove
from sandbox.model import templates
from sandbox.model.loading import read


@cache
def _empty() -> Mapping[str, Any]:
    return json.loads(read(templates.path("empty")))


def is_untitled(document: Mapping[str, Any]) -> bool:
    """Return whether a level still has its automatic title."""
    return document.get("title") == _empty()["title"]


def entitled(text: str, title: str) -> str:
    """Return a level with an automatic title, unless it has a title of its own."""
    return put(text, ("title",), title) if title and is_untitled(json.loads(text)) else text


def entitled_by(text: str, path: Path) -> str:
    """Return a level named after its file, unless it has a title of its own."""
    words = re.sub(r"[-_\s]+", " ", path.stem).strip()
    return entitled(text, f"{words[:1].upper()}{words[1:]}")


def without_empty_summary(text: str) -> str:
    """Return a level without the summary that says that it is empty."""
    untrue = json.loads(text).get("summary") == _empty()["summary"]
    return remove(text, ("summary",)) if untrue else text
