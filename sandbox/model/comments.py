"""Comments in a level: keys that begin with `//`, in any object, which nothing reads."""

import json
from typing import Any

from sandbox.model.level import Level

SIGN = "//"
"""The beginning of a comment's key."""


def members(items: list[tuple[str, Any]]) -> dict[str, Any]:
    """Return the members of a JSON object without comments, for `json.loads`."""
    return {key: value for key, value in items if not key.startswith(SIGN)}


def without_comments(text: str) -> str:
    """Return a JSON text without its comments; one that has none is returned as it is."""
    if f'"{SIGN}' not in text:
        return text
    return json.dumps(json.loads(text, object_pairs_hook=members), ensure_ascii=False)


def read_level(text: str) -> Level:
    """Return the level of a text with valid parts, which may not fit each other.

    Raises `ValidationError` if a part is not valid.
    """
    return Level.model_validate_json(without_comments(text))
