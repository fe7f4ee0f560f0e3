"""The Atwood machine, from 1 : 1 to 1 : 1,000,000."""

from collections.abc import Iterator

from validation.case import Case, Parameters
from validation.formulas import newton

LEVELS: tuple[tuple[str, Parameters], ...] = (
    ("newton/atwood", {}),
    ("newton/atwood", {"m1": 10.0, "m2": 0.1}),
    ("newton/atwood", {"m1": 0.1, "m2": 10.0, "g": 1.62}),
    ("newton/atwood-equal-masses", {}),
    ("newton/atwood-thousand-to-one", {}),
    ("newton/atwood-thousand-to-one", {"m2": 1e6}),
)


def cases() -> Iterator[Case]:
    """Yield the cases of the Atwood machine."""
    for level, parameters in LEVELS:
        moves = level != "newton/atwood-equal-masses"
        yield Case(
            name="Atwood: displacement at every step",
            level=level,
            parameters=parameters,
            quantity="left.position.y",
            expected=lambda p, t: newton.atwood_acceleration(p["m1"], p["m2"], p["g"]) * t**2 / 2,
            tolerance=1e-12,
            because="the string is straight: one Newton step solves it, to rounding",
            naive_misses=1e-3 if moves else None,
        )
        yield Case(
            name="Atwood: tension at every step",
            level=level,
            parameters=parameters,
            quantity="string.tension",
            expected=lambda p, _: newton.atwood_tension(p["m1"], p["m2"], p["g"]),
            tolerance=1e-12 if not parameters.get("g") else 1e-11,
            because="the length is known to 1e-15 m; twice differenced that is 4e-12 m/s² of g",
        )
