"""The closed forms of the machines agree with their known limits."""

from math import asin, cos, exp, hypot, pi, radians, sin

import pytest

from validation.formulas import assorted_mechanics_problems

G = 9.81


def test_a_load_above_an_axle_is_carried_by_it() -> None:
    assert assorted_mechanics_problems.axle_loads([(100.0, 2.0)], (-1.0, 2.0)) == pytest.approx(
        (0.0, 100.0)
    )
    assert assorted_mechanics_problems.axle_loads([(100.0, 0.5)], (-1.0, 2.0)) == pytest.approx(
        (50.0, 50.0)
    )


@pytest.mark.parametrize("start", [45, 60, 80])
def test_a_ladder_leaves_its_wall_two_thirds_up(start: float) -> None:
    leaves = asin(2 / 3 * sin(radians(start)))

    assert assorted_mechanics_problems.ladder_push(
        radians(start), leaves, 10, 3, G
    ) == pytest.approx(0, abs=1e-12)
    assert assorted_mechanics_problems.ladder_push(radians(start), leaves + 0.01, 10, 3, G) > 0
    both = (form(radians(start), leaves, 3, G) for form in FORMS)
    assert next(both) == pytest.approx(next(both), rel=1e-12)


FORMS = (assorted_mechanics_problems.ladder_spin, assorted_mechanics_problems.fallen_ladder_spin)
"""They agree where the one takes over from the other."""


@pytest.mark.parametrize("mu", [0.1, 0.3, 0.5])
def test_a_light_rope_of_many_knots_holds_e_to_the_mu_phi(mu: float) -> None:
    """The knots' angle δ is too coarse by (μ + μ³) π δ² / 12: 7e-7 with 1,001 at μ = 0.5."""
    ratio = exp(mu * pi)

    assert assorted_mechanics_problems.capstan_acceleration(
        ratio, mu, 1001, 1e-9, G
    ) == pytest.approx(0, abs=1e-5)
    two = assorted_mechanics_problems.capstan_acceleration(2 * ratio, mu, 1001, 1e-9, G)
    assert two == pytest.approx(G / 3, rel=1e-5)


def test_without_friction_a_capstan_is_an_atwood_machine() -> None:
    """Its rope has the same weight on either side."""
    assert assorted_mechanics_problems.capstan_acceleration(
        2.0, 0.0, 25, 1e-12, G
    ) == pytest.approx(G / 3, rel=1e-9)


@pytest.mark.parametrize("masses", [(1.0, 1.0), (1.0, 50.0), (1000.0, 1.0)])
@pytest.mark.parametrize("degrees", [-30, 0, 20, 70, 90])
def test_an_elastic_dumbbell_keeps_its_energy(masses: tuple[float, float], degrees: float) -> None:
    """The struck end leaves with the speed with which it arrived."""
    speed, length, whole = 3.0, 2.0, sum(masses)
    spin, rise = assorted_mechanics_problems.dumbbell_bounce(
        masses, radians(degrees), speed, 1.0, length
    )

    moment = masses[0] * masses[1] / whole * length**2
    energy = (whole * rise**2 + moment * spin**2) / 2
    assert energy == pytest.approx(whole * speed**2 / 2, rel=1e-12)
    lever = -masses[1] / whole * length * cos(radians(degrees))
    assert rise + spin * lever == pytest.approx(speed, rel=1e-12)


def test_an_upright_dumbbell_bounces_as_a_ball() -> None:
    spin, rise = assorted_mechanics_problems.dumbbell_bounce((1.0, 3.0), pi / 2, 2.0, 0.5)

    assert spin == pytest.approx(0, abs=1e-15)
    assert rise == pytest.approx(1.0)


def test_a_trebuchet_whose_weight_hangs_at_the_axle_is_a_falling_stick() -> None:
    """From the horizontal to upside down: ω² = 3 g / L, for a stick on a pin at its end."""
    arm = 2.0, 2.0 * 4.0 / 3, 1.0

    spin = assorted_mechanics_problems.trebuchet_spin(
        0.0, -pi / 2, arm, 0.0, (5.0, 1.0), (0.0, 0j), G
    )

    assert spin == pytest.approx(-((3 * G / 2) ** 0.5), rel=1e-6)


def test_a_spiral_without_growth_is_a_loop() -> None:
    """Released at its top it presses on its side with 2 m g: it came down by its radius."""
    start = -(pi - 0.0001)

    force = assorted_mechanics_problems.spiral_force(1.0, 2.0, 0.0, start, pi / 2, G)

    assert force == pytest.approx(2 * G, rel=1e-6)
    assert abs(assorted_mechanics_problems.spiral(2.0, 0.1, 0.0)) == pytest.approx(2.0)
    assert hypot(assorted_mechanics_problems.spiral(2.0, 0.1, pi).real, 0) == pytest.approx(
        0, abs=1e-12
    )
