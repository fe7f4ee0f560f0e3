"""Laying a rope of knots over a drum, from one body to another, subject to friction."""

from cmath import phase, rect
from collections.abc import Sequence
from itertools import pairwise
from math import acos, ceil, pi

from sandbox.editing.bodies_at_start import PlacedBody, placed, xy
from sandbox.editing.cleanup_after_edit import COEFFICIENTS, accepted
from sandbox.editing.edits.edit_result import EditResult, new_name
from sandbox.editing.edits.effects import declare
from sandbox.editing.edits.field_values import set_field
from sandbox.editing.inserted_value_layout import Json, plain
from sandbox.editing.text_patches import put_all
from sandbox.model.errors import SandboxError
from sandbox.model.joints import bodies_of
from sandbox.model.level import Level
from sandbox.model.loading import parse
from sandbox.model.shapes import Disc

THICK = 0.04
"""The radius of a knot, as a share of that of the drum."""

LIGHT = 1e-3
"""The mass of a knot, as a share of that of the lighter body."""

RATE = 480
"""Hz, the rate at which moving weights do not press knots into the drum."""

HEMP = "#e9c46a"
"""The colour of all knots of a rope."""

STEP = 7.5 * pi / 180
"""rad, the largest angle between two knots."""

DIGITS = 12
"""Decimals of a knot's position: far less than the overlap that bodies may have."""


def drum_of(level: Level, names: Sequence[str]) -> str | None:
    """Return the highest disc of three bodies, over which a rope can lie; None if there is none."""
    if len(names) != 3 or any(level.bodies[name].mass is None for name in _ends(level, names)):
        return None
    return _highest(level, names)


def _highest(level: Level, names: Sequence[str]) -> str | None:
    where = placed(level)
    discs = [name for name in names if isinstance(level.bodies[name].shape, Disc)]
    return max(discs, key=lambda name: where[name].center.imag, default=None)


def _ends(level: Level, names: Sequence[str]) -> list[str]:
    """Return the bodies at the ends, from left to right."""
    where, drum = placed(level), _highest(level, names)
    return sorted((n for n in names if n != drum), key=lambda name: where[name].center.real)


def wrap(text: str, level: Level, names: Sequence[str]) -> EditResult:
    """Return a level with a new rope over a drum: knots joined by rods, and a rod to each end.

    A drum that no joint holds is made static. The names are those of the drum, a disc, and of the
    bodies at both ends of the rope. Raises `SandboxError` if they are not such bodies, or an end
    lies within the drum.
    """
    drum = drum_of(level, names)
    if drum is None:
        raise SandboxError(
            "a rope is laid over a disc, between two bodies that move; select the three"
        )
    left, right = _ends(level, names)
    where = placed(level)
    points = _knots(where[drum], where[left], where[right])
    knots = list[str]()
    for _ in points:
        knots.append(new_name("knot", level, knots))
    body = _knot(level, where[drum], [where[left], where[right]])
    values: dict[tuple[str | int, ...], Json] = {
        ("bodies", name): body | {"position": [plain(round(at, DIGITS)) for at in xy(point)]}
        for name, point in zip(knots, points, strict=True)
    }
    if level.stepping.accuracy is None and level.stepping.rate < RATE:
        values["stepping", "rate"] = RATE
    rods = list[str]()
    held_points = [left, *knots, right]
    for ends in pairwise(held_points):
        rods.append(new_name("rod", level, rods))
        values["joints", rods[-1]] = {"type": "rod", "ends": list(ends)}
    return EditResult(accepted(_standing(put_all(text, values), drum)), tuple(knots))


def _knot(level: Level, drum: PlacedBody, ends: Sequence[PlacedBody]) -> dict[str, Json]:
    """Return the fields that all knots share."""
    masses = [end.body.mass(end.values) for end in ends if end.body.mass]
    return {
        "shape": {"type": "disc", "radius": plain(THICK * drum.radius)},
        "mass": plain(LIGHT * min(masses)),
        "color": HEMP,
        **{name: 1 for name in COEFFICIENTS if name in level.effects.declared},
    }


def _standing(text: str, drum: str) -> str:
    """Return a level with contact, in which a drum that no joint holds is static."""
    level = parse(text)
    if level.effects.contact is None:
        text = declare(text, level, "contact")
    has_joint = any(drum in bodies_of(joint) for joint in level.joints.values())
    return text if has_joint else set_field(text, ("bodies", drum, "type"), "static")


def _knots(drum: PlacedBody, left: PlacedBody, right: PlacedBody) -> list[complex]:
    """Return the positions of the knots, between the two points of tangency on the drum [m]."""
    radius = (1 + THICK) * drum.radius
    offsets = [end.center - drum.center for end in (left, right)]
    if any(abs(offset) <= radius for offset in offsets):
        raise SandboxError("the ends of the rope lie within '{name}'", name=drum.name)
    begin = phase(offsets[0]) - acos(radius / abs(offsets[0]))
    end = phase(offsets[1]) + acos(radius / abs(offsets[1]))
    wrapped = (begin - end) % (2 * pi)
    count = max(ceil(wrapped / STEP), 1)
    return [drum.center + rect(radius, begin - wrapped * i / count) for i in range(count + 1)]
