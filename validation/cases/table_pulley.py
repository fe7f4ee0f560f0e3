"""A block on a table, drawn by a weight over the edge: contact and string share the work."""

from collections.abc import Iterator
from functools import partial

from validation.case import Case, Choices, Parameters, ends
from validation.formulas import newton

SMOOTH: Choices = ({}, *ends("newton/table-and-pulley", "m2"))
ROUGH: Choices = (
    {},
    {"m1": 10.0, "m2": 10.0, "mu": 0.9, "g": 25.0},
    {"m1": 0.1, "m2": 5.0, "mu": 0.0, "g": 1.0},
)
HOLDS: Choices = (
    {"mu": 0.6},
    {"m1": 10.0, "m2": 9.0, "mu": 1.0},
    {"m1": 10.0, "m2": 0.1, "mu": 0.5},
)

START = -2.2  # m, where the block begins


def cases() -> Iterator[Case]:
    """Yield the cases of the table and the pulley."""
    for level, choices in (
        ("newton/table-and-pulley", SMOOTH),
        ("newton/table-and-pulley-with-friction", ROUGH),
    ):
        for parameters in choices:
            yield from _drawn(level, parameters)
    for parameters in HOLDS:
        yield Case(
            name="table and pulley: creep in 10 s where friction holds",
            level="newton/table-and-pulley-with-friction",
            parameters=parameters,
            quantity="block.position.x",
            duration=10.0,
            expected=lambda _, __: START,
            tolerance=4e-10,  # of 2.2 m: 1e-9 m
            because="string and friction have come to terms before the first step",
            naive_misses=4e-10,
        )


def _rounding(g: float) -> float:
    """Return how well a tension is known that is chosen by the length of the string, relatively.

    Lengths of 3 m are known to 6e-16 m; differenced twice, at 60 Hz, that is 2e-12 m/s², or a few
    times as much where both ends round, beside g. Measured: 5.4e-12 at 1 m/s², 4e-13 at 9.81 m/s².
    """
    return 1e-12 if g > 5 else 1e-11


def _drawn(level: str, parameters: Parameters) -> Iterator[Case]:
    case = partial(Case, level=level, parameters=parameters)
    yield case(
        name="table and pulley: displacement at every step",
        quantity="block.position.x",
        expected=lambda p, t: (
            START
            + newton.table_pulley_acceleration(p["m1"], p["m2"], p["g"], p.get("mu", 0.0))
            * t**2
            / 2
        ),
        tolerance=1e-10,
        because="string and contact are solved together",
        naive_misses=1e-3,
    )
    yield case(
        name="table and pulley: tension at every step",
        quantity="string.tension",
        expected=lambda p, _: newton.table_pulley_tension(
            p["m1"], p["m2"], p["g"], p.get("mu", 0.0)
        ),
        tolerance=_rounding(parameters.get("g", 9.81)),
        because="as for the displacement, and known to the rounding of the string's length",
    )
