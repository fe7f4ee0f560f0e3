"""The bounds on leapfrog, compared with a leapfrog written here in a few lines."""

from collections.abc import Callable

import pytest

from validation.formulas import energy, leapfrog_error

MOST = 100_000  # steps


def orbit(
    place: complex, velocity: complex, mu: float, dt: float, until: Callable[[complex], bool]
) -> tuple[complex, complex]:
    """Return place and velocity at the first step at which the velocity has turned so far."""

    def kick(r: complex) -> complex:
        return -mu * r / abs(r) ** 3 * dt / 2

    for _ in range(MOST):
        velocity += kick(place)
        place += velocity * dt
        velocity += kick(place)
        if until(velocity):
            return place, velocity
    raise AssertionError("it never comes so far")


@pytest.mark.parametrize("e", [0.0, 0.2, 0.6])
def test_the_far_end_of_an_orbit_is_as_far_off_as_derived(e: float) -> None:
    mu, near, dt = 8.0, 1.5, 1e-3
    far = near * (1 + e) / (1 - e)
    speed = energy.apsis_speed(near, far, mu)

    place, _ = orbit(complex(near), speed * 1j, mu, dt, lambda v: v.real > 0)

    assert abs(place) / far - 1 == pytest.approx(
        leapfrog_error.far_end_error(near, e, mu, dt), rel=0.05
    )


@pytest.mark.parametrize("share", [0.5, 0.85])
def test_a_body_turns_as_much_too_early_as_derived(share: float) -> None:
    mu, r, dt = 10.0, 1.5, 1e-3
    speed = share * float(energy.escape_speed(mu, r))

    place, velocity = orbit(complex(r), complex(speed), mu, dt, lambda v: v.real < 0)
    energy_there = abs(velocity) ** 2 / 2 - mu / abs(place)
    start = speed**2 / 2 - mu / r

    assert start - energy_there == pytest.approx(
        leapfrog_error.escape_energy_error(r, share, mu, dt), rel=0.05
    )
    assert leapfrog_error.turning_error(r, share, mu, dt) == pytest.approx(
        (start - energy_there) / -start, rel=0.05
    )
