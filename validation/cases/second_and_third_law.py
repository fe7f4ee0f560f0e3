"""One force on several masses, and two skaters who push each other."""

from collections.abc import Iterator

from sandbox.model.expressions import Expression
from validation.case import Case, Choices
from validation.formulas import momentum, newton

FORCES: Choices = ({}, {"F": 10.0, "m": 0.5}, {"F": 0.5, "m": 5.0})
SKATERS: Choices = ({}, {"m1": 40.0, "m2": 120.0, "F": 400.0}, {"m1": 120.0, "m2": 40.0, "F": 20.0})

LASTS = 0.5  # s, the push


def cases() -> Iterator[Case]:
    """Yield the cases of the second and the third law."""
    for parameters in FORCES:
        for body, times in (("single", 1), ("double", 2), ("fourfold", 4)):
            yield Case(
                name=f"second law: position of the {body} mass at every step",
                level="newton/second-law",
                parameters=parameters,
                quantity=f"{body}.position.x",
                expected=lambda p, t, times=times: (  # type: ignore[misc]
                    newton.acceleration(p["F"], times * p["m"]) * t**2 / 2
                ),
                tolerance=1e-12,
                because="leapfrog is exact for constant acceleration",
                naive_misses=1e-3,
            )
    for parameters in SKATERS:
        for body, mass, sign in (("left", "m1", -1), ("right", "m2", 1)):
            yield Case(
                name=f"third law: velocity of the {body} skater after the push",
                level="newton/third-law",
                parameters=parameters,
                quantity=f"{body}.velocity.x",
                at=Expression(2.0),
                expected=lambda p, _, mass=mass, sign=sign: (  # type: ignore[misc]
                    sign * momentum.swelling_push_momentum(p["F"], LASTS) / p[mass]
                ),
                tolerance=1e-12,
                because="the kicks are a trapezoidal sum, exact for a whole swelling of sin²",
            )
