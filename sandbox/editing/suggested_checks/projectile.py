"""A thrown body: x = x0 + vx t, y = y0 + vy t − g t²/2, until it meets another."""

from collections.abc import Iterator

from sandbox.editing.suggested_checks.recogniser_input import (
    SAFE,
    Scene,
    Suggestion,
    as_factor,
    check,
    instant,
    opposite,
)
from sandbox.model.expressions import Expression

EXACT = 1e-10
"""The tolerance of the checks: a uniform acceleration is exact to rounding."""

SHORTEST = 0.05
"""s, the shortest flight that gets a check."""


def suggestions(scene: Scene) -> Iterator[Suggestion]:
    """Yield the closed forms for bodies in free flight."""
    fall = scene.gravity_y
    if fall is None or not scene.only("gravity", "contact", "friction", "restitution", "rotation"):
        return
    for name in scene.dynamic:
        if scene.joints[name]:
            continue
        free = min(_free(each, name, fall) for each in scene.everywhere)
        if free < SHORTEST:
            continue
        body = scene.level.bodies[name]
        at = None if free == scene.duration else instant(SAFE * free)
        x, y = map(as_factor, body.position)
        u, w = map(as_factor, body.velocity)
        g = opposite(fall)
        yield Suggestion(
            "thrown body" if scene.velocity(name) else "falling body",
            (name,),
            (
                check("distance", f"{name}.position.x", f"{x} + {u}*t", EXACT, at=at),
                check("height", f"{name}.position.y", f"{y} + {w}*t - {g}*t**2/2", EXACT, at=at),
                check("rise", f"{name}.velocity.y", f"{w} - {g}*t", EXACT, at=at),
            ),
        )


def _free(scene: Scene, name: str, fall: Expression) -> float:
    """Return the duration of the free flight of a body [s]."""
    v, half = scene.velocity(name), complex(0, fall(scene.values) / 2)
    return scene.free_until(name, lambda t: v * t + half * t * t)
