"""Making the angle of a hanging body a parameter; its rod or rope keeps its length.

A coordinate is then a sum such as `2 - 3*sin(angle*deg)`.
"""

from cmath import phase, rect
from collections.abc import Mapping
from math import copysign, degrees, pi

from sandbox.editing.bodies_at_start import PlacedBody, distance, placed
from sandbox.editing.cleanup_after_edit import accepted
from sandbox.editing.edits.field_values import parameter_name
from sandbox.editing.formula_arithmetic import rounded, sum_of
from sandbox.editing.inserted_value_layout import Json, plain
from sandbox.editing.text_patches import put_all
from sandbox.model.errors import SandboxError
from sandbox.model.joint_ends_at_start import end_position
from sandbox.model.joints import Rod, Rope, bodies_of, body_of
from sandbox.model.level import Level
from sandbox.model.level_parts import names_in

ASIDE = 30.0
"""deg, the angle to which a body that hangs straight down is drawn aside."""

STRAIGHT = 1e-6
"""deg, the largest angle at which a body hangs straight down."""

RANGES = ((5, 60), (0, 90), (0, 175))
"""deg, possible ranges of the slider; the first that contains the angle is used."""


def peg_of(level: Level, name: str) -> complex | None:
    """Return the point of the plane [m] from which a body hangs on a rod or rope, or None."""
    joints = [joint for joint in level.joints.values() if name in bodies_of(joint)]
    if len(joints) != 1 or not isinstance(joints[0], Rod | Rope) or joints[0].length is not None:
        return None
    pegs = [end for end in joints[0].ends if end != name]
    if len(pegs) != 1 or body_of(pegs[0]) or names_in((pegs[0], level.bodies[name].position)):
        return None
    return end_position(pegs[0], level.bodies, level.defaults)


def swing(text: str, level: Level, name: str) -> str:
    """Return a level in which the angle of a hanging body is a parameter.

    A body that hangs straight down is drawn aside. Raises `SandboxError` if it does not hang from a
    point of the plane, or its position is a formula already.
    """
    peg = peg_of(level, name)
    if peg is None:
        raise SandboxError("'{name}' does not hang from a point of the plane", name=name)
    where = placed(level)
    vector = where[name].center - peg
    new_angle = degrees(phase(vector * 1j))
    if abs(new_angle) < STRAIGHT:
        new_angle = _free_side(where, name, peg, abs(vector))
    angle = parameter_name(level, ("bodies", name, "angle"))
    sin, cos = (f"{function}({angle}*deg)" for function in ("sin", "cos"))
    formulas: list[Json] = [
        sum_of({"": peg.real, sin: copysign(abs(vector), new_angle)}),
        sum_of({"": peg.imag, cos: -abs(vector)}),
    ]
    value = plain(rounded(abs(new_angle)))
    parameters: list[dict[str, Json]] = [
        {"value": value, "min": low, "max": high, "unit": "deg", "label": f"angle of {name}"}
        for low, high in (*RANGES, (value, value))
        if low <= value <= high
    ]
    moved: Mapping[tuple[str | int, ...], Json] = {("bodies", name, "position"): formulas}
    path = ("parameters", angle)
    return accepted(*(put_all(text, {**moved, path: one}) for one in parameters))


def _free_side(where: Mapping[str, PlacedBody], name: str, peg: complex, length: float) -> float:
    """Return the angle of a side without obstacles, preferably the left [deg]."""
    for angle in (-ASIDE, ASIDE):
        vector = peg + rect(length, angle * pi / 180 - pi / 2) - where[name].center
        if all(
            distance(where[name], other, vector) > 0
            for other in where.values()
            if other.name != name
        ):
            return angle
    return -ASIDE
