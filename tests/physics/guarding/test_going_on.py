"""A run that the watchdog has stopped can continue if a person wants it to."""

import json

import numpy as np
import pytest

from sandbox.model.loading import parse
from sandbox.model.many_body_level_generator import crowd
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.stepping.world import World
from tests.physics.scenes import disc, level


def run(world: World, steps: int) -> None:
    """Look at every step."""
    for _ in range(steps):
        world.advance()


def stopped(world: World) -> SimulationError:
    """Take steps until a run is stopped."""
    with pytest.raises(SimulationError) as caught:
        run(world, 600)
    return caught.value


def test_a_gas_whose_discs_run_through_each_other_goes_on_as_pymunk_would() -> None:
    """At 60 Hz a disc of 0.1 m that has got fast goes through half another in a step."""
    world = build(parse(json.dumps(crowd("gas", 300))))

    assert "more than half its thickness" in str(stopped(world))
    at, doubted = world.t, world.doubted
    world.go_on()
    run(world, 60)

    assert doubted
    assert not world.doubted
    assert world.disturbed
    assert world.t == pytest.approx(at + 1)
    assert np.isfinite(world.snapshot.position).all()


def test_a_run_that_is_lost_does_not_go_on() -> None:
    """The force has no value after t = 0.5 s."""
    force = {"body": "a", "force": ["sqrt(0.5 - t)", 0]}
    world = build(level({"a": disc()}, {"force": [force]}, duration=0.4))

    stopped(world)

    assert not world.doubted


def test_one_that_goes_on_is_still_stopped_where_it_is_lost() -> None:
    world = build(parse(json.dumps(crowd("gas", 300))))
    stopped(world)
    world.go_on()
    world.scene.bodies["disc1"].velocity = (float("inf"), 0)

    assert "no longer finite" in str(stopped(world))
    assert not world.doubted
