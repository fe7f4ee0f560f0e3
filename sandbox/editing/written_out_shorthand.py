"""A level with its shorthand written out, so that every drawable part has its own text."""

import json

from sandbox.model import level_writing
from sandbox.model.shorthand.expansion import write_out


def expanded(text: str) -> str:
    """Return a level in which all repetitions and placed groups are written out.

    A text without shorthand, or with mistakes in it, is returned unchanged.
    """
    try:
        typed = json.loads(text)
        made = write_out(typed, text)
    except (ValueError, RecursionError):
        return text
    return text if made.data is typed or made.faults else level_writing.text(made.data)
