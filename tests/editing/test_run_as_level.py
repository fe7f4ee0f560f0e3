"""A level made from the state of a run continues that run as if nothing had happened."""

import numpy as np
import pytest

from sandbox.editing.run_as_level import as_it_stands
from sandbox.model import level_catalog
from sandbox.model.errors import SandboxError
from sandbox.model.loading import load, parse
from sandbox.physics.run import build
from sandbox.physics.stepping.run_continuation import alter, branch
from sandbox.physics.stepping.world import World

STEPS = 12

LEVELS = (
    *("kinematics/projectile", "newton/atwood", "newton/incline", "rotation/door"),
    *("machines/flywheel", "momentum/cradle", "energy/spring-oscillator"),
)

PILES = 2e-3
"""m: what pymunk solves in turns forgets the impulses that it remembered, as in a branch."""


def stood(name: str) -> World:
    world = build(load(level_catalog.find(name)))
    world.advance(STEPS)
    return world


@pytest.mark.parametrize("name", LEVELS)
def test_what_is_not_changed_goes_on_as_a_branch_does(name: str) -> None:
    world = stood(name)
    text = as_it_stands(world, anew=False)
    altered, branched = alter(world, parse(text)), branch(world, world.values)

    assert altered.steps == STEPS
    assert np.array_equal(altered.snapshot.position, world.snapshot.position)
    before = (altered.advance(STEPS), branched.advance(STEPS), world.advance(STEPS))
    mine, others, whole = (state.position for state in before)
    off = np.abs(others - whole).max()
    assert np.abs(mine - whole).max() <= 2 * off + 1e-9


@pytest.mark.parametrize("name", LEVELS[::2])
def test_a_run_that_is_kept_as_a_level_goes_on_from_there_in_its_own_time(name: str) -> None:
    world = stood(name)
    kept = build(parse(as_it_stands(world, anew=True)))
    assert kept.steps == 0
    gone = np.abs(kept.advance(STEPS).position - world.advance(STEPS).position).max()
    assert gone <= PILES * max(np.abs(world.snapshot.position).max(), 1e-3)


def test_joints_stay_as_long_as_they_were_and_places_that_fit_are_fixed() -> None:
    world = stood("momentum/cradle")
    level = parse(as_it_stands(world, anew=True))

    assert list(level.joints) == list(world.level.joints)
    assert [joint.length({}) for joint in level.joints.values()] == [1] * 5  # type: ignore[union-attr, misc]
    assert set(level.parameters) == {"g"}
    assert (level.checks, level.ghosts) == ((), {})


def test_a_force_that_changes_with_time_is_as_far_ahead() -> None:
    text = """{"format": 1, "title": "Push", "bodies": {"a": {"shape": {"type": "disc",
        "radius": 1}, "mass": 1}}, "effects": {"force": [{"body": "a", "force": ["t**2", 0]}]}}"""
    world = build(parse(text))
    world.advance(60)
    kept = build(parse(as_it_stands(world, anew=True)))

    there, here = world.advance(30), kept.advance(30)
    assert here.velocity[0, 0] == pytest.approx(there.velocity[0, 0], rel=1e-9)


def test_masses_that_have_flowed_are_refused_with_the_reason() -> None:
    with pytest.raises(SandboxError, match="'thrust' has changed masses"):
        as_it_stands(stood("newton/rocket"), anew=True)
