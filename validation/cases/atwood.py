"""The Atwood machine, from 1 : 1 to 1 : 1,000,000."""

from collections.abc import Iterator
from functools import partial

from validation.case import Case, Parameters, ends
from validation.formulas import newton

LEVELS: tuple[tuple[str, Parameters], ...] = (
    ("newton/atwood", {}),
    *(("newton/atwood", p) for p in ends("newton/atwood", "m2")),
    ("newton/atwood-equal-masses", {}),
    *(("newton/atwood-equal-masses", p) for p in ends("newton/atwood-equal-masses")),
    ("newton/atwood-thousand-to-one", {}),
    ("newton/atwood-thousand-to-one", {"m2": 1e6}),
    *(("newton/atwood-thousand-to-one", p) for p in ends("newton/atwood-thousand-to-one", "m2")),
)


def cases() -> Iterator[Case]:
    """Yield the cases of the Atwood machine."""
    for level, parameters in LEVELS:
        moves = level != "newton/atwood-equal-masses"
        case = partial(Case, level=level, parameters=parameters)
        yield case(
            name="Atwood: displacement at every step",
            quantity="left.position.y",
            expected=lambda p, t: newton.atwood_acceleration(p["m1"], p["m2"], p["g"]) * t**2 / 2,
            tolerance=1e-12,
            because="the string is straight: one Newton step solves it, to rounding",
            naive_misses=1e-3 if moves else None,
        )
        yield case(
            name="Atwood: tension at every step",
            quantity="string.tension",
            expected=lambda p, _: newton.atwood_tension(p["m1"], p["m2"], p["g"]),
            tolerance=1e-13,
            because="known to the rounding of the velocities: 4e-16 m/s over dt is 3e-14 m/s²",
        )
