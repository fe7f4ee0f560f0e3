"""The formulas themselves: limiting cases, figures of the chapter, and their own derivations."""

from math import pi, radians, sqrt

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from validation.formulas import energy, kinematics, momentum, newton

positive = st.floats(0.01, 100)
angles = st.floats(0.05, pi / 2 - 0.05)


def test_after_a_second_a_body_has_fallen_4_9_m_and_moves_at_9_8_m_per_s() -> None:
    assert kinematics.free_fall_height(0, 9.81, 1) == pytest.approx(-4.9, abs=0.01)
    assert kinematics.free_fall_velocity(9.81, 1) == pytest.approx(-9.8, abs=0.02)


def test_25_m_per_s_at_45_degrees_reach_63_7_m() -> None:
    assert kinematics.projectile_range(25, radians(45), 9.81) == pytest.approx(63.7, abs=0.02)


@given(positive, angles, positive)
def test_complementary_angles_reach_equally_far(speed: float, angle: float, g: float) -> None:
    one, other = (kinematics.projectile_range(speed, a, g) for a in (angle, pi / 2 - angle))
    assert one == pytest.approx(other, rel=1e-9)


@given(positive, angles, positive)
def test_doubling_the_speed_quadruples_the_height(speed: float, angle: float, g: float) -> None:
    ratio = kinematics.projectile_apex(2 * speed, angle, g) / kinematics.projectile_apex(
        speed, angle, g
    )
    assert ratio == pytest.approx(4)


@given(positive, angles, positive)
def test_range_and_apex_lie_on_the_trajectory(speed: float, angle: float, g: float) -> None:
    end = kinematics.flight_time(speed, angle, g)
    size = kinematics.projectile_apex(speed, angle, g)

    assert kinematics.projectile_height(speed, angle, g, end) == pytest.approx(0, abs=1e-9 * size)
    assert kinematics.projectile_height(speed, angle, g, end / 2) == pytest.approx(size)
    assert kinematics.projectile_distance(speed, angle, end) == pytest.approx(
        kinematics.projectile_range(speed, angle, g)
    )


@given(positive, angles, positive, positive)
def test_energy_gives_the_speed_of_landing(
    speed: float, angle: float, g: float, height: float
) -> None:
    t = kinematics.flight_time(speed, angle, g, height)
    down = speed * np.sin(angle) - g * t

    assert np.hypot(speed * np.cos(angle), down) == pytest.approx(
        energy.landing_speed(speed, g, height)
    )


@given(positive, positive, positive)
def test_atwoods_two_bodies_obey_newton(m1: float, m2: float, g: float) -> None:
    a, tension = newton.atwood_acceleration(m1, m2, g), newton.atwood_tension(m1, m2, g)

    assert tension - m1 * g == pytest.approx(m1 * a, abs=1e-9 * m1 * g)
    assert tension - m2 * g == pytest.approx(-m2 * a, abs=1e-9 * m2 * g)


def test_atwoods_limits() -> None:
    assert newton.atwood_acceleration(3, 3, 9.81) == 0
    assert newton.atwood_tension(3, 3, 9.81) == pytest.approx(3 * 9.81)
    assert newton.atwood_acceleration(1e-9, 1, 9.81) == pytest.approx(9.81)


def test_an_incline_is_flat_ground_at_0_and_a_drop_at_90_degrees() -> None:
    assert newton.incline_acceleration(0, 9.81) == 0
    assert newton.incline_acceleration(pi / 2, 9.81) == pytest.approx(9.81)
    assert newton.incline_normal_force(2, 0, 9.81) == pytest.approx(2 * 9.81)


@given(positive, angles, positive, st.floats(0, 2))
def test_forces_on_an_incline_add_up(mass: float, angle: float, g: float, mu: float) -> None:
    along = mass * g * np.sin(angle) - newton.incline_friction(mass, angle, g, mu)
    expected = mass * newton.incline_acceleration(angle, g, mu)

    assert along == pytest.approx(expected, abs=1e-9 * mass * g)


def test_a_point_of_an_incline_is_turned_with_it() -> None:
    assert newton.incline_point(2, 0, 0) == 2
    assert newton.incline_point(2, 1, pi / 2) == pytest.approx(-1)


@given(positive, positive, positive, st.floats(0, 1))
def test_table_and_weight_obey_newton(m1: float, m2: float, g: float, mu: float) -> None:
    a = newton.table_pulley_acceleration(m1, m2, g, mu)
    tension = newton.table_pulley_tension(m1, m2, g, mu)

    assert m2 * g - tension == pytest.approx(m2 * a, abs=1e-9 * m2 * g)
    if a > 0:
        assert tension - mu * m1 * g == pytest.approx(m1 * a, abs=1e-9 * (tension + m1 * g))


velocities = st.floats(-10, 10)


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


def test_a_circular_orbit_has_half_its_potential_energy() -> None:
    assert energy.circular_orbit_speed(8, 2) == pytest.approx(2)
    assert energy.circular_orbit_energy(8, 2) == pytest.approx(-2)
    assert energy.circular_orbit_speed(8, 2) == pytest.approx(sqrt(8 / 2))
