"""The mirror image of a scene, and the scene rotated together with its gravity."""

from collections.abc import Callable
from copy import deepcopy
from dataclasses import dataclass
from math import cos, sin

from validation.stability.scene_parts import Document, Place

Move = Callable[[Place], list[float]]
"""The transformation of a point, or of a direction."""


@dataclass(frozen=True, slots=True)
class Motion:
    """A motion of the plane that fixes the origin."""

    move: Move
    """The transformation of a point of the plane."""
    local: Move
    """The transformation of a point of a body, along its axes."""
    sign: int
    turn: float
    """An angle becomes sign · angle + turn [rad]."""
    curve: Callable[[str, str], list[str]]
    """The transformation of a curve's formulas."""


def mirrored(document: Document) -> Document:
    """Return the mirror image of a level, with left and right exchanged."""
    return _moved(document, Motion(_flip, _flip, -1, 0.0, lambda x, y: [f"-({x})", y]))


def turned(document: Document, angle: float) -> Document:
    """Return a level that is rotated about the origin, with its gravity [rad]."""
    c, s = cos(angle), sin(angle)

    def move(point: Place) -> list[float]:
        return [c * point[0] - s * point[1], s * point[0] + c * point[1]]

    def curve(x: str, y: str) -> list[str]:
        return [f"{c!r}*({x}) - {s!r}*({y})", f"{s!r}*({x}) + {c!r}*({y})"]

    return _moved(document, Motion(move, list, 1, angle, curve))


def _flip(point: Place) -> list[float]:
    return [-point[0], point[1]]


def _moved(document: Document, motion: Motion) -> Document:
    found = deepcopy(document)
    _change(found["effects"].get("gravity", {}), "acceleration", motion.move)
    for belt in found["effects"].get("belt", ()):
        _change(belt, "velocity", motion.local)
    for body in found["bodies"].values():
        _move_body(body, motion)
    for joint in found["joints"].values():
        _move_joint(joint, motion)
    return found


def _change(part: Document, key: str, move: Move) -> None:
    if key in part:
        part[key] = move(part[key])


def _move_body(body: Document, motion: Motion) -> None:
    body["angle"] = motion.sign * body.get("angle", 0.0) + motion.turn
    if "angular_velocity" in body:
        body["angular_velocity"] *= motion.sign
    for key in ("position", "velocity"):
        _change(body, key, motion.move)
    shape = body["shape"]
    for key in ("start", "end"):
        _change(shape, key, motion.local)
    for key in ("points", "vertices"):
        if key in shape:
            moved = [motion.local(point) for point in shape[key]]
            shape[key] = moved[:: motion.sign]  # still counter-clockwise


def _move_joint(joint: Document, motion: Motion) -> None:
    for key in ("ends", "over"):
        if key in joint:
            joint[key] = [_moved_end(end, motion) for end in joint[key]]
    _change(joint, "direction", motion.move)
    if joint["type"] == "motor":
        joint["rate"] *= motion.sign
    if joint["type"] == "winding" and motion.sign < 0:
        other = {"clockwise": "counterclockwise", "counterclockwise": "clockwise"}
        joint["unwinds"] = other[joint["unwinds"]]
    if joint["type"] == "wire":
        joint["curve"] = motion.curve(*joint["curve"])


def _moved_end(end: object, motion: Motion) -> object:
    if isinstance(end, list):
        return motion.move(end)
    if isinstance(end, dict):
        return {"body": end["body"], "at": motion.local(end["at"])}
    return end
