"""Grouping bodies, so that one click selects all of them, and ungrouping them.

A group is an item of `view.together`. No body is in two groups.
"""

from collections.abc import Collection

from sandbox.editing.inserted_value_layout import Json
from sandbox.editing.text_patches import put, remove
from sandbox.model.errors import SandboxError
from sandbox.model.level import Level

PLACE = ("view", "together")


def group(text: str, level: Level, names: Collection[str]) -> str:
    """Return a level in which bodies are one group; each leaves its former group.

    Raises `SandboxError` if they are fewer than two.
    """
    if len(names) < 2:
        raise SandboxError("select at least two bodies to group them")
    return _with(text, level, [*_left(level, names), [n for n in level.bodies if n in names]])


def ungroup(text: str, level: Level, names: Collection[str]) -> str:
    """Return a level without the groups of some bodies; raise `SandboxError` if there are none."""
    groups = [list(one) for one in level.view.together if not set(one) & set(names)]
    if len(groups) == len(level.view.together):
        raise SandboxError("none of these bodies is in a group")
    return _with(text, level, groups)


def group_of(level: Level, name: str) -> tuple[str, ...]:
    """Return the bodies that are selected with one: those of its group, or it alone."""
    return next((one for one in level.view.together if name in one), (name,))


def _left(level: Level, names: Collection[str]) -> list[list[str]]:
    """Return the groups that remain after some bodies leave; a single body is no group."""
    groups = ([name for name in one if name not in names] for one in level.view.together)
    return [one for one in groups if len(one) > 1]


def _with(text: str, level: Level, groups: list[list[str]]) -> str:
    """Return a level with exactly these groups."""
    if groups:
        together: list[Json] = [list[Json](one) for one in groups]
        return put(text, PLACE, together)
    return remove(text, PLACE) if level.view.together else text
