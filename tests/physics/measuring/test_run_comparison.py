"""Two runs are compared, and the costs of their steps."""

from collections.abc import Callable
from functools import partial

import numpy as np
import pytest

from sandbox.model import level_catalog
from sandbox.model.level import Level, Stepping
from sandbox.model.levels_with_changed_effects import including, without
from sandbox.model.loading import load
from sandbox.physics.measuring.run_comparison import Difference, compared_quantities, differences
from sandbox.physics.measuring.step_timing import Step, step_costs, step_seconds
from sandbox.physics.run import build, simulate


def named(name: str) -> Level:
    return load(level_catalog.find(name))


def compared(level: Level, other: Level, *, places: bool = False) -> dict[str, Difference]:
    names = compared_quantities(level)
    runs = (simulate(scene, record=names) for scene in (level, other))
    return {d.label or d.quantity: d for d in differences(*runs, positions=places)}


def test_a_run_does_not_differ_from_itself() -> None:
    level = named("rotation/rolling")

    assert all(d.fraction == 0 for d in compared(level, level, places=True).values())


def test_drag_takes_from_range_and_apex_what_it_takes() -> None:
    """At 45° and 25 m/s with c/m = 0.1/s; the range shrinks by a fifth."""
    level = named("kinematics/projectile")
    found = compared(level, including(level, "drag", {"linear": 0.1}))

    assert found["range"].first == pytest.approx(25**2 / 9.81, rel=1e-9)
    assert found["range"].relative == pytest.approx(-0.198, abs=1e-3)
    v, k, g = 25 / np.sqrt(2), 0.1, 9.81
    apex = v / k - g / k**2 * np.log(1 + k * v / g)  # of linear drag
    assert found["apex"].second == pytest.approx(apex, rel=1e-4)


def test_an_event_that_no_longer_comes_is_an_infinite_difference() -> None:
    level = named("kinematics/projectile")
    apex = compared(level, without(level, "gravity")[0])["apex"]

    assert (apex.second, apex.fraction, apex.relative) == (None, np.inf, None)
    assert apex.t[0] is not None
    assert apex.t[1] is None


def test_what_is_tiny_beside_the_rest_is_rounding() -> None:
    """Without drag the ball still falls along x = 0, up to the last digits."""
    level = named("kinematics/free-fall")
    found = compared(level, including(level, "drag", {"linear": 0.1}), places=True)
    sideways = next(d for d in found.values() if d.quantity.endswith("position.x"))

    assert sideways.fraction == 0


def test_no_world_is_timed_beyond_the_duration_of_its_level() -> None:
    """There the string's end runs into the pulley, and the slower run gets there first."""
    level = named("newton/atwood")
    rates = (240.0, 30.0)

    costs = step_costs(*(partial(build, level, stepping=Stepping(rate=rate)) for rate in rates))

    assert all(0 < cost < 1 for cost in costs)


def test_of_every_block_of_steps_the_quickest_counts() -> None:
    """Runs are repeated in turn, and each takes the requested number of steps."""
    calls: list[str] = []

    def starting(name: str) -> Callable[[], Step]:
        def start() -> Step:
            calls.append(name.upper())
            return lambda: calls.append(name)

        return start

    seconds = step_seconds([starting("a"), starting("b")], steps=30, repeats=2)

    assert "".join(calls) == ("A" + 30 * "a" + "B" + 30 * "b") * 2
    assert all(0 < value < 1 for value in seconds)
