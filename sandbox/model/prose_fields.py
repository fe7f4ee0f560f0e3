"""The mark of fields that hold prose, for translation.

Whoever translates a level, or reads it aloud, finds from here what there is to say.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated

from sandbox.model.base import Model
from sandbox.model.field_marks import marked
from sandbox.model.json_positions import Path


@dataclass(frozen=True, slots=True)
class Words:
    """Marks a text that a person reads, and no formula or name uses."""


Prose = Annotated[str, Words()]
"""Words for a person."""


def prose(part: Model) -> Iterator[tuple[Path, str]]:
    """Yield all the words of a part of a level, and where they stand; what is empty has none."""
    return ((path, text) for path, text, _ in marked(part, Words) if text)
