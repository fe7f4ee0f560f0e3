"""The mark of fields that hold prose, for translation.

Code that translates a level, or reads it aloud, finds its texts by this mark.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated

from sandbox.model.base import Model
from sandbox.model.field_marks import marked
from sandbox.model.json_positions import Path


@dataclass(frozen=True, slots=True)
class Words:
    """Marks a text for people, which no formula or name uses."""


Prose = Annotated[str, Words()]
"""Text for people."""


def prose(part: Model) -> Iterator[tuple[Path, str]]:
    """Yield all texts in a part of a level that are not empty, with their paths."""
    return ((path, text) for path, text, _ in marked(part, Words) if text)
