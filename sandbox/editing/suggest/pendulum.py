"""A bob let go on a rod or string: its energy, and T/4 = π/2 √(L/g) / M(1, cos(θ0/2)).

M is the arithmetic-geometric mean, of Gauss.
"""

from cmath import phase, rect
from collections.abc import Iterable, Iterator
from math import cos, pi, sqrt
from typing import Any

import numpy as np

from sandbox.editing.json_layout import plain
from sandbox.editing.suggest.scene import (
    TOUCHING,
    Scene,
    Suggestion,
    check,
    opposite,
    rate_of,
    said,
)
from sandbox.model.joint_ends import place
from sandbox.model.joints import Joint, Rod, Rope, body_of
from sandbox.model.level_parts import names_in

NEAR = 1e-4
"""The bound of the check at the rate below: leapfrog is of second order."""

STEPS = 400
"""Steps per period."""

LARGEST, SMALLEST = 2.5, 1e-3
"""rad, the amplitudes for which the closed form is accurate enough, and the swing is no
rounding."""


def suggestions(scene: Scene) -> Iterator[Suggestion]:
    """Yield the closed forms of the pendulums."""
    fall = scene.fall
    if fall is None or not scene.only("gravity", "contact", "friction", "restitution", "rotation"):
        return
    for name, joint in scene.level.joints.items():
        bob = bob_of(scene, joint)
        if bob is None or not isinstance(joint, Rod | Rope):
            continue
        first, second = (place(end, scene.level.bodies, scene.values) for end in joint.ends)
        center = scene.where[bob].center
        way = center - (first if second == center else second)
        length, angle = abs(way), abs(phase(way * 1j))
        others = [other for other in scene.where if other != bob]
        swings = SMALLEST < angle < LARGEST
        if not swings or not swings_free(scene, bob, center - way, way, others):
            continue
        mean = _mean(1.0, cos(angle / 2))
        quarter = pi / 2 * sqrt(length / -fall(scene.values)) / mean
        g, (x, y) = opposite(fall), scene.level.bodies[bob].position
        energy = f"{scene.mass(bob)}*{g}*{said(y)}"
        checks: list[dict[str, Any]] = [
            check("energy", f"{bob}.energy", energy, NEAR, scale=f"{scene.mass(bob)}*{g}")
        ]
        if not names_in((x, y, joint)):
            checks.append(check("length", f"{name}.length", f"{plain(length)!r}", 1e-10))
            if scene.lasts > quarter:
                form = f"pi/2*sqrt({plain(length)!r}/{g})/{plain(mean)!r}"
                at = dict[str, Any](event="crossing", quantity=f"{bob}.position.x")
                at["value"] = plain((center - way).real)
                checks.append(check("quarter of a period", "t", form, NEAR, at=at))
        yield Suggestion("pendulum", (bob,), tuple(checks), rate_of(STEPS / (4 * quarter)))


def bob_of(scene: Scene, joint: Joint) -> str | None:
    """Return the body that hangs at rest by its centre from a point of the plane, if one does."""
    if not isinstance(joint, Rod | Rope) or joint.length is not None:
        return None
    held = [end for end in joint.ends if body_of(end)]
    if len(held) != 1 or not isinstance(bob := held[0], str):
        return None
    alone = scene.level.bodies[bob].type == "dynamic" and len(scene.joints[bob]) == 1
    return bob if alone and scene.rests(bob) else None


def swings_free(scene: Scene, bob: str, peg: complex, way: complex, others: Iterable[str]) -> bool:
    """Whether no others are in the way of a swing about a peg, from a way [m] to its mirror image.

    A string stays taut.
    """
    if scene.level.effects.contact is None:
        return True
    start, center = phase(way * 1j), scene.where[bob].center
    turns = np.linspace(start, -start, 100).tolist()
    swing = [peg + rect(abs(way), turn) / 1j - center for turn in turns]
    return all(scene.distance(bob, by, o) > TOUCHING for by in swing for o in others)


def _mean(one: float, other: float) -> float:
    """Return the arithmetic-geometric mean of two numbers."""
    for _ in range(6):
        one, other = (one + other) / 2, sqrt(one * other)
    return one
