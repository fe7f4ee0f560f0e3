"""The estimate of a run's numerical error."""

from math import pi

import numpy as np
import pytest

from sandbox.model.level import Stepping
from sandbox.physics.accuracy.compared_runs import checked, largest_difference, record
from sandbox.physics.accuracy.error_estimate import estimate
from tests.physics.accuracy.test_requested_accuracy import (
    catalog_level,
    check,
    delivered,
    oscillator,
)
from tests.physics.scenes import GRAVITY, disc, level


def test_what_is_exact_is_off_by_rounding_and_shows_no_order() -> None:
    scene = level({"ball": disc(velocity=[3, 8])}, GRAVITY, duration=1)
    found = estimate(scene)

    assert len(found) == 4  # positions and velocities
    for each in found:
        assert each is not None
        assert each.error < 1e-12
        assert each.order is None


def test_an_instant_that_never_comes_has_no_error() -> None:
    never = {"event": "landing", "body": "ball", "height": -99}
    scene = level({"ball": disc()}, GRAVITY, duration=1, checks=[check("ball.speed", "1", never)])

    assert estimate(scene) == (None,)


def test_what_comes_back_to_zero_is_off_by_its_own_value() -> None:
    """No error is relative to a value that is zero except for the error itself."""
    scene = level(
        {"planet": disc((1, 0), radius=0.05, velocity=[0, 1])},
        {"attraction": [{"mu": 1}]},
        checks=[check("planet.position.y", "0", 2 * pi)],
        duration=6.4,
    )
    [found] = estimate(scene, stepping=Stepping(rate=60))

    assert found is not None
    assert found.error == found.difference
    assert found.error == pytest.approx(delivered(scene, Stepping(rate=60)), rel=0.03)


@pytest.mark.sweep
def test_an_instant_near_the_end_is_read_off_equal_steps() -> None:
    """A run observed at every second step does not end with half of one: it was off by 8e-5."""
    scene = catalog_level("energy/figure-eight")
    wanted = [item for item in checked(scene, scene.defaults) if item.at is not None]
    stepping = Stepping(rate=600, scheme="fourth-order")
    seldom = record(scene, scene.defaults, stepping, wanted, observation_rate=240)
    always = record(scene, scene.defaults, stepping, wanted, observation_rate=600)

    assert wanted
    for item in wanted:
        assert largest_difference(seldom, always, item) == pytest.approx(0, abs=1e-8)
    assert np.ptp(np.diff(seldom.t)) < 1e-12


@pytest.mark.parametrize("rate", [30, 60, 200])
def test_an_estimate_is_the_error_against_the_closed_form(rate: float) -> None:
    scene, stepping = oscillator(), Stepping(rate=rate)
    [found] = estimate(scene, stepping=stepping)

    assert found is not None
    assert found.error == pytest.approx(delivered(scene, stepping), rel=0.03)  # 0.4 % to 1.9 %
    assert found.difference == pytest.approx(1.5 * found.error, rel=0.01)  # 1.5 m at the most
    assert found.order == pytest.approx(2, abs=0.02)
    assert (found.quantity, found.unit) == ("ball.position.x", "m")
