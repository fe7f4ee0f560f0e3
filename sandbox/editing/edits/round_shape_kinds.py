"""Changing the shape of a round body: a disc, a hoop, or a static arc."""

import re
from collections.abc import Mapping

from sandbox.editing.cleanup import without_meaning
from sandbox.editing.edits.edit_result import Made, new_name
from sandbox.editing.edits.fields import set_field
from sandbox.editing.json_layout import Json
from sandbox.editing.renaming import rename
from sandbox.editing.text_patches import put, value_at
from sandbox.model.level import Level

ROUND = ("disc", "hoop", "arc")
"""The shapes that are round."""

HALF_PIPE: Mapping[str, Json] = {"start": "180*deg", "end": "360*deg"}
"""The angles of a new arc, which is open at its top."""


def rounded(text: str, level: Level, name: str, kind: str) -> Made:
    """Return a level in which a round body is a disc, a hoop or an arc, of the same radius.

    A new arc is the lower half of the circle, and static. An arc that becomes a disc or hoop is
    made dynamic, with the mass of a drawn body. An automatic name, such as `disc1`, is replaced by
    one for the new shape. Raises `LevelError` if the loader refuses it.
    """
    path, before = ("bodies", name), level.bodies[name]
    if before.shape.type == kind:
        return Made(text, (name,))
    radius = value_at(text, (*path, "shape", "radius"))
    shape = {"type": kind, "radius": radius, **(HALF_PIPE if kind == "arc" else {})}
    changed = without_meaning(put(text, (*path, "shape"), shape))
    if kind == "arc" and before.type == "dynamic":
        changed = set_field(changed, (*path, "type"), "static")
    elif before.shape.type == "arc" and before.type == "static":
        changed = set_field(changed, (*path, "type"), "dynamic")
    if re.fullmatch(rf"{before.shape.type}\d+", name):
        called = new_name(kind, level)
        return Made(rename(changed, path, called), (called,))
    return Made(changed, (name,))
