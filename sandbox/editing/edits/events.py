"""Adding events, which change on the way what acts."""

from sandbox.editing.cleanup import accepted
from sandbox.editing.edits.edit_result import new_name
from sandbox.editing.layout import plain
from sandbox.editing.text_patches import put
from sandbox.model.level import Level

SOON = 1.0
"""s, when a new event happens; half-way through a run that is short."""


def cut(text: str, level: Level, joint: str) -> str:
    """Return a level in which a joint lets go on the way.

    Raises
    ------
    LevelError
        If the loader refuses it.
    """
    at = plain(min(SOON, level.duration(level.defaults) / 2))
    name = new_name("event", level, level.events)
    return accepted(put(text, ("events", name), {"at": at, "cut": [joint]}))


def is_cut(level: Level, joint: str) -> bool:
    """Whether an event lets a joint go."""
    return any(joint in event.cut for event in level.events.values())
