"""A level with all of its shorthand expanded."""

import re
from typing import Any, NamedTuple

from sandbox.model.json_positions import Path
from sandbox.model.level_parts import Fault
from sandbox.model.shorthand.expansion_notes import MOST, Moves, Notes, TooLongError, followed
from sandbox.model.shorthand.groups import COPY, placed
from sandbox.model.shorthand.repeated_members import GROUPS, REPEAT, repeated
from sandbox.model.translatable_message import Message

_UNKNOWN = re.compile(r"unknown parameter '(\w+)'")

_KEYS = tuple(f'"{key}"' for key in (REPEAT, COPY, GROUPS))


class WrittenOut(NamedTuple):
    """A level with its shorthand expanded."""

    data: Any
    """The JSON content of the expanded level."""
    placed: Moves
    """Where parts of placed groups come from."""
    typed: Moves
    """Where repeated members come from."""
    faults: list[Fault]
    """The mistakes in the shorthand, with their paths in the text."""

    def path_in_text(self, path: Path) -> Path:
        """Return the path in the text of a part at a path in the data."""
        return followed(followed(path, self.placed), self.typed)

    def hinted(self, fault: Fault, typed: Any) -> Fault:  # noqa: ANN401 (whatever JSON holds)
        """Return a fault in the data; say how to type its unknown parameter if that is an index."""
        unknown = _UNKNOWN.match(fault.rule)
        if not (unknown and self.typed):
            return fault
        path, part = self.path_in_text(fault.path), typed
        for step in path[:-1]:
            if not _has(part, step):
                break
            part = part[step]
            if isinstance(part, dict) and unknown[1] in (part.get(REPEAT) or ()):
                rule = Message(
                    "unknown parameter '{name}'; the index is typed {{{name}}}", name=unknown[1]
                )
                return fault._replace(rule=rule)
        return fault


def _has(part: Any, step: str | int) -> bool:  # noqa: ANN401 (whatever JSON holds)
    return step in part if isinstance(part, dict) else isinstance(part, list)


def write_out(data: Any, text: str) -> WrittenOut:  # noqa: ANN401 (whatever JSON holds)
    """Return a level, parsed from a text, with its shorthand expanded; unchanged if it has none.

    Raises `RecursionError` if it is nested too deeply.
    """
    if not any(key in text for key in _KEYS):
        return WrittenOut(data, {}, {}, [])
    notes = Notes()
    try:
        made = repeated(data, notes)
        if not notes.faults:
            made = placed(made, notes)
    except TooLongError as error:
        rule = Message(
            "has more than {most:,} characters when it is expanded, the most allowed", most=MOST
        )
        return WrittenOut(data, {}, {}, [Fault(error.args[0], rule)])
    return WrittenOut(made, notes.placed, notes.typed, notes.faults)
