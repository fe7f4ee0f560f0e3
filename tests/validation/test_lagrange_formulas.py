"""Pendulums and springs: series, limits and the equations of motion."""

from math import hypot, pi, sqrt

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import ArrayLike

from validation.formulas import Array, energy, oscillators

positive = st.floats(0.01, 100)


@given(positive, positive, st.floats(0.01, 3))
def test_a_pendulum_takes_longer_the_wider_it_swings(
    length: float, g: float, amplitude: float
) -> None:
    """T = T0 (1 + θ²/16 + 11 θ⁴/3072 + …)."""
    small = 2 * pi * sqrt(length / g)
    period = oscillators.pendulum_period(length, g, amplitude)

    assert period >= small * (1 + amplitude**2 / 16)
    if amplitude < 0.5:
        series = 1 + amplitude**2 / 16 + 11 * amplitude**4 / 3072
        assert period == pytest.approx(small * series, rel=1e-4)


@given(positive, positive, st.floats(0, 50), st.floats(0.1, 2))
def test_a_damped_spring_starts_at_rest_and_obeys_newton(
    mass: float, stiffness: float, damping: float, amplitude: float
) -> None:
    h = 1e-3 * min(sqrt(mass / stiffness), mass / (damping + 1e-9))
    x = oscillators.damped_oscillation(np.array([0, h, 2 * h]), mass, stiffness, damping, amplitude)

    assert x[0] == pytest.approx(amplitude)
    assert (x[1] - x[0]) / h**2 == pytest.approx(-stiffness * amplitude / mass / 2, rel=1e-2)


def test_coupled_oscillators_that_start_alike_swing_alike() -> None:
    left, right = oscillators.coupled_oscillations(np.linspace(0, 3, 7), 1, 20, (0.3, 0.3))

    assert left == pytest.approx(right)
    assert left == pytest.approx(0.3 * np.cos(sqrt(20) * np.linspace(0, 3, 7)))


@given(st.floats(0.1, 10), st.floats(0.1, 100), st.floats(0.1, 10), st.floats(0.1, 3))
def test_a_driven_spring_answers_softly_below_and_against_the_drive_above_its_own_frequency(
    mass: float, stiffness: float, damping: float, ratio: float
) -> None:
    """Driven slowly x = F / k; at resonance F / (c ω), a quarter behind; fast −F / (m w²)."""
    natural = sqrt(stiffness / mass)
    slow, tuned, fast = (
        oscillators.response(mass, stiffness, damping, share * natural) for share in (1e-6, 1, 1e6)
    )
    amplitude = abs(oscillators.response(mass, stiffness, damping, ratio * natural))
    width = hypot(1 - ratio**2, ratio * damping * natural / stiffness)

    assert slow == pytest.approx(1 / stiffness, rel=1e-3)
    assert tuned == pytest.approx(-1j / (damping * natural))
    assert fast == pytest.approx(-1 / (mass * (1e6 * natural) ** 2), rel=1e-3)
    assert amplitude == pytest.approx(1 / stiffness / width)


@given(st.floats(0.5, 3), st.floats(5, 40), st.floats(0.1, 3), st.floats(0.2, 8))
def test_a_spring_driven_from_rest_obeys_newton_and_ends_in_the_steady_state(
    mass: float, stiffness: float, damping: float, drive: float
) -> None:
    """At first x = F t² / 2m; later the free oscillation has decayed as e^(−ct/2m)."""

    def swing(t: ArrayLike) -> Array:
        return oscillators.started_oscillation(t, mass, stiffness, damping, 2, drive)

    late = np.linspace(0, 5, 50) + 60 * mass / damping
    steady = oscillators.driven_oscillation(late, mass, stiffness, damping, 2, drive)

    assert swing([0, 1e-4]) == pytest.approx([0, 1e-8 / mass], rel=1e-2, abs=1e-12)
    assert np.abs(swing(late) - steady).max() <= 1e-9 * 2 * np.abs(swing(late)).max()


@given(positive, positive)
def test_a_beam_tips_at_first_with_torque_over_moment(moment: float, torque: float) -> None:
    """Then ever less: it takes longer than √(π I/τ), the time at the initial acceleration."""
    time = oscillators.tipping_time(moment, torque)

    assert time == pytest.approx(1.8540746773013719 * sqrt(moment / torque))
    assert time > sqrt(pi * moment / torque)


@given(st.floats(0.1, 10), st.floats(1, 20), st.floats(1, 20), st.floats(-2, 2), st.integers(1, 4))
def test_whatever_strays_from_the_true_way_has_more_action(
    mass: float, up: float, g: float, stray: float, waves: int
) -> None:
    """By m a² n² π² / (4 t1): the quadrature against the calculus of variations."""
    landing = 2 * up / g
    true, other = (
        float(oscillators.action_of_throw(landing, mass, (3.0, up), g, a, waves))
        for a in (0, stray)
    )
    more = oscillators.more_action(mass, stray, waves, landing)

    assert more >= 0
    assert other - true == pytest.approx(more, rel=1e-6, abs=1e-9 * (abs(true) + 1))


def test_a_pendulum_on_a_cart_of_infinite_mass_is_a_pendulum() -> None:
    quarter = oscillators.pendulum_period(1, 9.81, 1.2) / 4
    x, theta = oscillators.cart_pendulum([0, quarter], 1e12, 1, 1, 9.81, 1.2)

    assert theta == pytest.approx([1.2, 0], abs=1e-9)
    assert x == pytest.approx([0, 0], abs=1e-9)


@pytest.mark.sweep
@given(st.floats(0.2, 5), st.floats(0.2, 5))
def test_a_pendulum_on_a_cart_keeps_its_energy_and_swings_as_it_should(
    cart: float, bob: float
) -> None:
    """After a quarter of the period of small swings it is at the bottom, all energy kinetic."""
    omega = oscillators.cart_pendulum_frequency(cart, bob, 1, 9.81)
    _, theta = oscillators.cart_pendulum(pi / 2 / omega, cart, bob, 1, 9.81, 1e-3)

    assert theta == pytest.approx(0, abs=1e-8)


def test_weakly_coupled_oscillators_change_places_after_half_a_beat() -> None:
    slow, fast = oscillators.mode_frequencies(1, 10, 0.1)
    swings = oscillators.coupled_oscillations(
        pi / (fast - slow) + np.linspace(-1, 1, 99), 1, 10, (0.3, 0), 0.1
    )
    left, right = np.abs(swings).max(axis=1)

    assert left < 0.01
    assert right == pytest.approx(0.3, rel=1e-2)


@pytest.mark.parametrize("start", [0.3, 2.9])
def test_a_bead_on_a_cycloid_keeps_its_energy(start: float) -> None:
    """m v²/2 with v = ds/dt and s = √(8 R y)."""
    radius, g, h = 0.7, 9.81, 1e-6
    t = np.linspace(0.01, 0.7, 50)  # short of the lowest point

    def length(t: Array) -> Array:
        return np.sqrt(8 * radius * oscillators.cycloid_height(t, radius, g, start))

    speed = (length(t + h) - length(t - h)) / (2 * h)
    total = speed**2 / 2 + g * oscillators.cycloid_height(t, radius, g, start)
    assert total == pytest.approx(np.full(50, g * radius * (1 - np.cos(start))), rel=1e-7)


@pytest.mark.parametrize(("rate", "expected"), [(2.0, 9.81 - 4), (5.0, 25 - (9.81 / 5) ** 2)])
def test_a_bead_on_a_hoop_swings_about_its_rest(rate: float, expected: float) -> None:
    """ω² − (g / (ω R))² = (ω sin θ)² about the angle, g/R − ω² about the bottom."""
    found = oscillators.hoop_frequency(1.0, rate, 9.81, 1e-4)

    assert found**2 == pytest.approx(expected, rel=1e-6)


def test_a_double_pendulum_swings_in_its_modes_if_it_swings_little() -> None:
    """Equal masses and rods: ω² = (2 ∓ √2) g / l, with the lower angle ±√2 times the upper one."""
    t = np.linspace(0, 2, 21)
    for sign in (1, -1):
        start = 1e-4, sign * 2**0.5 * 1e-4
        swing = np.cos(np.sqrt((2 - sign * 2**0.5) * 9.81) * t)

        theta, phi = oscillators.double_pendulum(t, (1.0, 1.0), (1.0, 1.0), 9.81, start)

        assert theta == pytest.approx(start[0] * swing, abs=1e-10)
        assert phi == pytest.approx(start[1] * swing, abs=1e-10)


def test_a_cycloid_is_quicker_than_a_straight_wire_and_a_bowl() -> None:
    """From the cusp to the lowest point, π R to the side and 2 R below."""
    straight = energy.time_of_descent(lambda s: np.pi * s, lambda s: 2 * (1 - s), 9.81)
    bowl = energy.time_of_descent(lambda s: np.pi * s, lambda s: 2 * (1 - s) ** 2, 9.81)

    assert oscillators.cycloid_height(oscillators.cycloid_time(1, 9.81), 1, 9.81, np.pi) < 1e-30
    assert oscillators.cycloid_time(1, 9.81) < bowl < straight
