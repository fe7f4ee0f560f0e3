"""Kinematics: limiting cases, figures of the chapter, and the formulas' own derivations."""

from math import pi, radians, tau

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from validation.formulas import kinematics

positive = st.floats(0.01, 100)
angles = st.floats(0.05, pi / 2 - 0.05)
signed = st.floats(-100, 100)


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


@given(signed, signed, st.floats(0, 100), st.floats(0, 100))
def test_uniform_acceleration_goes_on_from_wherever_it_is(
    v0: float, a: float, first: float, then: float
) -> None:
    halfway = kinematics.uniform_position(v0, a, first)
    onwards = kinematics.uniform_position(float(kinematics.uniform_velocity(v0, a, first)), a, then)

    assert halfway + onwards == pytest.approx(
        kinematics.uniform_position(v0, a, first + then), abs=1e-7
    )


@given(positive, positive, positive)
def test_the_speed_after_a_way_needs_no_time(v0: float, a: float, t: float) -> None:
    way = float(kinematics.uniform_position(v0, a, t))

    assert kinematics.speed_after_way(v0, a, way) == pytest.approx(
        kinematics.uniform_velocity(v0, a, t)
    )
    assert kinematics.speed_after_way(v0, a, 0) == pytest.approx(v0)


def test_from_rest_the_ways_grow_as_the_squares_of_the_times() -> None:
    ways = kinematics.uniform_position(0, 2, [1, 2, 3])

    assert ways.tolist() == [1, 4, 9]


@given(positive, positive)
def test_a_ball_is_at_its_apex_when_it_has_risen(speed: float, g: float) -> None:
    top = kinematics.projectile_height(speed, pi / 2, g, kinematics.rise_time(speed, g))

    assert top == pytest.approx(kinematics.projectile_apex(speed, pi / 2, g))
    assert 2 * kinematics.rise_time(speed, g) == pytest.approx(
        kinematics.flight_time(speed, pi / 2, g)
    )


@given(positive, angles, positive)
def test_a_projectile_is_slowest_at_its_apex_and_lands_as_fast_as_it_left(
    speed: float, angle: float, g: float
) -> None:
    end = kinematics.flight_time(speed, angle, g)
    start, apex, landing = kinematics.projectile_speed(speed, angle, g, [0, end / 2, end])

    assert start == pytest.approx(speed)
    assert landing == pytest.approx(speed)
    assert apex == pytest.approx(speed * np.cos(angle), rel=1e-5)


@given(positive, positive)
def test_round_a_circle_the_second_difference_of_the_place_is_the_acceleration(
    speed: float, r: float
) -> None:
    h = 1e-3 * r / speed
    x, y = kinematics.circular_position(speed, r, [-h, 0, h])
    a = kinematics.centripetal_acceleration(speed, r)

    assert (x[0] - 2 * x[1] + x[2]) / h**2 == pytest.approx(-a, rel=1e-5)
    assert (y[0] - 2 * y[1] + y[2]) / h**2 == pytest.approx(0, abs=1e-5 * a)


@given(positive, positive)
def test_after_a_period_it_is_where_it_was(speed: float, r: float) -> None:
    x, y = kinematics.circular_position(speed, r, kinematics.circular_period(speed, r))

    assert (x, y) == pytest.approx((r, 0), abs=1e-12 * r)
    assert kinematics.circular_period(1, 1) == pytest.approx(tau)
