"""A circular orbit: the first force that depends on the place, so second order and not exact."""

from collections.abc import Iterator

from validation.case import SECOND_ORDER, Case, Choices
from validation.formulas import energy

PARAMETERS: Choices = ({}, {"r": 1.5, "mu": 12.0}, {"r": 4.0, "mu": 1.0})


def cases() -> Iterator[Case]:
    """Yield the cases of the circular orbit."""
    for parameters in PARAMETERS:
        yield Case(
            name="circular orbit: distance at every step",
            level="energy/circular-orbit",
            parameters=parameters,
            quantity="planet.position",
            expected=lambda p, _: p["r"],
            tolerance=1e-4,
            order=SECOND_ORDER,
            because="leapfrog's orbit is an ellipse of eccentricity (ω dt)² / 2, at most 3.1e-5",
            naive_misses=1e-4,
        )
        yield Case(
            name="circular orbit: speed at every step",
            level="energy/circular-orbit",
            parameters=parameters,
            quantity="planet.speed",
            expected=lambda p, _: energy.circular_orbit_speed(p["mu"], p["r"]),
            tolerance=1e-4,
            order=SECOND_ORDER,
            because="as for the distance",
            naive_misses=1e-4,
        )
        yield Case(
            name="circular orbit: energy at every step",
            level="energy/circular-orbit",
            parameters=parameters,
            quantity="planet.energy",
            expected=lambda p, _: energy.circular_orbit_energy(p["mu"], p["r"]),
            tolerance=1e-8,
            because="fourth order in ω dt = 7.9e-3 on a circle, as velocities at the step are",
        )
