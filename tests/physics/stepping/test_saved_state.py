"""A world that is put back into a saved state goes on with the same bits."""

import pytest

from sandbox.model import level_catalog
from sandbox.physics.measuring.recording import count_steps
from sandbox.physics.run import build
from sandbox.physics.stepping.saved_state import SavedState, can_be_saved, still
from sandbox.physics.stepping.world import World
from tests.levels.playing import fingerprint
from validation.case import textbook

MOST = 300
"""The largest number of steps of a run here."""

FURTHER = 100
"""The largest number of steps that are compared after a state was put back."""


def world_of(name: str) -> World:
    return build(textbook(name))


def states(world: World, steps: int) -> list[str]:
    """Take some steps, and return a value that identifies the state after each."""
    return [fingerprint(world.advance()) for _ in range(steps)]


def played(world: World) -> tuple[list[str], dict[int, SavedState]]:
    """Return the states of a run after each step, and some of them saved."""
    steps, found = min(count_steps(world), MOST), list[str]()
    saved: dict[int, SavedState] = {}
    for step in range(steps):
        if step in (0, 1, steps // 3, steps // 2, steps - 2):
            saved[step] = SavedState(world, before=next(reversed(saved.values()), None))
        found += states(world, 1)
    return found, saved


def assert_the_same_bits(name: str) -> None:
    world = world_of(name)
    found, saved = played(world)
    for step in (*reversed(saved), *saved):  # back, and ahead again
        saved[step].put_back()
        assert world.steps == step
        steps = min(FURTHER, len(found) - step)
        assert states(world, steps) == found[step : step + steps]


@pytest.mark.parametrize(
    "name",
    [
        "newton/atwood", "lagrange/double-pendulum", "newton/rocket", "energy/kepler-ellipse",
        "rotation/torsion-pendulum", "lagrange/rotating-hoop", "energy/spring-pendulum",
    ],
)  # fmt: skip
def test_a_world_that_is_put_back_takes_the_same_steps(name: str) -> None:
    assert_the_same_bits(name)


@pytest.mark.sweep
@pytest.mark.parametrize("name", level_catalog.names())
def test_every_world_that_can_be_saved_takes_the_same_steps(name: str) -> None:
    if can_be_saved(world_of(name)):
        assert_the_same_bits(name)


def test_what_has_not_changed_is_shared_by_saved_states() -> None:
    world = world_of("lagrange/double-pendulum")
    world.advance(10)
    first = SavedState(world)
    world.advance(10)

    second = SavedState(world, before=first)

    assert second.size < first.size / 2


@pytest.mark.sweep
def test_a_world_with_shapes_cannot_be_saved() -> None:
    """What pymunk keeps of contacts cannot be read, nor in which order it finds pairs."""
    assert not can_be_saved(world_of("hard/pyramid-of-20"))
    assert not can_be_saved(world_of("machines/wrecking-ball"))


def test_a_world_with_springs_can_be_saved() -> None:
    assert can_be_saved(world_of("lagrange/chain-of-springs"))


def test_a_world_that_a_hand_pulls_cannot_be_saved() -> None:
    world = world_of("newton/atwood")
    world.grab("left", (-0.6, 0.0))
    assert not can_be_saved(world)

    world.release()
    assert can_be_saved(world)


def test_a_world_that_is_still_shows_where_it_was_while_the_other_goes_on() -> None:
    world = world_of("newton/atwood")
    world.advance(10)

    shown = still(world)
    world.advance(10)

    assert (shown.steps, shown.t) == (10, 10 * world.dt)
    assert shown.snapshot.t == 10 * world.dt
    assert (shown.level, shown.values, shown.scene) == (world.level, world.values, world.scene)
