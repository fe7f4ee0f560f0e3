"""Moving, turning and aligning bodies, with what is attached to them.

Formulas stay formulas: a position `r` that is moved becomes `r + 0.5`. Bodies pinned to a moved
body move with it, and so do its pins; the length of a rod becomes the new distance of its ends.
"""

from cmath import rect
from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Literal

from sandbox.editing.attached_bodies import attached, pinned, shifted_point
from sandbox.editing.bodies_at_start import bodies_named, bounding_box
from sandbox.editing.formula_arithmetic import rotated
from sandbox.editing.text_patches import Changes, put_all
from sandbox.model.joints import Wire, body_of
from sandbox.model.level import Level
from sandbox.model.shapes import XY
from sandbox.physics.geometry.outline_distance import dot

Side = Literal["left", "right", "top", "bottom", "center-x", "center-y"]
"""The side at which bodies are aligned; `center-x` gives their centres the same x."""

Box = tuple[complex, complex]

_SIDES: Mapping[Side, Callable[[Box], complex]] = {
    "left": lambda box: complex(box[0].real),
    "right": lambda box: complex(box[1].real),
    "bottom": lambda box: complex(0, box[0].imag),
    "top": lambda box: complex(0, box[1].imag),
    "center-x": lambda box: complex((box[0].real + box[1].real) / 2),
    "center-y": lambda box: complex(0, (box[0].imag + box[1].imag) / 2),
}


def move(text: str, level: Level, names: Collection[str], by: XY) -> str:
    """Return a level in which bodies, and all that is pinned to them, are displaced [m]."""
    return shift(text, level, dict.fromkeys(pinned(level, names), complex(*by)))


def shift(text: str, level: Level, displacements: Mapping[str, complex]) -> str:
    """Return a level in which each of some bodies is displaced by its own vector [m].

    The wire of a bead moves with it.
    """
    changes = Changes()
    for name, by in displacements.items():
        if by:
            changes["bodies", name, "position"] = shifted_point(level.bodies[name].position, by)
    for name, joint in level.joints.items():
        if isinstance(joint, Wire) and (
            displacement := displacements.get(body_of(joint.bead) or "")
        ):
            changes["joints", name, "curve"] = shifted_point(joint.curve, displacement)
    return attached(put_all(text, changes), level, displacements)


def turn(
    text: str, level: Level, names: Collection[str], angle: float, about: XY | None = None
) -> str:
    """Return a level in which bodies are turned together, counter-clockwise by an angle [rad].

    They turn about a point [m], by default their middle.
    """
    where = bodies_named(level, names)
    low, high = bounding_box(where.values())
    middle = where[next(iter(names))].center if len(names) == 1 else (low + high) / 2
    center = middle if about is None else complex(*about)
    changes = Changes()
    for name, body in where.items():
        by = (body.center - center) * (rect(1, angle) - 1)
        changes["bodies", name, "angle"] = rotated(body.body.angle, angle)
        if by:
            changes["bodies", name, "position"] = shifted_point(body.body.position, by)
    return attached(put_all(text, changes), level, names)


def align(text: str, level: Level, names: Collection[str], side: Side) -> str:
    """Return a level in which bodies are aligned with the outermost of their sides."""
    where, at = bodies_named(level, names), _SIDES[side]
    line = at(bounding_box(where.values()))
    return shift(text, level, {n: line - at(body.bounds) for n, body in where.items()})


def distribute(text: str, level: Level, names: Sequence[str], axis: Literal["x", "y"]) -> str:
    """Return a level with equal gaps between bodies along an axis; the outermost bodies stay."""
    where = bodies_named(level, names)
    unit = 1 + 0j if axis == "x" else 1j
    spans = {name: tuple(dot(end, unit) for end in body.bounds) for name, body in where.items()}
    ordered = sorted(spans, key=lambda name: sum(spans[name]))
    low, high = min(span[0] for span in spans.values()), max(span[1] for span in spans.values())
    gap = (high - low - sum(b - a for a, b in spans.values())) / max(len(ordered) - 1, 1)
    displacements = dict[str, complex]()
    for name in ordered:
        a, b = spans[name]
        displacements[name] = (low - a) * unit
        low += b - a + gap
    return shift(text, level, displacements)
