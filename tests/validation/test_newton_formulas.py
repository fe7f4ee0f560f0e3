"""Newton's laws: limiting cases, and forces that add up."""

from math import pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from validation.formulas import newtons_laws, pulleys

positive = st.floats(0.01, 100)
angles = st.floats(0.05, pi / 2 - 0.05)


@given(positive, positive, positive)
def test_atwoods_two_bodies_obey_newton(m1: float, m2: float, g: float) -> None:
    a, tension = pulleys.atwood_acceleration(m1, m2, g), pulleys.atwood_tension(m1, m2, g)

    assert tension - m1 * g == pytest.approx(m1 * a, abs=1e-9 * m1 * g)
    assert tension - m2 * g == pytest.approx(-m2 * a, abs=1e-9 * m2 * g)


def test_atwoods_limits() -> None:
    assert pulleys.atwood_acceleration(3, 3, 9.81) == 0
    assert pulleys.atwood_tension(3, 3, 9.81) == pytest.approx(3 * 9.81)
    assert pulleys.atwood_acceleration(1e-9, 1, 9.81) == pytest.approx(9.81)


def test_an_incline_is_flat_ground_at_0_and_a_drop_at_90_degrees() -> None:
    assert newtons_laws.incline_acceleration(0, 9.81) == 0
    assert newtons_laws.incline_acceleration(pi / 2, 9.81) == pytest.approx(9.81)
    assert newtons_laws.incline_normal_force(2, 0, 9.81) == pytest.approx(2 * 9.81)


@given(positive, angles, positive, st.floats(0, 2))
def test_forces_on_an_incline_add_up(mass: float, angle: float, g: float, mu: float) -> None:
    along = mass * g * np.sin(angle) - newtons_laws.incline_friction(mass, angle, g, mu)
    expected = mass * newtons_laws.incline_acceleration(angle, g, mu)

    assert along == pytest.approx(expected, abs=1e-9 * mass * g)


def test_a_point_of_an_incline_is_turned_with_it() -> None:
    assert newtons_laws.incline_point(2, 0, 0) == 2
    assert newtons_laws.incline_point(2, 1, pi / 2) == pytest.approx(-1)


@given(positive, positive, positive, st.floats(0, 1))
def test_table_and_weight_obey_newton(m1: float, m2: float, g: float, mu: float) -> None:
    a = pulleys.table_pulley_acceleration(m1, m2, g, mu)
    tension = pulleys.table_pulley_tension(m1, m2, g, mu)

    assert m2 * g - tension == pytest.approx(m2 * a, abs=1e-9 * m2 * g)
    if a > 0:
        assert tension - mu * m1 * g == pytest.approx(m1 * a, abs=1e-9 * (tension + m1 * g))


@given(st.floats(-10, 10), st.floats(-10, 10), angles)
def test_a_point_of_an_incline_keeps_its_distance_from_the_foot(
    along: float, above: float, angle: float
) -> None:
    x = newtons_laws.incline_point(along, above, angle)
    y = newtons_laws.incline_height(along, above, angle)

    assert np.hypot(x, y) == pytest.approx(np.hypot(along, above), abs=1e-12)
    assert newtons_laws.incline_height(2, 1, pi / 2) == pytest.approx(2)


@given(positive, positive, positive)
def test_friction_stops_at_the_stopping_distance_and_there_it_stays(
    speed: float, mu: float, g: float
) -> None:
    end = newtons_laws.stopping_time(speed, mu, g)
    distance = newtons_laws.stopping_distance(speed, mu, g)
    half, stop, later = newtons_laws.sliding_way(speed, mu, g, [end / 2, end, 3 * end])

    assert distance == pytest.approx(speed**2 / (2 * mu * g))
    assert (half, stop, later) == pytest.approx((0.75 * distance, distance, distance))


def test_twice_the_mass_has_half_the_acceleration() -> None:
    assert newtons_laws.acceleration(4, 2) == newtons_laws.acceleration(4, 1) / 2


def test_drag_ends_at_its_terminal_velocity_and_begins_as_a_free_fall() -> None:
    assert newtons_laws.fall_velocity(100, 1, 0.2, 9.81) == pytest.approx(
        -newtons_laws.terminal_velocity(1, 0.2, 9.81)
    )
    assert newtons_laws.fall_velocity(1e-3, 1, 0.2, 9.81) == pytest.approx(-9.81e-3, rel=1e-5)
    assert newtons_laws.throw_with_drag(1, 3, 1, 1e-6, 9.81) == pytest.approx(
        3 - 9.81 / 2, rel=1e-4
    )


def test_an_atwood_machine_on_an_atwood_machine_weighs_less_than_at_rest() -> None:
    """It weighs as much as 4 m2 m3 / (m2 + m3) and its wheel: 11/3 kg, where 4 kg hang."""
    left, first, second = pulleys.double_atwood_accelerations(4, 1, 1, 2, 9.81)
    balanced = pulleys.double_atwood_accelerations(1 + 8 / 3, 1, 1, 2, 9.81)

    assert left == pytest.approx(pulleys.atwood_acceleration(4, 11 / 3, 9.81))
    assert (first + second) / 2 == pytest.approx(-left)
    assert balanced[0] == pytest.approx(0, abs=1e-14)


def test_a_movable_pulley_is_balanced_by_half_its_weight() -> None:
    assert pulleys.movable_pulley_acceleration(1, 2, 9.81) == 0
    assert newtons_laws.resultant((3, 4), (-1, 2)) == (2, 6)


def test_a_block_pulled_loose_obeys_its_equation_of_motion() -> None:
    """m dv/dt = k t − μk N once k t > μs N, and nothing before."""
    static, kinetic, mass, growth = 6.0, 3.0, 2.0, 4.0
    t = np.linspace(1.6, 3, 1401)
    way, v = newtons_laws.pulled_loose(static, kinetic, mass, growth, t)

    assert newtons_laws.break_loose_time(static, growth) == 1.5
    assert np.gradient(way, t)[1:-1] == pytest.approx(v[1:-1], rel=1e-5)
    assert mass * np.gradient(v, t)[1:-1] == pytest.approx(growth * t[1:-1] - kinetic, rel=1e-6)
    assert [float(x) for x in newtons_laws.pulled_loose(static, kinetic, mass, growth, 1.5)] == [
        0,
        0,
    ]


def test_a_rocket_obeys_its_equation_of_motion() -> None:
    """m dv/dt = μ u, and its distance is the integral of its velocity."""
    u, rate, start = 30.0, 2.0, 10.0
    t = np.linspace(0.1, 4, 4001)
    v = newtons_laws.rocket_velocity(u, start - rate * t, start)
    way = newtons_laws.rocket_way(u, rate, start, t)

    assert (start - rate * t)[1:-1] * np.gradient(v, t)[1:-1] == pytest.approx(rate * u, rel=1e-5)
    assert np.gradient(way, t)[1:-1] == pytest.approx(v[1:-1], rel=1e-5)
    assert newtons_laws.rocket_velocity(u, start / np.e, start) == pytest.approx(u)


def test_a_launch_waits_until_the_rocket_is_light_enough() -> None:
    assert newtons_laws.lift_off(60, 2, 10, 10) == 0
    assert newtons_laws.lift_off(30, 2, 10, 10) == 2
    v = newtons_laws.launch_velocity(30, 2, 10, 10, np.array([1.0, 2.0, 3.0]))
    assert v[:2].tolist() == [0, 0]
    assert v[2] == pytest.approx(30 * np.log(6 / 4) - 10)


def test_a_filling_cart_keeps_its_momentum_or_its_speed() -> None:
    mass, v = newtons_laws.filling_cart(0, 1, 2, 3, 4)
    assert (float(mass), float(v)) == (6, 1)
    assert newtons_laws.filling_cart(3, 1, 2, 3, 4)[1] == 3


def test_an_incline_holds_to_the_static_angle_and_slides_by_the_kinetic_coefficient() -> None:
    assert newtons_laws.sticking_acceleration(np.arctan(0.5), 9.81, 0.6, 0.4) == 0
    assert newtons_laws.sticking_acceleration(np.arctan(0.75), 10, 0.6, 0.4) == pytest.approx(
        10 * (0.6 - 0.4 * 0.8)
    )


def test_a_belt_drives_a_block_up_to_its_own_speed() -> None:
    t = np.linspace(0, 2, 2001)
    v = np.gradient(newtons_laws.carried_way(2.0, 0.4, 10, t), t)

    assert v[1:499] == pytest.approx(4 * t[1:499])
    assert v[502:] == pytest.approx(2)
    assert newtons_laws.belt_momentum(2, 3, 4) == 24


def test_a_light_wheel_leaves_atwoods_machine_and_a_heavy_one_holds_it() -> None:
    light = pulleys.massive_pulley_tensions(1, 2, 0, 9.81)

    assert light == pytest.approx([pulleys.atwood_tension(1, 2, 9.81)] * 2)
    assert pulleys.massive_pulley_tensions(1, 2, 1e12, 9.81) == pytest.approx((9.81, 19.62))


def test_a_movable_pulley_hangs_on_twice_its_tension() -> None:
    a = pulleys.movable_pulley_acceleration(2.0, 3.0, 9.81)

    assert 2 * pulleys.movable_pulley_tension(2.0, 3.0, 9.81) == pytest.approx(3.0 * (9.81 + a))


def test_a_block_that_slips_is_held_by_less_than_one_that_sticks() -> None:
    steep = np.arctan(0.6)

    held = newtons_laws.sticking_friction(2.0, steep * 0.999, 9.81, 0.6, 0.4)
    slips = newtons_laws.sticking_friction(2.0, steep * 1.001, 9.81, 0.6, 0.4)

    assert slips == pytest.approx(held * 0.4 / 0.6, rel=0.01)


def test_a_pad_holds_up_nothing_once_the_thrust_lifts_the_rocket() -> None:
    assert newtons_laws.pad_force(50.0, 2.0, 100.0, 9.81) == pytest.approx(881.0)
    assert newtons_laws.pad_force(50.0, 20.0, 100.0, 9.81) == 0
