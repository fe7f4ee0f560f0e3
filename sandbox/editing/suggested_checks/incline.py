"""A block on a slope: a = g (sin θ − μ cos θ) if tan θ > μ, else it holds; N = m g cos θ."""

from cmath import phase
from collections.abc import Callable, Iterator
from math import cos, sin

import numpy as np

from sandbox.editing.bodies_at_start import Core, PlacedBody
from sandbox.editing.formula_arithmetic import negative
from sandbox.editing.inserted_value_layout import plain
from sandbox.editing.suggested_checks.recogniser_input import (
    SAFE,
    SAMPLES,
    TOUCHING,
    Scene,
    Suggestion,
    as_factor,
    check,
    displaced,
    instant,
    opposite,
)
from sandbox.model.expressions import Expression
from sandbox.model.level_parts import names_in
from sandbox.model.shapes import Box, Polygon
from sandbox.physics.geometry.outline_distance import Gap, gap

EXACT = 1e-9
"""The tolerance of the checks: a uniform acceleration is exact to rounding."""

LEAST, MOST = 0.01, 1.5
"""rad, the range of slopes."""

HAIR = 1e-9
"""m, by which bodies that overlap by rounding are separated, to find the touching sides."""

FLAT = 1e-7
"""rad, the largest difference between the angles of a body and its slope."""

HALF = 0.6
"""The least share of a body's side on the slope, so that it does not tip over the end."""


def suggestions(scene: Scene) -> Iterator[Suggestion]:
    """Yield the closed forms for blocks that lie flat on a slope."""
    if scene.gravity_y is None or not scene.only("gravity", "contact", "friction", "rotation"):
        return
    if scene.level.effects.contact is None:
        return
    for name in scene.dynamic:
        block = scene.where[name]
        if scene.joints[name] or not isinstance(block.body.shape, Box | Polygon):
            continue
        found = [(s, n) for s in scene.where for n in _lies_on(scene, block, s)]
        if len(found) == 1 and scene.is_at_rest(name):
            yield from _of(scene, name, *found[0])


def _lies_on(scene: Scene, block: PlacedBody, slope: str) -> Iterator[complex]:
    """Yield the normal of a static slope on which a block lies flat."""
    under = scene.where[slope]
    if under.name == block.name or under.body.type != "static" or under.body.sensor:
        return
    for core in under.cores:
        for own in block.cores:
            found = side(own, core, under.radius)
            if abs(found.distance) < TOUCHING and len(found.points) == 2:
                yield -found.normal


def side(own: Core, core: Core, radius: float) -> Gap:
    """Return the gap and the ends of the touching side; these are known only without overlap.

    If a line is touched exactly, the normal may point to either side of it.
    """
    found = gap(own, core, radius)
    if found.distance > 0:
        return found
    back, forth = (
        gap(displaced(own, shift * found.normal), core, radius) for shift in (-HAIR, HAIR)
    )
    return back if back.distance > 0 or found.distance < 0 else forth


def _of(scene: Scene, name: str, slope: str, up: complex) -> Iterator[Suggestion]:
    fall, angle = scene.gravity_y, abs(phase(up / 1j))
    mu, theta = friction(scene, name, slope), _theta(scene, name, slope, angle)
    if fall is None or not LEAST < angle < MOST or mu is None or theta is None:
        return
    rubs = Expression(mu)(scene.known_values)
    along = -fall(scene.values) * (sin(angle) - rubs * cos(angle))
    g, weight = opposite(fall), f"{scene.mass(name)}*{opposite(fall)}"
    normal = f"{weight}*cos({theta})"
    if along <= 0:
        holds = f"{weight}*sin({theta})"
        valid = f"{mu} >= tan({theta})" if Expression(f"{mu}*{theta}").names else None
        held = (
            check("normal force", f"{name}.contact.normal", normal, EXACT, valid_if=valid),
            check("friction, holding", f"{name}.contact.friction", holds, EXACT, valid_if=valid),
        )
        yield Suggestion("block that a slope holds", (name, slope), held)
        return
    pull = f"sin({theta})" if mu == "0" else f"(sin({theta}) - {mu}*cos({theta}))"
    slides = Expression(pull)
    until = min(
        _until(each, name, slope, lambda t, a=a, down=down: down * a * t * t / 2)  # type: ignore[misc]
        for each in scene.everywhere
        if each.gravity_y and (a := -each.gravity_y(each.values) * slides(each.known_values)) > 0
        for down in _down(each, name, slope)
    )
    at = None if until == scene.duration else instant(SAFE * until)
    more = {"at": at, "valid_if": f"{pull} > 0" if slides.names else None}
    checks = (
        check("acceleration", f"{name}.acceleration", f"{g}*{pull}", EXACT, scale=g, **more),
        check("speed", f"{name}.speed", f"{g}*{pull}*t", EXACT, **more),
        check("normal force", f"{name}.contact.normal", normal, EXACT, **more),
    )
    yield Suggestion("block on a slope", (name, slope), checks)


def _down(scene: Scene, name: str, slope: str) -> Iterator[complex]:
    """Yield the unit vector down the slope, for the parameters of a scene."""
    for up in _lies_on(scene, scene.where[name], slope):
        yield up * (-1j if (up * 1j).imag > 0 else 1j)


def _theta(scene: Scene, name: str, slope: str, angle: float) -> str | None:
    """Return the slope's angle as a formula, that of the block if it has one; None if unknown."""
    own, under = scene.level.bodies[name].angle, scene.level.bodies[slope]
    if own.names and abs(own(scene.values) - angle) < FLAT:
        return str(own.source)
    if own.names and abs(own(scene.values) + angle) < FLAT:  # the slope rises to the left
        return str(negative(own))
    return None if names_in((under.shape, under.angle)) else repr(plain(angle))


def friction(scene: Scene, name: str, slope: str) -> str | None:
    """Return the pair's coefficient as a formula; None if set by pair or with static friction."""
    effect = scene.level.effects.friction
    if effect is None:
        return "0"
    if any(pair for pair in effect.pairs if set(pair.bodies) == {name, slope}):
        return None
    bodies = [scene.level.bodies[one] for one in (name, slope)]
    if any(body.static_friction is not None for body in bodies):
        return None
    own = [body.friction for body in bodies if body.friction is not None]
    return "*".join(as_factor(coefficient) for coefficient in own if coefficient.source != 1) or "1"


def _until(scene: Scene, name: str, slope: str, path: Callable[[float], complex]) -> float:
    """Return the time at which the block reaches the end of its slope or another body [s]."""
    free = scene.free_until(name, path, (slope,))
    whole = _length(scene, name, slope, 0j)
    for t in np.linspace(0, free, SAMPLES).tolist():
        if _length(scene, name, slope, path(t)) < HALF * whole:
            return t - free / (SAMPLES - 1)
    return free


def _length(scene: Scene, name: str, slope: str, displacement: complex) -> float:
    """Return the length of the side with which a displaced block lies on its slope [m]."""
    block, under = scene.where[name], scene.where[slope]
    found = [
        side(displaced(own, displacement), core, under.radius)
        for own in block.cores
        for core in under.cores
    ]
    nearest = min(found, key=lambda one: one.distance)
    return abs(nearest.points[-1] - nearest.points[0])
