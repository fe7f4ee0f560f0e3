"""Work and energy: orbits and ramps, compared with conservation laws and Newton's law."""

from math import pi, sqrt

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from validation.formulas import Array, energy, kinematics, newtons_laws

positive = st.floats(0.01, 100)
angles = st.floats(0.05, pi / 2 - 0.05)
eccentricities = st.floats(0, 0.85)


@pytest.mark.sweep
@given(positive, angles, positive, positive)
def test_energy_gives_the_speed_of_landing(
    speed: float, angle: float, g: float, height: float
) -> None:
    t = kinematics.flight_time(speed, angle, g, height)
    down = speed * np.sin(angle) - g * t

    assert np.hypot(speed * np.cos(angle), down) == pytest.approx(
        energy.landing_speed(speed, g, height)
    )


def test_a_circular_orbit_has_half_its_potential_energy() -> None:
    assert energy.circular_orbit_speed(8, 2) == pytest.approx(2)
    assert energy.circular_orbit_energy(8, 2) == pytest.approx(-2)
    assert energy.circular_orbit_speed(8, 2) == pytest.approx(sqrt(8 / 2))


def test_a_ball_from_2_m_comes_down_the_ramp_at_6_26_m_per_s() -> None:
    assert energy.landing_speed(0, 9.81, 2) == pytest.approx(6.26, abs=0.005)


@pytest.mark.sweep
@given(positive, angles, positive)
def test_a_ramp_takes_as_long_as_newton_says(height: float, angle: float, g: float) -> None:
    t = energy.ramp_time(height, angle, g)

    assert newtons_laws.incline_acceleration(angle, g) * t**2 / 2 == pytest.approx(
        height / np.sin(angle)
    )
    assert newtons_laws.incline_acceleration(angle, g) * t == pytest.approx(
        energy.landing_speed(0, g, height)
    )


@given(positive, positive, positive, positive)
def test_work_and_newton_agree_on_the_braking_distance(
    mass: float, speed: float, mu: float, g: float
) -> None:
    distance = energy.work_distance(mass, speed, mu * mass * g)

    assert distance == pytest.approx(newtons_laws.stopping_distance(speed, mu, g))
    assert energy.work_distance(mass, 2 * speed, mu * mass * g) == pytest.approx(4 * distance)


@given(positive, positive, positive)
def test_both_ends_of_an_orbit_have_one_energy_and_one_angular_momentum(
    near: float, far: float, mu: float
) -> None:
    fast, slow = energy.apsis_speed(near, far, mu), energy.apsis_speed(far, near, mu)
    total = energy.kepler_energy((near + far) / 2, mu)

    assert near * fast == pytest.approx(far * slow)
    assert fast**2 / 2 - mu / near == pytest.approx(total, abs=1e-9 * mu / near)
    assert slow**2 / 2 - mu / far == pytest.approx(total, abs=1e-9 * mu / far)


@given(positive, positive)
def test_a_circle_is_an_ellipse_too(r: float, mu: float) -> None:
    speed = energy.circular_orbit_speed(mu, r)

    assert energy.apsis_speed(r, r, mu) == pytest.approx(speed)
    assert energy.kepler_energy(r, mu) == pytest.approx(energy.circular_orbit_energy(mu, r))
    assert energy.kepler_period(r, mu) == pytest.approx(kinematics.circular_period(speed, r))


@given(st.floats(0.1, 10), eccentricities, st.floats(0.1, 10))
def test_keplers_ellipse_has_the_sun_in_a_focus_and_ends_where_it_began(
    near: float, e: float, mu: float
) -> None:
    a = near / (1 - e)
    period = energy.kepler_period(a, mu)
    x, y = energy.kepler_place(near, e, mu, np.linspace(0, period, 25))

    # the sum of the distances from both foci, the sun and (−2 a e, 0), is 2 a
    assert np.hypot(x, y) + np.hypot(x + 2 * a * e, y) == pytest.approx(2 * a)
    assert (x[0], y[0]) == pytest.approx((near, 0), abs=1e-9 * a)
    assert (x[12], y[12]) == pytest.approx((-a * (1 + e), 0), abs=1e-9 * a)
    assert (x[24], y[24]) == pytest.approx((near, 0), abs=1e-9 * a)


@pytest.mark.sweep
@given(eccentricities)
def test_the_line_to_the_sun_sweeps_equal_areas_in_equal_times(e: float) -> None:
    t = np.linspace(0, energy.kepler_period(1, 1), 2001)
    x, y = energy.kepler_place(1 - e, e, 1, t)
    triangles = x[:-1] * y[1:] - x[1:] * y[:-1]

    assert triangles / np.diff(t) == pytest.approx(sqrt(1 - e**2), rel=1e-2)


@given(st.floats(0.1, 10), st.floats(0.1, 10), st.floats(0.1, 10))
def test_a_body_that_escapes_has_the_escape_speed_wherever_it_is(
    r: float, mu: float, t: float
) -> None:
    h = 1e-4 * t
    before, now, after = energy.escape_distance(r, mu, [t - h, t, t + h])

    assert (after - before) / (2 * h) == pytest.approx(energy.escape_speed(mu, now), rel=1e-5)
    assert energy.escape_distance(r, mu, 0) == pytest.approx(r)


@given(positive, st.floats(0.05, 0.95), positive)
def test_a_slower_one_turns_where_its_energy_ends(r: float, share: float, mu: float) -> None:
    start = (share * float(energy.escape_speed(mu, r))) ** 2 / 2 - mu / r

    assert -mu / energy.turning_distance(r, share) == pytest.approx(start)


def test_near_the_start_turning_is_a_throw_in_uniform_gravity() -> None:
    """For a small share f of the escape speed g = μ / r², so it rises for f √(2 μ / r) / g."""
    assert energy.turning_distance(1, 1e-3) - 1 == pytest.approx(1e-6, rel=1e-3)
    assert energy.turning_time(1, 1e-3, 1) == pytest.approx(1e-3 * sqrt(2), rel=1e-3)


def test_an_orbit_that_turns_obeys_newton() -> None:
    """Second differences of x and y against −(μ / r³ + ε / r⁴) r; off by h² of the fourth slope."""
    near, e, mu, extra, h = 1.5, 0.5, 8.0, 3.0, 1e-4
    t = 1.7 + h * np.array([-1, 0, 1])
    r, angle = energy.revolving_place(near, e, mu, extra, np.concatenate(([0, 0.9], t)))
    x, y = (r * np.cos(angle))[2:], (r * np.sin(angle))[2:]
    pull = mu / r[3] ** 3 + extra / r[3] ** 4

    assert (x[0] - 2 * x[1] + x[2]) / h**2 == pytest.approx(-pull * x[1], rel=1e-5)
    assert (y[0] - 2 * y[1] + y[2]) / h**2 == pytest.approx(-pull * y[1], rel=1e-5)


def test_the_perihelia_of_an_orbit_that_turns_advance_alike() -> None:
    """By 2π (1/κ − 1) per revolution, with κ² = 1 − ε / h²."""
    near, e, mu, extra = 1.5, 0.3, 8.0, 2.0
    turns = np.linspace(0, 3, 31) * energy.kepler_period(near / (1 - e), mu)
    r, angle = energy.revolving_place(near, e, mu, extra, turns)
    kappa = np.sqrt(1 - extra / (mu * near * (1 + e) + extra))

    assert r[::10] == pytest.approx(near)
    assert angle[::10] == pytest.approx(2 * np.pi / kappa * np.arange(4))


@pytest.mark.sweep
def test_the_figure_eight_closes_and_its_stars_follow_each_other() -> None:
    """After a third of the period 6.32591398 √(a³ / (G m)) each is where another was."""
    period = 6.32591398292621 * np.sqrt(8 / 8)
    start, third, end = energy.figure_eight(2, 4, 2, [0, period / 3, period]).T

    assert end == pytest.approx(start, abs=1e-10)
    assert third == pytest.approx(np.roll(start, 2), abs=1e-10)


def test_equal_bodies_circle_faster_than_about_a_fixed_sun() -> None:
    assert energy.two_body_period(3, 3, 4, 2) == pytest.approx(
        energy.kepler_period(2, 12) / np.sqrt(2)
    )


def test_a_push_across_the_path_does_no_work_and_one_at_60_degrees_half_of_it() -> None:
    assert energy.work(200j, 3 + 0j) == 0
    assert energy.work(200 + 0j, 3 + 0j) == 600
    assert energy.work(200 * np.exp(1j * pi / 3), 3 + 0j) == pytest.approx(300)


@given(st.floats(1, 10), st.floats(0.1, 5), st.floats(0.1, 10))
def test_a_repelled_body_turns_later_than_without_repulsion_and_as_newton_says(
    r: float, speed: float, k: float
) -> None:
    """The time over u, dt = √(a³/k) (1 + cosh u) du, as a sum of small steps of dr / v."""
    near = energy.closest_approach(r, speed, k)
    u = np.linspace(0, np.sqrt(r - near), 4001)  # r = near + u², for v = 0 at the start
    middle = near + ((u[1:] + u[:-1]) / 2) ** 2
    v = np.sqrt(2 * k * (1 / near - 1 / middle))
    steps = (u[1:] + u[:-1]) * np.diff(u) / v

    assert near < r
    assert energy.repelled_time(r, speed, k) == pytest.approx(steps.sum(), rel=1e-5)


def test_a_body_twice_as_fast_comes_from_far_away_four_times_as_near() -> None:
    slow, fast = (energy.closest_approach(1e9, speed, 2.0) for speed in (1.0, 2.0))

    assert slow == pytest.approx(4 * fast)


@given(positive, angles, positive)
def test_a_straight_descent_takes_as_long_as_newton_says(h: float, angle: float, g: float) -> None:
    found = energy.time_of_descent(lambda p: p * h / np.tan(angle), lambda p: h * (1 - p), g)

    assert found == pytest.approx(sqrt(2 * h / g) / np.sin(angle), rel=1e-8)


@pytest.mark.parametrize("start", [0.3, 1.0, 2.0, 3.0])
def test_a_cycloid_takes_as_long_from_anywhere(start: float) -> None:
    def angle(p: Array) -> Array:
        return start * (1 - p)

    found = energy.time_of_descent(
        lambda p: angle(p) + np.sin(angle(p)), lambda p: 1 - np.cos(angle(p)), 9.81
    )
    assert found == pytest.approx(pi / sqrt(9.81), rel=1e-7)


def test_a_bead_that_falls_through_half_a_circle_weighs_three_times_as_much_at_its_foot() -> None:
    assert energy.trough_force(2.0, 1.5, 1.5, 9.81) == pytest.approx(3 * 2.0 * 9.81)


@given(positive, positive)
def test_the_slowest_that_stays_in_a_loop_is_weightless_at_its_top(radius: float, g: float) -> None:
    slowest = sqrt(5 * g * radius)

    assert energy.loop_speed(slowest, radius, g) == pytest.approx(sqrt(g * radius))
    assert energy.loop_force(2.0, slowest, radius, g) == pytest.approx(0, abs=1e-10 * g)
