"""Two weights on a rope of knots over a rough drum, which slips if m2 > m1 e^(μ φ).

If it slips, a = g (m2 − m1 e^(μ φ))/(m2 + m1 e^(μ φ)), and the ratio of tensions is e^(μ φ).
"""

from cmath import phase
from collections.abc import Iterator, Sequence
from itertools import pairwise
from math import pi, sqrt
from typing import Any, NamedTuple

from sandbox.editing.inserted_value_layout import plain
from sandbox.editing.suggested_checks.incline import friction
from sandbox.editing.suggested_checks.recogniser_input import (
    SAFE,
    TOUCHING,
    Scene,
    Suggestion,
    check,
    instant,
    opposite,
)
from sandbox.model.expressions import Expression
from sandbox.model.joints import Rod
from sandbox.model.level_parts import names_in
from sandbox.model.shapes import Disc

SLANT = 0.1
"""rad, the largest angle between a hanging end of the rope and the vertical."""

RUNS = 0.02
"""rad, the largest angle by which the rope may slip, so that its angle of wrap hardly changes."""

LEAST = 0.01
"""The least tolerance of the checks, as the knots form a polygon."""

LATEST = 0.2
"""s, the latest time of a check."""

EDGE = 0.03
"""The relative distance from the limit of slipping within which nothing is suggested."""

DIGITS = 9
"""Decimals of an angle of wrap [rad]."""


CheckFields = tuple[str, str, str, str | None]
"""The label, the quantity, the formula and the scale of a check."""


class Rope(NamedTuple):
    """A rope from the lighter weight over a drum to the heavier one."""

    ends: tuple[str, str]
    rods: tuple[str, str]
    """the rods that hold the weights"""
    knots: tuple[str, ...]
    drum: str
    wrap: float
    """rad, the angle of wrap"""


def suggestions(scene: Scene) -> Iterator[Suggestion]:
    """Yield the closed forms for ropes over static drums."""
    effects = scene.level.effects
    if scene.gravity_y is None or not scene.only("gravity", "contact", "friction", "restitution"):
        return
    drums = [name for name, body in scene.level.bodies.items() if body.type == "static"]
    drums = [name for name in drums if isinstance(scene.level.bodies[name].shape, Disc)]
    if not drums or effects.contact is None:
        return
    for name in scene.dynamic:
        for rope in _ropes(scene, name, drums):
            rubs = {friction(scene, knot, rope.drum) for knot in rope.knots}
            if len(rubs) == 1 and (mu := rubs.pop()) is not None:
                yield from _of(scene, rope, mu)


def _of(scene: Scene, rope: Rope, mu: str) -> Iterator[Suggestion]:
    """Yield the suggestion for a rope, unless it is close to the limit of slipping."""
    assert scene.gravity_y is not None
    g, (m1, m2) = opposite(scene.gravity_y), [scene.mass(name) for name in rope.ends]
    angle = "pi" if abs(rope.wrap - pi) < 10**-DIGITS else repr(plain(round(rope.wrap, DIGITS)))
    holding_mass = m1 if mu == "0" else f"{m1}*exp({mu}*{angle})"
    excess = Expression(f"{m2}/({holding_mass}) - 1")
    rough = mu != "0"
    if rough and abs(excess(scene.known_values)) < EDGE:
        return
    slips = not rough or excess(scene.known_values) > 0
    fields = _slipping(rope, m1, m2, holding_mass, g) if slips else _holding(rope, m1, m2, g)
    side = (
        f"{m2} > {1 + EDGE}*{holding_mass}"
        if slips
        else f"{m2} < {1 - EDGE}*{holding_mass} and {m1} <= {m2}"
    )
    until = min(_until(each, rope, holding_mass) for each in scene.everywhere)
    more: dict[str, Any] = {
        "tolerance": _close(scene, rope),
        "at": instant(until) if slips else None,
        "valid_if": side if rough and excess.names else None,
    }
    checks = tuple(
        check(label, quantity, formula, scale=scale, **more)
        for label, quantity, formula, scale in fields
    )
    yield Suggestion("capstan", (*rope.ends, rope.drum), checks)


def _slipping(rope: Rope, m1: str, m2: str, holding_mass: str, g: str) -> list[CheckFields]:
    """Return the checks of a rope that slips."""
    (light, heavy), (weak, strong) = rope.ends, rope.rods
    a, pull = (
        f"{g}*({m2} - {holding_mass})/({m2} + {holding_mass})",
        f"2*{m2}*{g}/({m2} + {holding_mass})",
    )
    return [
        ("acceleration", f"{heavy}.acceleration.y", f"-{a}", g),
        (f"pull on {heavy}", f"{strong}.tension", f"{pull}*{holding_mass}", None),
        (f"pull on {light}", f"{weak}.tension", f"{pull}*{m1}", None),
    ]


def _holding(rope: Rope, m1: str, m2: str, g: str) -> list[CheckFields]:
    """Return the checks of a rope that friction holds."""
    return [
        (f"pull on {end}, holding", f"{rod}.tension", f"{mass}*{g}", None)
        for end, rod, mass in zip(rope.ends, rope.rods, (m1, m2), strict=True)
    ]


def _close(scene: Scene, rope: Rope) -> float:
    """Return the tolerance, as the formula neglects the mass of the rope."""
    masses = [scene.level.bodies[name].mass for name in (rope.ends[0], *rope.knots)]
    lighter, *knots = (mass(scene.values) for mass in masses if mass is not None)
    return plain(float(f"{max(LEAST, sum(knots) / lighter):.1g}"))


def _ropes(scene: Scene, start: str, drums: Sequence[str]) -> Iterator[Rope]:
    """Yield the rope that begins at a hanging body, if this is the lighter one."""
    path, rods = _chain(scene, start)
    knots = path[1:-1]
    drum = next((d for d in drums if len(knots) > 1 and _lies(scene, knots, d)), None)
    if drum is None or not scene.is_at_rest(*path):
        return
    if names_in([scene.level.bodies[name].position for name in (*path, drum)]):
        return
    positions = [scene.where[name].center for name in path]
    directions = [b - a for a, b in pairwise(positions)]
    hang = abs(phase(directions[0] / 1j)), abs(phase(-directions[-1] / 1j))
    light, heavy = (scene.level.bodies[name].mass for name in (start, path[-1]))
    assert light is not None
    assert heavy is not None
    m1, m2 = light(scene.values), heavy(scene.values)
    if max(hang) < SLANT and (m1 < m2 or (m1 == m2 and start < path[-1])):
        wrap = abs(sum(phase(b / a) for a, b in pairwise(directions)))
        yield Rope((start, path[-1]), (rods[0], rods[-1]), tuple(knots), drum, wrap)


def _chain(scene: Scene, start: str) -> tuple[list[str], list[str]]:
    """Return the bodies and rods of the chain from a body to its other end; none if incomplete."""
    path, rods = [start], list[str]()
    while len(scene.joints[path[-1]]) == (2 if rods else 1):
        (name,) = (one for one in scene.joints[path[-1]] if one not in rods[-1:])
        rod = scene.level.joints[name]
        if not isinstance(rod, Rod) or rod.length is not None:
            return [], []
        ends = [end for end in rod.ends if end != path[-1]]
        if len(ends) != 1 or not isinstance(ends[0], str):
            return [], []
        path.append(ends[0])
        rods.append(name)
    ended = len(scene.joints[path[-1]]) == 1 and len(rods) > 1
    return (path, rods) if ended else ([], [])


def _lies(scene: Scene, knots: Sequence[str], drum: str) -> bool:
    """Return whether all knots touch a drum."""
    around = scene.where[drum]
    return all(
        isinstance(scene.level.bodies[name].shape, Disc)
        and abs(abs(knot.center - around.center) - knot.radius - around.radius) < TOUCHING
        for name, knot in ((name, scene.where[name]) for name in knots)
    )


def _until(scene: Scene, rope: Rope, holding_mass: str) -> float:
    """Return a time before which nothing is met, and the rope has hardly slipped [s]."""
    g, (_, m2) = opposite(scene.gravity_y or Expression("0")), (scene.mass(n) for n in rope.ends)
    a = Expression(f"{g}*({m2} - {holding_mass})/({m2} + {holding_mass})")(scene.known_values)
    if not a:
        return LATEST
    free = (
        scene.free_until(name, lambda t, way=direction: way * a * t * t / 2, rope.knots)  # type: ignore[misc]
        for name, direction in zip(rope.ends, (1j, -1j), strict=True)
    )
    return min(SAFE * min(free), sqrt(2 * RUNS * scene.where[rope.drum].radius / abs(a)), LATEST)
