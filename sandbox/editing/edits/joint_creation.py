"""Adding joints of every kind between the points that were picked on the stage.

The length of a new joint is left out, which makes it the distance of the ends at the start.
"""

import json
from collections.abc import Callable, Mapping, Sequence
from math import pi
from typing import NamedTuple

from sandbox.editing.bodies_at_start import PlacedBody, distance, placed, xy
from sandbox.editing.cleanup_after_edit import accepted, without_meaning
from sandbox.editing.edits.edit_result import EditResult, new_name
from sandbox.editing.inserted_value_layout import Json, plain
from sandbox.editing.text_patches import put, remove
from sandbox.model.did_you_mean import suggestion
from sandbox.model.errors import SandboxError
from sandbox.model.excluded_pairs import excluded_pairs
from sandbox.model.joint_ends_at_start import end_position
from sandbox.model.joints import KINDS, Pivot, body_of
from sandbox.model.level import Level
from sandbox.model.shapes import XY
from sandbox.model.translatable_message import word

CENTRAL = 1e-9
"""m, the distance from the centre within which a picked point counts as the centre."""

OVERLAP = 1e-6
"""m, the overlap from which on two bodies that are joined no longer collide."""

FREQUENCY = 1.0
"""Hz, the frequency of a body on a new spring."""

TURNS = 1.0
"""rad/s, the speed of a new motor."""


class Pick(NamedTuple):
    """A point that was picked on the stage."""

    point: XY
    """Its position in the plane [m]."""
    body: str | None = None
    """The body that it belongs to; None for the plane."""


Bodies = Mapping[str, PlacedBody]


def picks(kind: str) -> int:
    """Return the least number of points for a kind of joint; a string may run over more pegs."""
    return 3 if kind == "pulley" else 2


def add_joint(text: str, level: Level, kind: str, chosen: Sequence[Pick]) -> EditResult:
    """Return a level with a new joint; if its bodies overlap, they no longer collide.

    A motor takes the place of a pivot that is there, since it is a pin itself.

    `kind` is as in a level's file, and `chosen` has the two ends, in order. For a pulley, it also
    has the pegs between them. For a pin, it has the two parts, held at the first point; for a rail,
    the body that slides, and a point through which the rail passes, or the slot of a body; for a
    winding, the end of the string, and the wheel on the side where the string leaves it; for a
    wire, the bead, and a point through which the wire passes. Raises `SandboxError` if the kind
    does not exist, or cannot join these points.
    """
    if kind not in KINDS:
        raise SandboxError(
            "there is no joint '{kind}'{hint}",
            kind=kind,
            hint=suggestion(kind, KINDS, longest=len(KINDS)),
        )
    if len(chosen) < picks(kind):
        raise SandboxError(
            "a {kind} needs {picks} points; {count} are picked",
            kind=word(kind),
            picks=picks(kind),
            count=len(chosen),
        )
    where = placed(level)
    joint = _MADE.get(kind, _line)(list(chosen), where)
    name = new_name(kind, level)
    if kind == "motor":
        text = _unpinned(text, level, chosen)
    added = put(_apart(text, level, chosen, where), ("joints", name), {"type": kind, **joint})
    return EditResult(accepted(*_turning(added, level, kind)), (name,))


def _turning(added: str, level: Level, kind: str) -> tuple[str, ...]:
    """Return a level with a new joint, without and with `rotation`, the preferred first."""
    if level.effects.rotation is not None:
        return (added,)
    turning = put(added, ("effects", "rotation"), {})
    return (turning, added) if kind == "pivot" else (added, turning)


def _unpinned(text: str, level: Level, chosen: Sequence[Pick]) -> str:
    """Return a level without the pivots that hold the same two parts at the same point."""
    point, parts = complex(*chosen[0].point), {pick.body for pick in chosen[:2]}
    for name, joint in level.joints.items():
        if not isinstance(joint, Pivot) or {body_of(end) for end in joint.ends} != parts:
            continue
        if abs(end_position(joint.ends[0], level.bodies, level.defaults) - point) <= OVERLAP:
            text = without_meaning(remove(text, ("joints", name)))
    return text


def _apart(text: str, level: Level, chosen: Sequence[Pick], where: Bodies) -> str:
    """Return a level in which the two bodies to be joined do not collide if they overlap."""
    contact, bodies = level.effects.contact, sorted({pick.body for pick in chosen if pick.body})
    if contact is None or len(bodies) != 2 or tuple(bodies) in excluded_pairs(level):
        return text
    if distance(where[bodies[0]], where[bodies[1]]) > -OVERLAP:
        return text
    pairs = json.loads(text).get("effects", {}).get("contact", {}).get("apart", ())
    return put(text, ("effects", "contact", "apart", len(pairs)), bodies)


def end(pick: Pick, where: Bodies) -> Json:
    """Return an end as in a level's file: a body, a point of a body, or a point [x, y]."""
    if pick.body is None:
        return list(pick.point)
    at = where[pick.body].to_body(complex(*pick.point))
    return pick.body if abs(at) <= CENTRAL else {"body": pick.body, "at": list(xy(at))}


def _line(chosen: list[Pick], where: Bodies) -> dict[str, Json]:
    return {"ends": [end(pick, where) for pick in chosen[:2]]}


def _pulley(chosen: list[Pick], where: Bodies) -> dict[str, Json]:
    first, *pegs, last = [end(pick, where) for pick in chosen]
    return {"ends": [first, last], "over": pegs}


def _pin(chosen: list[Pick], where: Bodies) -> dict[str, Json]:
    """Return a pin at the first point."""
    return _line([chosen[0], chosen[1]._replace(point=chosen[0].point)], where)


def _motor(chosen: list[Pick], where: Bodies) -> dict[str, Json]:
    """Return a motor whose second end is a body, driven relative to the first."""
    pin = _pin(chosen, where)
    if chosen[1].body is None:
        pin = _pin([chosen[1]._replace(point=chosen[0].point), chosen[0]], where)
    return {**pin, "rate": TURNS}


def _rail(chosen: list[Pick], where: Bodies) -> dict[str, Json]:
    vector = complex(*chosen[1].point) - complex(*chosen[0].point)
    return {**_line(chosen, where), "direction": _direction(vector)}


def _direction(vector: complex) -> Json:
    """Return the direction from one pick to the other; to the right if they are at one point."""
    return list(xy(vector)) if abs(vector) > CENTRAL else [1, 0]


def _slot(chosen: list[Pick], where: Bodies) -> dict[str, Json]:
    """Return a slot in the second body, or in the first if the second is the plane."""
    first, second = chosen[:2] if chosen[1].body else (chosen[1], chosen[0])
    turn = where[second.body].rotation if second.body else 1.0
    vector = (complex(*second.point) - complex(*first.point)) / turn
    return {**_line([first, second], where), "direction": _direction(vector)}


def _stop(chosen: list[Pick], where: Bodies) -> dict[str, Json]:
    """Return stops that let the first body move by its distance from the second, either way."""
    line = _rail(chosen, where)
    far = abs(complex(*chosen[1].point) - complex(*chosen[0].point)) or 1.0
    return {**line, "range": [plain(-far), plain(far)]}


def _angle_stop(chosen: list[Pick], where: Bodies) -> dict[str, Json]:
    """Return stops a quarter turn on either side of the present relative angle."""
    now = [_angle(where[pick.body]) if pick.body else 0.0 for pick in chosen[:2]]
    start = now[1] - now[0]
    return {**_pin(chosen, where), "range": [plain(start - pi / 2), plain(start + pi / 2)]}


def _angle(one: PlacedBody) -> float:
    return one.body.angle(one.values)


def _gear(chosen: list[Pick], where: Bodies) -> dict[str, Json]:
    """Return a gear of two wheels that mesh externally."""
    wheels = [where[pick.body] for pick in chosen[:2] if pick.body is not None]
    if len(wheels) < 2:
        raise SandboxError("a gear connects two wheels; pick two bodies")
    first, second = (wheel.radius or 1.0 for wheel in wheels)
    return {"ends": [pick.body for pick in chosen[:2]], "ratio": plain(-first / second)}


def _rack(chosen: list[Pick], where: Bodies) -> dict[str, Json]:
    """Return a rack on the side of the wheel where the bar is."""
    wheel = chosen[1].body
    if wheel is None:
        raise SandboxError("a rack is moved by a wheel; pick the wheel as the second point")
    radius = where[wheel].radius or 1.0
    above = chosen[0].point[1] > where[wheel].center.imag
    ends = [end(chosen[0], where), wheel]
    return {"ends": ends, "radius": plain(radius), "direction": [-1 if above else 1, 0]}


def _winding(chosen: list[Pick], where: Bodies) -> dict[str, Json]:
    wheel = chosen[1].body
    if wheel is None:
        raise SandboxError("a string is wound on a body; pick the wheel as the second point")
    center = where[wheel].center
    tied, side = complex(*chosen[0].point) - center, complex(*chosen[1].point) - center
    right = (tied.conjugate() * side).imag < 0  # seen along the string, towards its end
    return {
        "ends": [end(chosen[0], where), wheel],
        "radius": plain(where[wheel].radius or abs(side)),
        "unwinds": "counterclockwise" if right else "clockwise",
    }


def _spring(chosen: list[Pick], where: Bodies) -> dict[str, Json]:
    masses = [where[pick.body].body.mass for pick in chosen if pick.body]
    lightest = min((mass(next(iter(where.values())).values) for mass in masses if mass), default=1)
    stiffness = lightest * (2 * pi * FREQUENCY) ** 2
    return {**_line(chosen, where), "stiffness": plain(float(f"{stiffness:.2g}"))}


def _wire(chosen: list[Pick], where: Bodies) -> dict[str, Json]:
    """Return a straight wire that extends equally far on both sides of the bead."""
    start = complex(*chosen[0].point)
    vector = complex(*chosen[1].point) - start
    formulas: list[Json] = [
        f"{plain(begin)!r} + {plain(along)!r}*s"
        for begin, along in zip(xy(start), xy(vector), strict=True)
    ]
    return {"bead": end(chosen[0], where), "curve": formulas, "s": [-1, 1]}


_MADE: Mapping[str, Callable[[list[Pick], Bodies], dict[str, Json]]] = {
    "pulley": _pulley,
    "pivot": _pin,
    "motor": _motor,
    "rail": _rail,
    "slot": _slot,
    "stop": _stop,
    "angle_stop": _angle_stop,
    "gear": _gear,
    "rack": _rack,
    "winding": _winding,
    "spring": _spring,
    "wire": _wire,
}
"""The functions for kinds with more fields than two ends; a kind with just two needs no entry."""
