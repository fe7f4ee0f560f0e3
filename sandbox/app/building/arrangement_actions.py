"""Actions on several bodies at once: align, spread, mirror, lay flat."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial

from sandbox.app.building.button_action import ButtonAction
from sandbox.app.building.edited_level import EditedLevel
from sandbox.app.words.language import later, say
from sandbox.editing.edits import moving_and_aligning
from sandbox.editing.edits.mirroring import mirror
from sandbox.editing.edits.moving_and_aligning import Side
from sandbox.editing.edits.rope_wrapping import drum_of, wrap
from sandbox.editing.snapping import flat_turn, snap_body
from sandbox.model.errors import SandboxError
from sandbox.model.level import Level
from sandbox.model.loading import parse

NEAR = 80.0
"""px, the largest distance of a surface on which a body is laid flat."""

SIDES: Mapping[str, Side] = {
    later("Left"): "left",
    later("Right"): "right",
    later("Top"): "top",
    later("Bottom"): "bottom",
    later("Above"): "center-x",
    later("In line"): "center-y",
}
"""The sides at which bodies are aligned, by the captions of the buttons."""


def arrangements(work: EditedLevel) -> list[ButtonAction]:
    """Return the actions that arrange the selected bodies."""
    names = work.selected_bodies
    if not names:
        return []
    aligned = say("align these bodies so")
    across, upwards = say("the same gaps, from left to right"), say("the same gaps, upwards")
    several = [
        *(
            _arranging(work, say(caption), aligned, moving_and_aligning.align, side=side)
            for caption, side in SIDES.items()
        ),
        _arranging(work, say("Spread across"), across, moving_and_aligning.distribute, axis="x"),
        _arranging(work, say("Spread upwards"), upwards, moving_and_aligning.distribute, axis="y"),
    ]
    return [
        *_rope(work, names),
        *_grouping(work, names),
        *(several if len(names) > 1 else [_flat(work)]),
        _arranging(work, say("Mirror across"), say("left becomes right"), mirror, axis="x"),
        _arranging(work, say("Mirror upright"), say("top becomes bottom"), mirror, axis="y"),
    ]


def _rope(work: EditedLevel, names: Sequence[str]) -> list[ButtonAction]:
    """Return the action that lays a rope over a disc, if it is selected with two other bodies."""
    level = work.draft.level
    if level is None or drum_of(level, names) is None:
        return []
    tip = say("knots joined by rods, from one body over the disc to the other")
    caption = say("lay a rope over the disc")
    lay = partial(work.add_parts, caption, lambda text, level: wrap(text, level, names))
    return [ButtonAction(say("Rope over the disc"), tip, lay)]


def _grouping(work: EditedLevel, names: Sequence[str]) -> list[ButtonAction]:
    """Return the actions that group bodies, and ungroup the groups that they are in."""
    found = [work.with_group(("bodies", name)) for name in names]
    grouped = any(len(group) > 1 for group in found)
    one = grouped and {part[1] for part in found[0]} == set(names)
    ungroup = ButtonAction(
        say("Ungroup"), say("select each by itself (Ctrl Shift G)"), work.ungroup
    )
    if one or len(names) < 2:
        return [ungroup] if grouped else []
    group = ButtonAction(say("Group"), say("select them together (Ctrl G)"), work.group)
    return [group, *([ungroup] if grouped else [])]


def _flat(work: EditedLevel) -> ButtonAction:
    tip = say("turn and move it until one side lies on the nearest surface")
    return _arranging(work, say("Lay flat"), tip, _lay_flat, reach=NEAR / work.camera.scale)


def _lay_flat(text: str, level: Level, names: Sequence[str], reach: float) -> str:
    (name,) = names
    edited = moving_and_aligning.turn(text, level, names, flat_turn(level, name, reach))
    lying = parse(edited)
    found = snap_body(lying, names, (0.0, 0.0), reach)
    if found.kind != "contact":
        raise SandboxError("nothing that '{name}' could lie on is near; move it closer", name=name)
    return moving_and_aligning.move(edited, lying, names, found.point)


def _arranging(
    work: EditedLevel, caption: str, tip: str, edit: Callable[..., str], **how: object
) -> ButtonAction:
    """Return the action that edits the selected bodies in some way."""
    return ButtonAction(
        caption,
        tip,
        partial(work.change, caption, partial(edit, names=work.selected_bodies, **how)),
    )
