"""A head-on collision: momentum is conserved, and the relative speed is multiplied by e."""

from collections.abc import Iterator
from itertools import combinations

from sandbox.editing.suggested_checks.recogniser_input import (
    TOUCHING,
    Scene,
    Suggestion,
    as_factor,
    check,
)
from sandbox.model.shapes import Disc

EXACT = 1e-10
"""The tolerance of the checks: impacts are exact to rounding."""


def suggestions(scene: Scene) -> Iterator[Suggestion]:
    """Yield the closed forms for two bodies that are alone and collide along x."""
    if not scene.level.effects.contact or not scene.only("contact", "restitution", "rotation"):
        return
    for one, other in combinations(scene.dynamic, 2):
        if len(scene.dynamic) == 2 and _meet(scene, one, other):
            yield _of(scene, one, other)


def _meet(scene: Scene, one: str, other: str) -> bool:
    """Return whether two discs or boxes collide on the line of their centres, and nothing else."""
    a, b = scene.where[one], scene.where[other]
    u, v = scene.velocity(one), scene.velocity(other)
    if scene.joints[one] or scene.joints[other] or u.imag or v.imag:
        return False
    round_ones = all(isinstance(body.body.shape, Disc) for body in (a, b))
    if a.center.imag != b.center.imag or not (round_ones or not scene.level.effects.rotation):
        return False
    left, right = (a, b) if a.center.real < b.center.real else (b, a)
    closing = scene.velocity(left.name).real - scene.velocity(right.name).real
    gap = right.bounds[0].real - left.bounds[1].real
    if closing <= 0 or gap <= TOUCHING or gap / closing > 0.9 * scene.duration:
        return False
    free = (
        scene.free_until(name, lambda t, w=w: w * t, (one, other))  # type: ignore[misc]
        for name, w in ((one, u), (other, v))
    )
    return min(free) > gap / closing


def _of(scene: Scene, one: str, other: str) -> Suggestion:
    m1, m2 = scene.mass(one), scene.mass(other)
    v1, v2 = (as_factor(scene.level.bodies[name].velocity[0]) for name in (one, other))
    e = restitution(scene, one, other)
    at = {"event": "contact", "bodies": [one, other]}
    total = f"{m1}*{v1} + {m2}*{v2}"
    after = [
        f"({total} - {m2}*{e}*({v1} - {v2}))/({m1} + {m2})",
        f"({total} + {m1}*{e}*({v1} - {v2}))/({m1} + {m2})",
    ]
    speed = f"abs({v1} - {v2})"
    names = zip((one, other), after, strict=True)
    checks = [check("momentum", "system.momentum.x", total, EXACT, at=at, scale=f"{m1}*{speed}")]
    checks += [
        check(f"{name}, after", f"{name}.velocity.x", form, EXACT, at=at, scale=speed)
        for name, form in names
    ]
    return Suggestion("collision", (one, other), tuple(checks))


def restitution(scene: Scene, one: str, other: str) -> str:
    """Return the coefficient of a pair: that given for it, else the product of the bodies'."""
    effect = scene.level.effects.restitution
    if effect is None:
        return "0"
    for pair in effect.pairs:
        if set(pair.bodies) == {one, other}:
            return as_factor(pair.coefficient)
    own = [scene.level.bodies[name].restitution for name in (one, other)]
    return "*".join(as_factor(coefficient) for coefficient in own if coefficient is not None)
