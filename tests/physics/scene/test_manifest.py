"""The manifest decides what exists: what a level does not declare is not there, and not missed."""

import tracemalloc
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sandbox.model.effects import EFFECTS
from sandbox.model.level import Level
from sandbox.model.levels_with_changed_effects import without
from sandbox.physics.run import build
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.world import World
from tests.effects import idle
from tests.elsewhere import python
from tests.physics.scenes import GRAVITY, Spec, disc, floor, level, run

LAWS = {effect.name for effect in EFFECTS.values() if effect.is_law}
"""The modules of the laws that a level declares as effects."""

STRONG = [e for e in EFFECTS.values() if e.is_force and e.strength and not e.changes_mass]

ZERO: Mapping[str, Any] = {
    **{effect.name: idle(effect.name) for effect in STRONG},
    "friction": {},
    "drag": {"linear": "c"},  # a zero of its own is refused: it would be declared for nothing
}
"""Effects without strength; those of surfaces have it in the bodies."""

SCRIPT = """
import sys
from sandbox.physics.run import build
from tests.effects import idle
from tests.elsewhere import python
from tests.physics.scenes import disc, level
build(level({"a": disc(), "b": disc((3, 0))}, %r)).advance(3)
prefix = "sandbox.physics.forces."
print(*sorted(name.removeprefix(prefix) for name in sys.modules if name.startswith(prefix)))
"""


@pytest.mark.sweep
@pytest.mark.parametrize(
    ("effects", "loaded"),
    [
        ({}, set()),
        ({**GRAVITY, "contact": {}}, set()),
        ({"drag": {"linear": 1}}, {"drag"}),
        ({"attraction": [{"mu": 1, "center": [9, 9]}]}, {"attraction"}),
        ({"force": [{"body": "a", "force": [1, 0]}]}, {"force"}),
    ],
    ids=["nothing", "gravity and contact", "drag", "attraction", "force"],
)
def test_only_the_laws_that_a_scene_declares_are_loaded(effects: Spec, loaded: set[str]) -> None:
    done = python("-c", SCRIPT % effects)

    assert done.returncode == 0, done.stderr
    assert set(done.stdout.split()) & LAWS == loaded


numbers = st.floats(-3, 3).map(lambda x: round(x, 3))
masses = st.sampled_from([0.1, 1.0, 7.5])


@st.composite
def scenes(draw: st.DrawFn) -> tuple[dict[str, Spec], Spec]:
    """Two or three discs above a floor that move anyhow, and what acts on them."""
    bodies = {
        name: disc(
            (3 * i, 1 + abs(draw(numbers))),
            mass=draw(masses),
            velocity=[draw(numbers), draw(numbers)],
            restitution=draw(st.sampled_from([0.0, 0.5, 1.0])),
        )
        for i, name in enumerate("abc"[: draw(st.integers(2, 3))])
    }
    contact = {"solver": "iterative"}  # what is declared chooses it otherwise, not its strength
    effects: Spec = {"contact": contact, "restitution": {}, **draw(st.sampled_from([{}, GRAVITY]))}
    return {**bodies, "floor": floor(restitution=1)}, effects


def moved(scene: Level) -> Snapshot:
    return run(build(scene), 40)


def same(one: Snapshot, other: Snapshot) -> bool:
    names = ("position", "velocity", "angle", "angular_velocity", "acceleration", "normal")
    return all(getattr(one, name).tobytes() == getattr(other, name).tobytes() for name in names)


@pytest.mark.sweep
@pytest.mark.parametrize("effect", ZERO)
@settings(max_examples=10, deadline=None)
@given(scene=scenes())
def test_an_effect_without_strength_changes_no_bit(
    effect: str, scene: tuple[dict[str, Spec], Spec]
) -> None:
    bodies, effects = scene
    if effect in effects:
        return
    if EFFECTS[effect].exerts_torque:
        effects = {**effects, "rotation": {}}
    bare = level(bodies, effects)
    rub = {"friction": 0} if effect == "friction" else {}
    bodies = {name: {**body, **rub} for name, body in bodies.items()}
    none = {"parameters": {"c": {"value": 0, "min": 0, "max": 1}}} if effect == "drag" else {}
    full = level(bodies, {**effects, effect: ZERO[effect]}, **none)
    one, other = moved(bare), moved(full)

    assert np.array_equal(one.position, other.position)
    assert np.array_equal(one.velocity, other.velocity)
    assert np.array_equal(one.acceleration, other.acceleration)


@pytest.mark.sweep
@settings(max_examples=10, deadline=None)
@given(scene=scenes(), linear=st.floats(0.1, 5))
def test_an_effect_switched_off_is_an_effect_never_declared(
    scene: tuple[dict[str, Spec], Spec], linear: float
) -> None:
    bodies, effects = scene
    bare = level(bodies, effects)
    full = level(bodies, {**effects, "drag": {"linear": linear}})
    less, _ = without(full, "drag")

    assert build(less).hooks == 0
    assert same(moved(less), moved(bare))
    assert build(full).hooks == 1


def memory(world: World, steps: int = 100) -> tuple[int, int]:
    """Return by how much steps grow Python's memory, and the most that one takes [bytes].

    The least of three tries: other threads allocate as well.
    """
    found = []
    for _ in range(3):
        tracemalloc.start()
        world.step()
        before, _ = tracemalloc.get_traced_memory()
        tracemalloc.reset_peak()
        for _ in range(steps):
            world.step()
        after, most = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        found.append((after - before, most - before))
    return min(found)


def row(count: int, effects: Spec) -> World:
    world = build(level({f"b{i}": disc((3 * i, 9)) for i in range(count)}, {**GRAVITY, **effects}))
    for _ in range(50):
        world.step()
    return world


@pytest.mark.parametrize("count", [2, 300])
def test_a_step_without_laws_allocates_nothing_that_grows_with_the_bodies(count: int) -> None:
    """336 bytes for any number of bodies: the counter of steps, and what pymunk's call takes."""
    growth, most = memory(row(count, {"contact": {"solver": "iterative"}}))

    assert growth <= 64  # 0; the counter may need another digit
    assert most < 512


LINEAR: Spec = {"drag": {"linear": 0.1}}


@pytest.mark.parametrize("effects", [LINEAR, {**LINEAR, "attraction": [{"mu": 1}]}])
def test_laws_allocate_what_they_give_back(effects: Spec) -> None:
    """18 numbers a body at a time and 2 kB, whether there is one law or two, and none is kept."""
    few, many = (memory(row(count, effects)) for count in (2, 300))

    assert max(few[0], many[0]) <= 96  # 32: the time of the last kick
    assert few[1] < 8000
    assert many[1] - few[1] < 20 * 8 * 298


@settings(max_examples=10, deadline=None)
@given(scene=scenes(), linear=st.floats(0.1, 5))
def test_an_effect_on_one_body_touches_no_other(
    scene: tuple[dict[str, Spec], Spec], linear: float
) -> None:
    """Nothing meets: without contact the others move on to the last bit."""
    bodies, effects = scene
    kept = {name: effects[name] for name in effects if name == "gravity"}
    free = {
        name: {key: part for key, part in body.items() if key != "restitution"}
        for name, body in bodies.items()
    }
    alone = moved(level(free, {**kept, "drag": {"linear": linear, "bodies": ["a"]}}))
    without_it = moved(level(free, kept))

    assert np.array_equal(alone.position[:, 1:], without_it.position[:, 1:])
    assert np.array_equal(alone.velocity[:, 1:], without_it.velocity[:, 1:])
