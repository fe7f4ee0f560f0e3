"""Bodies on a string over pegs and wheels: T = g Σ n / Σ (n²/m), a = n T/m − g.

n is the number of parts of the string that carry a body; a slanted part counts by its vertical
component, valid at the start only. Two bodies carried by one part each are an Atwood machine.
"""

from collections.abc import Iterator, Sequence
from itertools import combinations, pairwise
from math import sqrt
from typing import Any, NamedTuple

from sandbox.editing.inserted_value_layout import plain
from sandbox.editing.suggested_checks.recogniser_input import (
    SAFE,
    Scene,
    Setup,
    Suggestion,
    check,
    instant,
    opposite,
)
from sandbox.model.expressions import Expression
from sandbox.model.joint_ends_at_start import end_position
from sandbox.model.joints import End, Joint, Pulley, Rod, Rope, bodies_of, body_of, points
from sandbox.model.level_parts import names_in

EXACT = 1e-9
"""The tolerance for vertical parts: string and gravity are exact to rounding."""

NEAR = 1e-4
"""The tolerance for slanted parts, which turn a little in the first step."""

STRAIGHT = 1e-9
"""The tolerance of the direction of a pull, and of its distance from the centre [m]."""

ROUND = 9
"""Decimals of the number of parts that carry a body."""


class Carried(NamedTuple):
    """A body that a string carries, with the bodies that hang below it on rods and ropes."""

    name: str
    parts: float
    """the number of parts of the string that carry it"""
    mass: str
    """kg, the total mass, as a formula"""
    below: tuple[str, ...]


class Part(NamedTuple):
    """A straight part of a string, between two of its points."""

    ends: tuple[End, End]
    positions: tuple[complex, complex]
    """m, the positions of the ends"""

    @property
    def direction(self) -> complex:
        """The unit vector along it; 0 if it has no length."""
        vector = self.positions[1] - self.positions[0]
        return vector / abs(vector) if vector else 0j


def suggestions(scene: Scene) -> Iterator[Suggestion]:
    """Yield the closed forms for bodies carried by one string."""
    if scene.gravity_y is None:
        return
    if not scene.only("gravity", "contact", "rotation", "friction", "restitution"):
        return
    for name, joint in scene.level.joints.items():
        carried = _carried(scene, joint) if isinstance(joint, Pulley) else []
        if not carried or any(_carried(each, joint) != carried for each in scene.everywhere):
            continue
        until = min(_until(each, joint, carried) for each in scene.everywhere)
        if until:
            yield _of(scene, name, carried, until)


def _of(scene: Scene, name: str, carried: Sequence[Carried], until: float) -> Suggestion:
    """Return the suggestion for bodies on a string that meet nothing before a time [s]."""
    assert scene.gravity_y is not None
    g, upright = opposite(scene.gravity_y), _upright(scene, scene.level.joints[name])
    tension, acceleration = _forms(carried, g)
    at = None if until >= scene.duration else instant(SAFE * until)
    more: dict[str, Any] = {"at": at if upright else 0, "tolerance": EXACT if upright else NEAR}
    fields = list(zip(carried, acceleration, strict=False))[: 1 if _is_atwood(carried) else None]
    checks = [
        check("acceleration", f"{one.name}.acceleration.y", form, scale=g, **more)
        for one, form in fields
    ]
    checks.append(check("tension", f"{name}.tension", tension, **more))
    if upright and acceleration:
        speed = f"{carried[0].name}.velocity.y"
        checks.append(check("speed", speed, f"{acceleration[0]}*t", scale=1, **more))
    setup: Setup = "Atwood machine" if _is_atwood(carried) and upright else "block and tackle"
    return Suggestion(setup, tuple(one.name for one in carried), tuple(checks))


def _is_atwood(carried: Sequence[Carried]) -> bool:
    return [one.parts for one in carried] == [1, 1]


def _forms(carried: Sequence[Carried], g: str) -> tuple[str, list[str]]:
    """Return the formulas of the tension and, for several bodies, the upward accelerations."""
    masses, parts = [one.mass for one in carried], [repr(plain(one.parts)) for one in carried]
    if len(carried) == 1:
        return f"{masses[0]}*{g}/{parts[0]}", []
    if _is_atwood(carried):
        m1, m2 = masses
        total = f"({m1} + {m2})"
        return f"2*{m1}*{m2}*{g}/{total}", [
            f"({m2} - {m1})*{g}/{total}",
            f"({m1} - {m2})*{g}/{total}",
        ]
    terms = " + ".join(f"{n}**2/{m}" for n, m in zip(parts, masses, strict=True))
    tension = f"({' + '.join(parts)})*{g}/({terms})"
    return tension, [f"({n}/{m}*{tension} - {g})" for n, m in zip(parts, masses, strict=True)]


def _parts(scene: Scene, joint: Joint) -> list[Part]:
    """Return the parts of a string."""
    positions = [
        (end, end_position(end, scene.level.bodies, scene.values)) for end in points(joint)
    ]
    return [Part((a, b), (at, to)) for (a, at), (b, to) in pairwise(positions)]


def _upright(scene: Scene, joint: Joint) -> bool:
    """Return whether all parts that end at dynamic bodies are vertical."""
    movable = set(scene.dynamic)
    led = (part for part in _parts(scene, joint) if movable & {body_of(end) for end in part.ends})
    return all(abs(part.direction.real) <= STRAIGHT for part in led)


def _carried(scene: Scene, joint: Joint) -> list[Carried]:
    """Return the bodies at rest that a taut string carries; none if there is no closed form."""
    bodies, names = scene.level.bodies, dict.fromkeys(bodies_of(joint))
    moving = [name for name in names if bodies[name].type == "dynamic"]
    if getattr(joint, "length", None) is not None or any(
        bodies[name].type == "kinematic" for name in names
    ):
        return []
    if not _upright(scene, joint) and names_in((joint, *(bodies[name].position for name in names))):
        return []
    found = [_one(scene, joint, name) for name in moving]
    return [one for one in found if one] if all(found) else []


def _one(scene: Scene, joint: Joint, name: str) -> Carried | None:
    """Return a body at rest that a string pulls straight up; None if it does not."""
    below, pull, turn = _below(scene, name, joint), 0j, 0.0
    for part in _parts(scene, joint):
        for end, at, direction in zip(
            part.ends, part.positions, (part.direction, -part.direction), strict=True
        ):
            if body_of(end) == name:
                pull += direction
                turn += ((at - scene.where[name].center).conjugate() * direction).imag
    turns = scene.level.effects.rotation is not None and abs(turn) > STRAIGHT
    if below is None or abs(pull.real) > STRAIGHT or pull.imag <= STRAIGHT or turns:
        return None
    if not scene.is_at_rest(name, *below):
        return None
    masses = " + ".join(scene.mass(one) for one in (name, *below))
    return Carried(name, round(pull.imag, ROUND), f"({masses})" if below else masses, below)


def _below(scene: Scene, name: str, upper_joint: Joint) -> tuple[str, ...] | None:
    """Return the bodies that hang straight below a held body; None if it has other joints."""
    found = list[str]()
    for joint in (scene.level.joints[other] for other in scene.joints[name]):
        if joint is upper_joint:
            continue
        hung = _hung(scene, joint, name)
        below = _below(scene, hung, joint) if hung else None
        if hung is None or below is None:
            return None
        found += (hung, *below)
    return tuple(found)


def _hung(scene: Scene, joint: Joint, name: str) -> str | None:
    """Return the body that a rod or a rope carries straight below another, or None."""
    if not isinstance(joint, Rod | Rope) or joint.length is not None:
        return None
    upper, lower = joint.ends if body_of(joint.ends[0]) == name else joint.ends[::-1]
    other = body_of(lower)
    if other is None or scene.level.bodies[other].type != "dynamic":
        return None
    high, low = (end_position(end, scene.level.bodies, scene.values) for end in (upper, lower))
    line = (high, low, scene.where[other].center)
    off = max(abs((point - scene.where[name].center).real) for point in line)
    return other if off <= STRAIGHT and low.imag < high.imag else None


def _until(scene: Scene, joint: Joint, carried: Sequence[Carried]) -> float:
    """Return the time at which a body reaches a peg or another body [s]."""
    _, acceleration = _forms(carried, opposite(scene.gravity_y) if scene.gravity_y else "0")
    rises = {
        one.name: Expression(a)(scene.known_values)
        for one, a in zip(carried, acceleration, strict=False)
    }
    until = [scene.duration]
    for part in _parts(scene, joint):
        lower, upper = (rises.get(body_of(end) or "", 0.0) for end in part.ends)
        if (closing := (lower - upper) * part.direction.imag) > 0:
            until.append(sqrt(2 * abs(part.positions[1] - part.positions[0]) / closing))
    moving = {name: rises.get(one.name, 0.0) for one in carried for name in (one.name, *one.below)}
    until += [
        scene.free_until(name, lambda t, a=a: 1j * a * t * t / 2, list(moving))  # type: ignore[misc]
        for name, a in moving.items()
    ]
    for one, other in combinations(moving, 2):
        besides = [name for name in scene.level.bodies if name != other]
        a = moving[one] - moving[other]
        until.append(scene.free_until(one, lambda t, a=a: 1j * a * t * t / 2, besides))  # type: ignore[misc]
    return min(until)
