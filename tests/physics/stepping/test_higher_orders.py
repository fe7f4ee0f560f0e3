"""Sixth and eighth order: more drifts and kicks in a step, for far smaller errors."""

from math import asin, atan2, log2, sin, sqrt

import numpy as np
import pytest
from scipy.special import ellipj, ellipk

from sandbox.model.level import ORDERS, Scheme
from sandbox.physics.scene.composition_schemes import composition
from tests.physics.scenes import G
from tests.physics.stepping.test_fourth_order import HELD, SCENES, ends

UNEVEN = ("two rods", "cart with a pendulum")
"""Scenes whose errors fall irregularly at the low rates at which eighth order can be seen."""


@pytest.mark.sweep
@pytest.mark.parametrize(("scheme", "rate"), [("sixth-order", 20), ("eighth-order", 15)])
@pytest.mark.parametrize("name", [*list(SCENES)[:3], *(n for n in HELD if n not in UNEVEN)])
def test_sixth_and_eighth_order_are_reached_too(name: str, scheme: Scheme, rate: int) -> None:
    """By positions and velocities, with and without joints: 5.99 to 6.09, and 7.94 to 8.07."""
    coarse, middle, fine = (
        ends({**SCENES, **HELD}[name], times * rate, scheme=scheme) for times in (1, 2, 4)
    )

    for field in ("position", "velocity"):
        first = np.abs(getattr(coarse, field) - getattr(middle, field)).max()
        second = np.abs(getattr(middle, field) - getattr(fine, field)).max()
        assert log2(first / second) == pytest.approx(ORDERS[scheme], abs=0.12), field


@pytest.mark.parametrize("held", [False, True])
@pytest.mark.parametrize("order", [4, 6, 8])
def test_a_step_reaches_as_far_as_the_trace_of_its_matrix_stays_below_two(
    order: int, *, held: bool
) -> None:
    """For x'' = -x: the drifts and kicks of a step add up to 1, and are the same backwards."""
    drifts, kicks, reach = composition(order, is_constrained=held)

    def trace(angle: float) -> float:
        step = np.eye(2)
        for drift, kick in zip(drifts, kicks, strict=True):
            drifted = np.array([[1, drift], [0, 1]]) @ step
            step = np.array([[1, 0], [-kick * angle**2, 1]]) @ drifted
        return float(np.trace(step))

    assert drifts == pytest.approx(drifts[::-1], abs=1e-15)
    assert kicks[:-1] == pytest.approx(kicks[-2::-1], abs=1e-15)
    assert (sum(drifts), sum(kicks)) == pytest.approx((1, 1), abs=1e-14)
    assert max(abs(trace(angle)) for angle in np.linspace(0.1, reach * (1 - 1e-6), 500)) <= 2
    assert max(abs(trace(angle)) for angle in reach * np.linspace(1, 1.0001, 50)) > 2


@pytest.mark.sweep
@pytest.mark.parametrize(
    ("scheme", "rate", "error"),
    [("fourth-order", 60, 4e-7), ("sixth-order", 27, 4e-9), ("eighth-order", 17, 1.3e-10)],
)
def test_by_as_many_kicks_each_higher_order_is_far_more_accurate_on_a_rod(
    scheme: Scheme, rate: int, error: float
) -> None:
    """0.5 rad, after 20 s, by some 300 kicks a second: 3.2e-7, 3.5e-9 and 1.1e-10 rad."""
    there = ends(HELD["pendulum"], rate, 20, scheme).position[0]
    k = sin(0.25)
    sn, *_ = ellipj(ellipk(k * k) - sqrt(G) * 20, k * k)

    off = abs(atan2(there[0], -there[1]) - 2 * asin(k * sn))

    assert error / 2 < off < error
