"""Rotation and rolling: energy, torque and angular momentum, and the order of a race."""

from math import pi, radians

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from validation.formulas import newtons_laws, rotation

positive = st.floats(0.01, 100)
angles = st.floats(0.05, pi / 2 - 0.05)
factors = st.floats(0.05, 1)
FACTORS = (
    rotation.SLIDING,
    rotation.SPHERE,
    rotation.DISC,
    rotation.HOLLOW_SPHERE,
    rotation.HOOP,
)


def test_a_disc_rolls_with_two_thirds_and_a_hoop_with_half() -> None:
    slope = 9.81 * np.sin(radians(20))

    disc = rotation.rolling_acceleration(rotation.DISC, radians(20), 9.81, 1)
    hoop = rotation.rolling_acceleration(rotation.HOOP, radians(20), 9.81, 1)

    assert (disc, hoop) == pytest.approx((slope * 2 / 3, slope / 2))


def test_the_further_out_the_mass_the_later() -> None:
    times = [rotation.race_time(factor, 6, 0.3, 9.81) for factor in FACTORS]

    assert times == sorted(times)
    assert rotation.rolling_acceleration(rotation.SLIDING, 0.3, 9.81, 0) == pytest.approx(
        newtons_laws.incline_acceleration(0.3, 9.81)
    )


@given(factors, positive, angles, positive)
def test_rolling_keeps_the_energy(factor: float, r: float, angle: float, g: float) -> None:
    """Of a kilogram over a second, with enough friction."""
    v = rotation.rolling_acceleration(factor, angle, g, 100)
    spin = rotation.rolling_spin(factor, r, angle, g, 100)
    fallen = v / 2 * np.sin(angle)

    assert spin * r == pytest.approx(v)
    assert v**2 / 2 + rotation.rotational_energy(factor * r**2, spin) == pytest.approx(g * fallen)


@given(factors, positive, angles, positive, st.floats(0, 2))
def test_friction_on_a_round_body_is_never_more_than_coulombs(
    factor: float, mass: float, angle: float, g: float, mu: float
) -> None:
    friction = rotation.rolling_friction(factor, mass, angle, g, mu)
    most = mu * newtons_laws.incline_normal_force(mass, angle, g)

    assert friction <= most + 1e-9 * mass * g
    if not rotation.rolls(factor, angle, mu):
        assert friction == pytest.approx(most, abs=1e-9 * mass * g)


@given(factors, st.floats(0.1, 100), st.floats(0.05, 2), positive)
def test_a_slide_ends_in_rolling(factor: float, speed: float, mu: float, g: float) -> None:
    """By then a torque of r μ m g over k m r² has spun it up to v / r."""
    t = rotation.sliding_time(factor, speed, mu, g)
    way = rotation.slide_and_roll_way(factor, speed, mu, g, [t, t + 1])
    final = rotation.rolling_speed(factor, speed)

    assert mu * g / factor * t == pytest.approx(final)
    assert way[0] == pytest.approx((speed + final) / 2 * t)
    assert way[1] - way[0] == pytest.approx(final, abs=1e-9 * (way[0] + speed))


def test_two_thirds_after_a_third() -> None:
    assert rotation.rolling_speed(rotation.DISC, 6) == pytest.approx(4)
    assert rotation.rolling_speed(rotation.HOOP, 6) == pytest.approx(3)
    assert rotation.sliding_time(rotation.DISC, 6, 0.2, 10) == pytest.approx(1)


def test_a_thin_box_is_a_rod() -> None:
    assert rotation.box_moment(12, 1, 0) == pytest.approx(1)
    assert rotation.box_moment(2, 2, 0.8) == pytest.approx(2 * (4 + 0.64) / 12)


@given(positive, positive, st.floats(-50, 50))
def test_a_rod_obeys_the_parallel_axis_theorem(mass: float, length: float, off: float) -> None:
    center = mass * length**2 / 12

    assert rotation.rod_moment(mass, length) == pytest.approx(center)
    assert rotation.rod_moment(mass, length, length / 2) == pytest.approx(4 * center)
    assert rotation.rod_moment(mass, length, off) == pytest.approx(
        center + mass * off**2, rel=1e-6, abs=1e-9 * mass * (abs(off) + length) ** 3 / length
    )


@given(st.floats(0, 10), st.floats(0, 10), angles)
def test_a_torque_is_lever_arm_times_force_times_the_sine(
    arm: float, force: float, angle: float
) -> None:
    push = complex(force * np.cos(angle), force * np.sin(angle))

    assert rotation.torque(arm + 0j, push) == pytest.approx(arm * force * np.sin(angle))
    assert rotation.torque(arm + 0j, force + 0j) == 0


def test_a_hoop_has_twice_the_moment_of_a_disc() -> None:
    hoop, disc = (rotation.round_moment(k, 2, 0.5) for k in (rotation.HOOP, rotation.DISC))

    assert hoop == 2 * disc == pytest.approx(0.5)
    assert rotation.spun_angle(3.0, hoop, 2.0) == pytest.approx(12)


def test_a_yo_yo_on_its_rim_falls_with_two_thirds() -> None:
    assert rotation.yo_yo_acceleration(0.3, 0.3, 9) == pytest.approx(6)


def test_a_weight_on_a_drum_falls_freely_if_the_drum_is_light() -> None:
    assert rotation.driven_by_weight(2, 0.5, 1e-15, 10) * 0.5 == pytest.approx(10)
    assert rotation.disc_moment(2, 1) == 1
    assert rotation.disc_moment(2, 1, 3) == 19


def test_a_point_that_circles_steadily_is_drawn_to_the_axis() -> None:
    assert rotation.rim_acceleration(2.0, 3.0, 0.0) == -18
    assert rotation.rim_acceleration(2.0, 0.0, 0.5) == 1j


def test_what_slides_in_a_hollow_swings_as_a_pendulum_and_what_rolls_more_slowly() -> None:
    slides, rolls = (rotation.rolling_period(k, 0.9, 9.81, 0.01) for k in (0.0, rotation.DISC))

    assert slides == pytest.approx(2 * pi * np.sqrt(0.9 / 9.81), rel=1e-5)
    assert rolls == pytest.approx(slides * np.sqrt(1.5))


@given(factors, st.floats(0.1, 3))
def test_what_rolls_down_a_hollow_keeps_its_energy(factor: float, angle: float) -> None:
    speed = rotation.trough_speed(factor, 0.9, 9.81, angle)

    assert (1 + factor) * speed**2 / 2 == pytest.approx(9.81 * 0.9 * (1 - np.cos(angle)))


@pytest.mark.parametrize("factor", FACTORS)
@pytest.mark.parametrize("start", [0.3, 1.5, 3.0])
def test_what_rolls_on_a_cycloid_keeps_its_energy_and_its_time(factor: float, start: float) -> None:
    """(1 + k) s'² / 2 + g y, s² = 8 R y; it is at its lowest point after a quarter."""
    radius, g = 0.7, 9.81
    quarter = rotation.cycloid_quarter(factor, radius, g)
    t = np.linspace(0, quarter, 9)[1:-1]
    step = 1e-6
    ways = [
        np.sqrt(8 * radius * rotation.cycloid_height(factor, radius, g, start, t + sign * step))
        for sign in (-1, 1)
    ]
    speed = (ways[1] - ways[0]) / (2 * step)
    total = (1 + factor) * speed**2 / 2 + ways[0] * ways[1] / (8 * radius) * g
    begun = g * radius * (1 - np.cos(start))

    assert total == pytest.approx([begun] * len(t), rel=1e-6)
    assert rotation.cycloid_height(factor, radius, g, start, quarter) == pytest.approx(0, abs=1e-20)
