"""The cost of effects: every level compared with the bare engine, and effects on many bodies."""

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from sandbox.model import effects, level_catalog, levels_with_changed_effects
from sandbox.model.contact_solver_choice import is_direct
from sandbox.model.level import Level
from sandbox.model.level_writing import text
from sandbox.model.loading import load, parse
from sandbox.model.many_body_level_generator import crowd
from sandbox.model.shapes import Arc, Curve
from sandbox.physics.measuring.recording import count_steps
from sandbox.physics.measuring.step_timing import STEPS, Step, step_seconds
from sandbox.physics.run import build
from sandbox.physics.stepping.world import World

COUNTS = (1, 10, 100, 1000, 10_000)
"""The numbers of bodies for which an effect's cost is measured."""

QUICK = COUNTS[:3]

DECLARED: Mapping[str, object] = {
    **levels_with_changed_effects.DEFAULTS,
    "friction": {},
    "restitution": {},
    "attraction": [{"mu": 1, "center": [-50, -50]}],
    "centrifugal": {"rate": 0.1},
    "force": [{"body": "disc1", "force": [1, 0]}],
    "thrust": [{"body": "disc1", "exhaust": [0, -1], "rate": 1e-3, "propellant": 0.5}],
    "accretion": [{"body": "disc1", "rate": 1e-3}],
    "belt": [{"body": "walls", "velocity": [0.1, 0]}],
    "gravitation": {"constant": 1e-6, "softening": 1},
}
"""Every effect that is measured, with its trial settings or with those given here; an effect that
names a body acts on one."""

ALONE = tuple(name for name in DECLARED if effects.EFFECTS[name].is_force)
"""The effects that require no other effect."""

LAWS = ("attraction", "drag", "force")
"""Force laws that are also measured together, since they share one hook."""

EFFECTS: Mapping[str, tuple[str, ...]] = {
    **{name: (name,) for name in ALONE},
    "contact": ("contact",),
    "friction": ("contact", "friction"),
    "restitution": ("contact", "restitution"),
    "rotation": ("contact", "rotation"),
    " + ".join(LAWS): LAWS,
    "belt": ("contact", "friction", "belt"),
}
"""The effects that are declared to measure one effect, or several together."""

BASE = {"rotation": "contact", "friction": "contact", "restitution": "contact", "belt": "friction"}
"""The effect relative to which another's cost is measured; for all others it is relative to an
empty scene."""

ALL_PAIRS: Mapping[str, tuple[int, int]] = {"gravitation": (2, 1000)}
"""The fewest and the most bodies for effects between every two: 10,000 bodies take a second per
step."""


@dataclass(frozen=True, slots=True)
class LevelCost:
    """The cost of a step of a level, compared with the bare engine."""

    level: str
    effects: tuple[str, ...]
    joints: tuple[str, ...]
    """The name of the level, and what it declares."""
    ways: tuple[str, ...]
    """The reasons why pymunk's own effects call Python, in a few words each."""
    hooks: int
    """The number of Python callbacks per step."""
    step_seconds: float
    """The time of `World.step` [s]."""
    bare_step_seconds: float
    """The time of `Space.step` in the same scene without the hook [s]: the work of pymunk itself,
    including its own springs and joints. The hook stays for pairs with a coefficient of their own.
    """
    ratio: float
    """The ratio of the first time to the second."""


@dataclass(frozen=True, slots=True)
class EffectCost:
    """The time that an effect adds to a step, for several numbers of bodies."""

    effect: str
    """The name of the effect, or of several that act together."""
    bodies: tuple[int, ...]
    """(k,), the numbers of moving bodies."""
    step_seconds: tuple[float, ...]
    """(k,), the time of a step with it [s]."""
    seconds_per_step: tuple[float, ...]
    """(k,), the time that it adds to a step [s]; negative within the noise if it adds none."""
    exponent: float | None
    """p of the fit time ~ n^p to the whole step from 100 bodies on; None if there are too few."""


def level_costs(names: Sequence[str] | None = None, repeats: int = 5) -> Iterator[LevelCost]:
    """Measure levels, by default all of the catalog, and compare them with the bare engine."""
    for name in level_catalog.textbook() if names is None else names:
        level = load(level_catalog.find(name))
        world = build(level)
        steps = max(min(count_steps(world), STEPS), 1)
        ours, bare = step_seconds([_stepping(level), _bare(level)], steps, repeats)
        joints = tuple(dict.fromkeys(joint.type for joint in level.joints.values()))
        declared, ways = level.effects.declared, _ways(level)
        yield LevelCost(name, declared, joints, ways, world.hooks, ours, bare, ours / bare)


def _ways(level: Level) -> tuple[str, ...]:
    """Return the reasons why pymunk's own effects call Python."""
    contact, friction = level.effects.contact, level.effects.friction
    taken = {
        "located impacts": contact and contact.located,
        "impacts in sequence": level.effects.in_sequence,
        "located ends of slipping": friction and friction.located,
        "static friction": any(body.static_friction for body in level.bodies.values()),
        "friction of pairs": friction and friction.pairs,
        "arcs": contact and any(isinstance(b.shape, Arc) for b in level.bodies.values()),
        "curves": contact and any(isinstance(b.shape, Curve) for b in level.bodies.values()),
        "contacts solved directly": is_direct(level),
    }
    return tuple(way for way, is_taken in taken.items() if is_taken)


def _stepping(level: Level) -> Callable[[], Step]:
    return lambda: build(level).step


def _bare(level: Level) -> Callable[[], Step]:
    """Return a maker of the same scene, whose steps contain nothing but pymunk."""

    def start() -> Step:
        world = build(level)
        unhook(world)
        space, dt = world.scene.space, world.dt
        return lambda: space.step(dt)

    return start


def unhook(world: World) -> None:
    """Remove the hook from a world's space: the one joint without strength; others stay."""
    space = world.scene.space
    space.remove(*(joint for joint in space.constraints if joint.max_force == 0))


def effect_costs(counts: Sequence[int] = COUNTS, repeats: int = 5) -> list[EffectCost]:
    """Measure the time that effects add to a step of a gas, for several numbers of bodies."""
    found: dict[str, dict[int, float]] = {}
    for count in counts:
        scenes = {"nothing": (), **_measurable(count)}
        whole = _gas(count, {name for names in scenes.values() for name in names})
        steps = [build(_declaring(whole, names)).step for names in scenes.values()]
        starts = [lambda step=step: step for step in steps]  # each continues its own run
        seconds = step_seconds(starts, STEPS if count < 1000 else 20, repeats)
        for name, value in zip(scenes, seconds, strict=True):
            found.setdefault(name, {})[count] = value
    return [_effect_cost(name, found) for name in EFFECTS if name in found]


def _measurable(count: int) -> dict[str, tuple[str, ...]]:
    """Return the effects that can act on a number of bodies."""
    ranges = {name: ALL_PAIRS.get(name, (1, count)) for name in EFFECTS}
    return {n: EFFECTS[n] for n, (least, most) in ranges.items() if least <= count <= most}


def _gas(count: int, effects: Collection[str]) -> Level:
    """Return a gas that declares effects."""
    declared = {name: said for name, said in DECLARED.items() if name in effects}
    document = {**crowd("gas", count), "effects": declared, "checks": []}
    bodies: Mapping[str, Any] = document["bodies"]
    rubbing = {name: {**body, "friction": 0.5} for name, body in bodies.items()}
    return parse(text({**document, "bodies": rubbing}))


def _declaring(level: Level, names: Sequence[str]) -> Level:
    """Return a level that declares only the given effects."""
    others = {name: None for name in level.effects.declared if name not in names}
    return level.model_copy(update={"effects": level.effects.model_copy(update=others)})


def _effect_cost(name: str, seconds: Mapping[str, Mapping[int, float]]) -> EffectCost:
    counts, whole = zip(*seconds[name].items(), strict=True)
    base = seconds[BASE.get(name, "nothing")]
    added = tuple(seconds[name][count] - base[count] for count in counts)
    return EffectCost(name, counts, whole, added, exponent(counts, whole))


def exponent(counts: Sequence[int], seconds: Sequence[float]) -> float | None:
    """Return p of the least-squares fit time ~ n^p, from 100 bodies on."""
    pairs = [(n, s) for n, s in zip(counts, seconds, strict=True) if n >= 100 and s > 0]
    if len(pairs) < 2:
        return None
    n, s = np.log(np.array(pairs)).T
    return float(np.polyfit(n, s, 1)[0])
