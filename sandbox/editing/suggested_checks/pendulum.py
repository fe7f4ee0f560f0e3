"""A bob released on a rod or string: its energy, and T/4 = π/2 √(L/g) / M(1, cos(θ0/2)).

M is the arithmetic-geometric mean (Gauss).
"""

from cmath import phase, rect
from collections.abc import Iterable, Iterator, Sequence
from math import cos, pi, sqrt
from typing import NamedTuple

import numpy as np

from sandbox.editing.inserted_value_layout import plain
from sandbox.editing.suggested_checks.recogniser_input import (
    TOUCHING,
    Scene,
    Suggestion,
    as_factor,
    check,
    opposite,
    rate_of,
)
from sandbox.model.joint_ends_at_start import end_position
from sandbox.model.joints import Joint, Rod, Rope, points
from sandbox.model.level_parts import names_in

NEAR = 1e-4
"""The tolerance of the checks at the rate below: leapfrog is of second order."""

STEPS = 400
"""The number of steps in a period."""

WIDE = 1.8
"""rad, the largest amplitude at which the second iterate of the mean, (1 + √cos(θ0/2))²/4, is
accurate enough."""

SAME = 1e-9
"""m, the tolerance within which the length does not depend on the parameters."""

LARGEST, SMALLEST = 2.5, 1e-3
"""rad, the largest amplitude at which the closed form is accurate enough, and the smallest that is
not a rounding error."""


class Swing(NamedTuple):
    """A swing of a bob about a peg."""

    peg: complex
    """m, its position"""
    vector: complex
    """m, the vector from the peg to the bob"""

    @property
    def angle(self) -> float:
        """The angle from the vertical [rad]."""
        return abs(phase(self.vector * 1j))


def suggestions(scene: Scene) -> Iterator[Suggestion]:
    """Yield the closed forms for pendulums."""
    if scene.gravity_y is None:
        return
    if not scene.only("gravity", "contact", "friction", "restitution", "rotation"):
        return
    for name, joint in scene.level.joints.items():
        bob = bob_of(scene, joint)
        swings = [_swing(each, joint, bob) for each in scene.everywhere] if bob else []
        if bob and all(swings):
            yield _of(scene, name, bob, [swing for swing in swings if swing])


def _of(scene: Scene, name: str, bob: str, swings: Sequence[Swing]) -> Suggestion:
    """Return the suggestion for a pendulum, given its swing for each tried set of parameters."""
    assert scene.gravity_y is not None
    g, mass, (x, y) = opposite(scene.gravity_y), scene.mass(bob), scene.level.bodies[bob].position
    quarters = [
        _quarter(abs(swing.vector), swing.angle, -each.gravity_y(each.values))
        for swing, each in zip(swings, scene.everywhere, strict=True)
        if each.gravity_y
    ]
    energy = f"{mass}*{g}*{as_factor(y)}"
    checks = [check("energy", f"{bob}.energy", energy, NEAR, scale=f"{mass}*{g}")]
    (peg, vector), joint = swings[0], scene.level.joints[name]
    length = plain(abs(vector))
    if not names_in(joint) and all(abs(abs(one.vector) - abs(vector)) < SAME for one in swings):
        checks.append(check("length", f"{name}.length", f"{length!r}", 1e-10))
        near = not names_in((x, y)) or max(one.angle for one in swings) < WIDE
        if near and scene.duration > max(quarters):
            form = f"pi/2*sqrt({length!r}/{g})/{plain(_mean(1.0, cos(swings[0].angle / 2)))!r}"
            if names_in((x, y)):
                cosine = f"({plain(peg.imag)!r} - {as_factor(y)})/{length!r}"
                form = f"2*pi*sqrt({length!r}/{g})/(1 + ((1 + {cosine})/2)**0.25)**2"
            at = {"event": "crossing", "quantity": f"{bob}.position.x", "value": plain(peg.real)}
            checks.append(check("quarter of a period", "t", form, NEAR, at=at))
    return Suggestion("pendulum", (bob,), tuple(checks), rate_of(STEPS / (4 * min(quarters))))


def _swing(scene: Scene, joint: Joint, bob: str) -> Swing | None:
    """Return the swing of a bob; None if it is too small, too large or obstructed."""
    first, second = (
        end_position(end, scene.level.bodies, scene.values) for end in points(joint)[:2]
    )
    center = scene.where[bob].center
    peg = first if second == center else second
    found = Swing(peg, center - peg)
    others = [other for other in scene.where if other != bob]
    free = SMALLEST < found.angle < LARGEST and swings_free(scene, bob, *found, others)
    return found if free else None


def _quarter(length: float, angle: float, g: float) -> float:
    """Return a quarter of a period [s]."""
    return pi / 2 * sqrt(length / g) / _mean(1.0, cos(angle / 2))


def bob_of(scene: Scene, joint: Joint) -> str | None:
    """Return the body that hangs at rest by its centre from a point of the plane, or None."""
    if not isinstance(joint, Rod | Rope) or joint.length is not None:
        return None
    bob = scene.held_by(joint)
    return bob if bob and scene.is_at_rest(bob) else None


def swings_free(
    scene: Scene, bob: str, peg: complex, vector: complex, others: Iterable[str]
) -> bool:
    """Return whether a swing about a peg, from a vector [m] to its mirror image, is unobstructed.

    A string is taken to stay taut.
    """
    if scene.level.effects.contact is None:
        return True
    start, center = phase(vector * 1j), scene.where[bob].center
    turns = np.linspace(start, -start, 100).tolist()
    swing = [peg + rect(abs(vector), turn) / 1j - center for turn in turns]
    return all(scene.distance(bob, by, o) > TOUCHING for by in swing for o in others)


def _mean(one: float, other: float) -> float:
    """Return the arithmetic-geometric mean of two numbers."""
    for _ in range(6):
        one, other = (one + other) / 2, sqrt(one * other)
    return one
