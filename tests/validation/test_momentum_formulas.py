"""Momentum and collisions: conservation, the chapter's limits, and bounces."""

from math import pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from validation.formulas import energy, momentum

positive = st.floats(0.01, 100)
angles = st.floats(0.05, pi / 2 - 0.05)
velocities = st.floats(-10, 10)
fractions = st.floats(0, 1)


@given(positive, positive, velocities, velocities, st.floats(0, 1))
def test_collisions_keep_momentum_and_part_with_e_times_the_approach(
    m1: float, m2: float, v1: float, v2: float, e: float
) -> None:
    after = momentum.collision_velocities(m1, m2, v1, v2, e)
    size = (m1 + m2) * 10

    assert m1 * after[0] + m2 * after[1] == pytest.approx(m1 * v1 + m2 * v2, abs=1e-12 * size)
    assert after[1] - after[0] == pytest.approx(e * (v1 - v2), abs=1e-11)


@given(positive, positive, velocities, velocities)
def test_elastic_collisions_keep_energy(m1: float, m2: float, v1: float, v2: float) -> None:
    after = momentum.collision_velocities(m1, m2, v1, v2)

    assert energy.kinetic_energy((m1, after[0]), (m2, after[1])) == pytest.approx(
        energy.kinetic_energy((m1, v1), (m2, v2)), abs=1e-9
    )


def test_the_chapters_three_limits_of_elastic_collisions() -> None:
    assert momentum.collision_velocities(1, 1, 3, 0) == pytest.approx((0, 3))
    assert momentum.collision_velocities(1e9, 1, 3, 0) == pytest.approx((3, 6))
    assert momentum.collision_velocities(1, 1e9, 3, 0) == pytest.approx((-3, 0), abs=1e-7)


@given(st.floats(0.1, 10), angles)
def test_after_a_glancing_collision_the_discs_part_at_a_right_angle(
    speed: float, angle: float
) -> None:
    first, second = momentum.glancing_velocities(speed, angle)

    assert np.dot(first, second) == pytest.approx(0, abs=1e-12 * speed**2)
    assert np.add(first, second) == pytest.approx((speed, 0), abs=1e-12 * speed)


@given(positive, positive, velocities, velocities, fractions)
def test_a_collision_does_not_move_the_centre_of_mass(
    m1: float, m2: float, v1: float, v2: float, e: float
) -> None:
    after = momentum.collision_velocities(m1, m2, v1, v2, e)
    expected = momentum.center_of_mass([(m1, 0, v1), (m2, 0, v2)], 3)

    assert momentum.center_of_mass([(m1, 0, after[0]), (m2, 0, after[1])], 3) == pytest.approx(
        expected, abs=1e-10
    )


def test_the_centre_of_mass_is_nearer_to_the_heavy_one() -> None:
    assert momentum.center_of_mass([(3, 0, 0), (1, 4, 8)], [0, 1]).tolist() == [1, 3]


@given(positive, fractions, st.integers(0, 9))
def test_between_walls_each_hit_turns_round_and_keeps_its_share(
    speed: float, e: float, hits: int
) -> None:
    before = momentum.velocity_between_walls(speed, e, hits)

    assert momentum.velocity_between_walls(speed, e, hits + 1) == pytest.approx(-e * before)


def test_a_wall_is_a_body_without_end() -> None:
    assert momentum.velocity_between_walls(3, 0.5, 1) == pytest.approx(
        momentum.collision_velocities(1, 1e12, 3, 0, 0.5)[0]
    )


@given(positive, fractions, positive)
def test_a_ball_rises_as_high_as_its_speed_carries_it(height: float, e: float, g: float) -> None:
    speed = momentum.rebound_speed(height, e, g)

    assert speed**2 / (2 * g) == pytest.approx(momentum.rebound_height(height, e))
    assert momentum.rebound_time(height, 1, g) == pytest.approx(
        2 * momentum.rebound_time(height, 0, g)
    )


def test_a_half_sine_gives_the_area_under_it() -> None:
    assert momentum.half_sine_momentum(5, 10, 1) == pytest.approx(20 / pi)


@given(positive, positive)
def test_a_swelling_push_gives_the_area_under_it(force: float, lasts: float) -> None:
    t = np.linspace(0, lasts, 201)
    area = np.trapezoid(force * np.sin(np.pi * t / lasts) ** 2, t)

    assert momentum.swelling_push_momentum(force, lasts) == pytest.approx(area, rel=1e-12)


@given(st.integers(0, 5), st.floats(0.1, 5))
def test_a_cradle_keeps_momentum_and_energy(come: int, speed: float) -> None:
    after = momentum.cradle_velocities(come, 5, speed)

    assert after.sum() == pytest.approx(come * speed)
    assert (after**2).sum() == pytest.approx(come * speed**2)
    assert (np.diff(after) >= 0).all()


@given(positive, positive, positive)
def test_a_bumper_gives_the_impulse_of_half_a_sine(mass: float, speed: float, k: float) -> None:
    """The mean of a half sine is 2/π of its peak; the impulse is 2 m v."""
    mean = momentum.bumper_peak_force(mass, speed, k) * 2 / pi

    assert mean * momentum.bumper_time(mass, k) == pytest.approx(2 * mass * speed)


@given(positive, positive, positive)
def test_recoil_keeps_no_momentum_and_all_the_energy(m1: float, m2: float, stored: float) -> None:
    v1, v2 = momentum.recoil_velocities(m1, m2, stored)

    assert m1 * v1 == pytest.approx(-m2 * v2)
    assert energy.kinetic_energy((m1, v1), (m2, v2)) == pytest.approx(stored)


def test_what_sticks_head_on_loses_all_that_it_can() -> None:
    together = momentum.collision_velocities(2, 3, 5, 0, 0)[0]

    assert momentum.common_velocity(2, 3, 5) == pytest.approx(together)
    assert momentum.stuck_energy(2, 3, 5, 0, 0.3) == pytest.approx(5 * together**2 / 2)
    assert momentum.stuck_energy(2, 3, 5, 0.6, 0.3) < 2 * 5**2 / 2


def test_a_ballistic_pendulum_begins_with_the_common_speed_and_slows_down() -> None:
    assert momentum.ballistic_velocity(1, 4, 10, 2, 9.81, 0) == 2
    assert momentum.ballistic_velocity(1, 4, 10, 2, 9.81, 0.01) < 2
    assert momentum.ballistic_height(1, 4, 10, 10) == pytest.approx(0.2)


def test_a_ballistic_pendulum_hangs_by_its_weight_before_it_swings() -> None:
    assert momentum.ballistic_tension(0.5, 2.0, 0.0, 1.0, 9.81) == pytest.approx(2.5 * 9.81)
    assert momentum.ballistic_tension(0.5, 2.0, 5.0, 1.0, 0.0) == pytest.approx(2.5)  # v' = 1 m/s


def test_what_is_thrown_lands_on_the_platform_below_its_apex() -> None:
    """At 7 m/s and 10 m/s² it rises by 2.45 m, and falls by 0.45 m in 0.3 s, reaching 3 m/s."""
    assert momentum.platform_landing(7, 10) == pytest.approx((1.0, 3.0))
