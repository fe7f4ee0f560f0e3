"""The bounds on leapfrog, held against a leapfrog written here in a few lines."""

from collections.abc import Callable

import pytest

from validation.formulas import energy, leapfrog


def stop(speed: float, rate: float, dt: float) -> float:
    """Return how far a body comes until friction, μ g, has stopped it [m]."""
    v, x = max(speed - rate * dt / 2, 0.0), 0.0
    while v:
        x, v = x + v * dt, max(v - rate * dt, 0.0)
    return x


def orbit(
    place: complex, velocity: complex, mu: float, dt: float, until: Callable[[complex], bool]
) -> tuple[complex, complex]:
    """Return place and velocity at the first step at which the velocity has come that far."""

    def kick(r: complex) -> complex:
        return -mu * r / abs(r) ** 3 * dt / 2

    while True:
        velocity += kick(place)
        place += velocity * dt
        velocity += kick(place)
        if until(velocity):
            return place, velocity


@pytest.mark.parametrize("part", [0.0, 0.3, 0.5, 0.8])
def test_a_stop_inside_a_step_is_short_by_no_more_than_its_bound(part: float) -> None:
    dt, rate = 0.01, 4.0
    speed = rate * dt * (50 + part)

    error = 1 - stop(speed, rate, dt) / (speed**2 / (2 * rate))
    bound = leapfrog.stopping_error(speed, 0.4, 10, dt)

    assert -1e-12 <= error <= bound * (1 + 1e-9)
    if part == 0.5:
        assert error == pytest.approx(bound)


@pytest.mark.parametrize("e", [0.0, 0.2, 0.6])
def test_the_far_end_of_an_orbit_is_as_far_off_as_derived(e: float) -> None:
    mu, near, dt = 8.0, 1.5, 1e-3
    far = near * (1 + e) / (1 - e)
    speed = energy.apsis_speed(near, far, mu)

    place, _ = orbit(complex(near), speed * 1j, mu, dt, lambda v: v.real > 0)

    assert abs(place) / far - 1 == pytest.approx(leapfrog.far_end_error(near, e, mu, dt), rel=0.05)


@pytest.mark.parametrize("share", [0.5, 0.85])
def test_a_body_turns_as_much_too_early_as_derived(share: float) -> None:
    mu, r, dt = 10.0, 1.5, 1e-3
    speed = share * float(energy.escape_speed(mu, r))

    place, velocity = orbit(complex(r), complex(speed), mu, dt, lambda v: v.real < 0)
    energy_there = abs(velocity) ** 2 / 2 - mu / abs(place)
    start = speed**2 / 2 - mu / r

    assert start - energy_there == pytest.approx(
        leapfrog.escape_energy_error(r, share, mu, dt), rel=0.05
    )
    assert leapfrog.turning_error(r, share, mu, dt) == pytest.approx(
        (start - energy_there) / -start, rel=0.05
    )


def test_what_slips_is_misplaced_by_no_more_than_a_stop_of_as_much_friction() -> None:
    way = 3.0**2 / (2 * 0.5 * 10)

    assert leapfrog.slip_error(0.5, 10, 0.01) / way == pytest.approx(
        leapfrog.stopping_error(3.0, 0.5, 10, 0.01)
    )
