"""Adding events, which change the scene during a run."""

from sandbox.editing.cleanup_after_edit import accepted
from sandbox.editing.edits.edit_result import new_name
from sandbox.editing.inserted_value_layout import Json, plain
from sandbox.editing.text_patches import put
from sandbox.model.level import Level

SOON = 1.0
"""s, the time of a new event; at most half of the duration of a run."""


def cut(text: str, level: Level, joint: str) -> str:
    """Return a level in which an event cuts a joint; raise `LevelError` if it is refused."""
    return _with_event(text, level, "cut", joint)


def reverse(text: str, level: Level, surface: str) -> str:
    """Return a level with an event that reverses a surface; raise `LevelError` if it is refused."""
    return _with_event(text, level, "reverse", surface)


def wait_for_quantity(text: str, level: Level, event: str) -> str:
    """Return a level in which an event happens when a quantity crosses a value, to be filled in.

    Raises `LevelError` if the loader refuses it.
    """
    moving = [name for name, body in level.bodies.items() if body.type == "dynamic"]
    body = next(iter([*moving, *level.bodies]))
    at: dict[str, Json] = {
        "event": "crossing", "quantity": f"{body}.position.x", "value": 0, "direction": "either"
    }  # fmt: skip
    return accepted(put(text, ("events", event, "at"), at))


def is_cut(level: Level, joint: str) -> bool:
    """Return whether an event cuts a joint."""
    return any(joint in event.cut for event in level.events.values())


def _with_event(text: str, level: Level, action: str, name: str) -> str:
    at = plain(min(SOON, level.duration(level.defaults) / 2))
    event = new_name("event", level, level.events)
    return accepted(put(text, ("events", event), {"at": at, action: [name]}))
