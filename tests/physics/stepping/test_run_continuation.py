"""A world that continues from the state of another one, with other parameters."""

import numpy as np
import pytest

from sandbox.model import level_catalog
from sandbox.model.errors import SandboxError
from sandbox.model.loading import load
from sandbox.model.parameters_changeable_in_run import obstacle
from sandbox.physics.run import build
from sandbox.physics.stepping.run_continuation import branch
from sandbox.physics.stepping.world import World

SAME = [
    ("newton/atwood", 1e-12),
    ("newton/double-atwood", 1e-12),
    ("newton/incline-with-friction", 1e-12),
    ("momentum/sticking", 1e-12),
    ("rotation/motor", 1e-12),
    ("machines/engine", 1e-12),
    ("energy/kepler-ellipse", 1e-12),
    ("lagrange/double-pendulum", 1e-9),
    ("newton/projectile-with-drag", 1e-6),
]
"""Levels, and how far a branch in which nothing changes may be off after as long again [m].

A drag is judged by a velocity that is known better when the step before is: 1e-8 was seen."""


def half_way(name: str) -> World:
    """Return a level's world in the middle of its duration."""
    level = load(level_catalog.find(name))
    world = build(level)
    world.advance(max(round(level.duration(level.defaults) / world.dt) // 2, 1))
    return world


@pytest.mark.parametrize(("name", "most"), SAME)
def test_where_nothing_changes_the_branch_is_the_same_run(name: str, most: float) -> None:
    world = half_way(name)
    other = branch(world, world.values)
    steps = min(world.steps - 1, 150)

    world.advance(steps)
    other.advance(steps)

    assert other.t == world.t
    assert other.snapshot.position == pytest.approx(world.snapshot.position, abs=most)


def fallen(world: World, g: float, *, naive: bool) -> float:
    """Return the error of a branch with another gravity after a second, by the closed form [m]."""
    before = world.snapshot
    values = {**world.values, "g": g}
    other = branch(world, values)
    if naive:  # the velocities that pymunk has, half a kick ahead
        other.scene.batch.set_velocity(world.scene.batch.velocity())
    rate = round(1 / world.dt)
    other.advance(rate // 2)
    t = other.t - world.t
    at, v = before.position[:, 1], before.velocity[:, 1]
    moving = world.scene.mass > 0
    expected = at + v * t - g * t * t / 2
    return float(np.abs(other.snapshot.position[:, 1] - expected)[moving].max())


def test_the_new_force_acts_from_the_state_at_the_step() -> None:
    world = half_way("kinematics/projectile")

    assert fallen(world, 3.0, naive=False) < 1e-12  # 7e-15 was seen
    missed = (world.values["g"] - 3.0) * world.dt / 2 * 0.5
    assert fallen(world, 3.0, naive=True) == pytest.approx(missed, rel=1e-6)


def test_the_world_that_is_left_stays_as_it_is() -> None:
    world, same = half_way("kinematics/projectile"), half_way("kinematics/projectile")

    branch(world, {**world.values, "g": 1.0}).advance(10)
    world.advance(10)
    same.advance(10)

    assert world.snapshot.position.tobytes() == same.snapshot.position.tobytes()


def test_a_motor_goes_on_from_where_it_has_turned_to() -> None:
    world = half_way("rotation/motor")
    name = next(iter(world.level.parameters))
    assert obstacle(world.level, [name]) is None
    before = world.snapshot.angle

    other = branch(world, {**world.values, name: world.values[name] * 1.5})
    other.advance(1)

    turned = np.abs(other.snapshot.angle - before).max()
    assert turned < 3 * np.abs(world.snapshot.angular_velocity).max() * world.dt


@pytest.mark.parametrize(
    ("name", "parameter", "told"),
    [
        ("kinematics/projectile", "speed", "only its start or what is displayed"),
        ("lagrange/simple-pendulum", "L", "assembled at the start"),
        ("newton/incline", "angle", "part of a shape"),
        ("machines/cam", "n", "determines where a body is moved to"),
        ("newton/rocket", "burn", "determines how masses have changed"),
    ],
)
def test_what_cannot_change_on_the_way_is_told(name: str, parameter: str, told: str) -> None:
    world = half_way(name)
    values = {**world.values, parameter: world.values[parameter] * 1.01}

    with pytest.raises(SandboxError, match=told) as refused:
        branch(world, values)
    assert parameter in str(refused.value)
