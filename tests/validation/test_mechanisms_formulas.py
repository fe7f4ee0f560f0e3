"""Linkages, cranes and lifts agree with their geometry and with virtual work."""

from math import hypot, pi, radians, tan

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from validation.formulas import mechanisms

cranks = st.floats(0.1, 0.9)
angles = st.floats(0, 2 * pi)


@given(cranks, angles)
def test_a_piston_goes_as_fast_as_its_place_changes(crank: float, angle: float) -> None:
    """Central differences over 1e-4 rad, with an error of the order of 1e-8 / (1 − r)³."""
    h = 1e-4
    before, now, after = (mechanisms.slider(angle + step, 1.0, crank, 1.0) for step in (-h, 0.0, h))

    assert float(after.position - before.position) / (2 * h) == pytest.approx(now.speed, abs=1e-4)
    assert float(after.speed - before.speed) / (2 * h) == pytest.approx(now.acceleration, abs=1e-3)


def test_a_long_rod_makes_the_piston_a_sine() -> None:
    angle = np.linspace(0, 2 * pi, 50)

    assert mechanisms.slider(angle, 2.0, 1.0, 1e6).speed == pytest.approx(
        -2 * np.sin(angle), abs=1e-5
    )


def test_a_motor_does_no_work_over_a_whole_turn() -> None:
    """What it gives to the parts in one half it gets back in the other."""
    angle = np.linspace(0, 2 * pi, 721)[:-1]

    torque = mechanisms.engine_torque(angle, 6.0, 0.5, 1.5, (1.0, 2.0))

    assert torque.mean() == pytest.approx(0, abs=1e-10 * np.abs(torque).max())


def test_a_flywheel_without_a_piston_turns_evenly() -> None:
    t = np.linspace(0, 1, 5)

    angle = mechanisms.coasting_angle(t, 3.0, 1.0, 0.5, 1.5, (0.0, 0.0))

    assert angle == pytest.approx(3 * t)


def test_two_supports_share_a_load_by_its_levers() -> None:
    left, right = mechanisms.supports([(1.0, 40.0)], 0.0, 4.0)

    assert (float(left), float(right)) == pytest.approx((30, 10))


def test_a_stay_at_45_degrees_bears_the_torque_over_its_lever() -> None:
    tension = mechanisms.stay_tension(10.0, 0j, 2 + 0j, 2j)

    assert tension == pytest.approx(10 / (2 / hypot(1, 1)))


@given(st.integers(1, 5), st.floats(10, 70))
def test_a_scissor_lift_at_rest_needs_its_weights_over_the_tangent(pairs: int, low: float) -> None:
    """n times the load, and n² times an arm: the two arms of a pair rise by their half and more."""
    lift = mechanisms.Scissor(pairs, 2.0, 3.0, 50.0)

    force = lift.force(2 * np.cos(radians(low)), 0.0, 0.0, 10.0)

    assert force == pytest.approx(10 * (pairs * 50 + pairs**2 * 3) / tan(radians(low)))


def test_the_force_of_a_scissor_lift_does_the_work_that_its_energy_gains() -> None:
    """Lifted from rest to rest, all work is weight times height."""
    lift = mechanisms.Scissor(3, 2.0, 10.0, 300.0)
    t = np.linspace(0, 1, 20001)
    way, speed, change = mechanisms.eased(t)
    width = 1.9 - 0.6 * way

    force = lift.force(width, -0.6 * speed, -0.6 * change, 9.81)

    rise = np.sqrt(4 - 1.3**2) - np.sqrt(4 - 1.9**2)
    assert np.trapezoid(force * 0.6 * speed, t) == pytest.approx(
        9.81 * rise * (3 * 300 + 9 * 10), rel=1e-8
    )


@given(angles)
def test_chebyshevs_bars_keep_their_lengths(angle: float) -> None:
    pin = np.exp(1j * angle)

    foot = mechanisms.chebyshev_foot(angle, 1.0)

    assert abs(foot - pin) == pytest.approx(5)
    assert abs((foot + pin) / 2 - 2) == pytest.approx(2.5)


def test_chebyshevs_foot_stays_on_its_line_for_half_a_turn() -> None:
    """To 2.3 parts in a thousand, at cos θ = −1 ± 1 / 2."""
    foot = mechanisms.chebyshev_foot(np.linspace(pi / 2, 3 * pi / 2, 200), 1.0)

    assert foot.imag == pytest.approx(4, rel=2.5e-3)
    assert np.ptp(foot.real) == pytest.approx(4)


def test_a_drawbridge_keeps_its_energy() -> None:
    t = np.linspace(0, 1.5, 3001)

    angle = mechanisms.bridge_angle(t, 4.0, 5.0, 800.0, 700.0, 9.81)

    omega = np.gradient(angle, t, edge_order=2)
    way = np.sqrt(41 - 40 * np.sin(angle))
    moment = 800 * 16 / 3 + 700 * (20 * np.cos(angle) / way) ** 2
    energy = moment * omega**2 / 2 + 9.81 * (800 * 2 * np.sin(angle) + 700 * (way - np.sqrt(41)))
    assert energy == pytest.approx(0, abs=0.1)


def test_a_belt_passes_on_power() -> None:
    """Torque times angular velocity is equal at both wheels; equal wheels have parallel sides."""
    belt = mechanisms.belt(20.0, 300.0, (0.3, 0.6), 4.0)

    assert float(belt.torque) * 5.0 == pytest.approx(20.0 * 5.0 * 0.3 / 0.6)
    assert float(belt.tight - belt.slack) * 0.6 == pytest.approx(20)
    same = mechanisms.belt(0.0, 300.0, (0.5, 0.5), 4.0)
    assert float(same.tight + same.slack) == 300
