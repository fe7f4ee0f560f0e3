"""A shell that bursts in flight: its centre of mass takes no notice."""

from collections.abc import Iterator

from sandbox.model.expressions import Array, Expression, Values
from validation.case import Case, Choices, Expected
from validation.formulas import kinematics, momentum

PARAMETERS: Choices = (
    {},
    {"J": 8.0, "vy": 16.0, "m1": 0.5, "m2": 4.0, "m3": 0.5, "g": 5.0},
    {"vx": 2.0, "m1": 4.0, "m2": 0.5, "m3": 4.0},
    {"J": 0.0, "vx": 10.0, "vy": 8.0, "g": 12.0},
)
GIVEN = {"left": -0.8, "middle": 0.1, "right": 0.7}  # of J, across
EXACT = "uniform acceleration is exact, and the forces within add up to nothing at every step"


def cases() -> Iterator[Case]:
    """Yield the cases of the burst."""
    for parameters in PARAMETERS:
        for axis, expected in (("x", _across), ("y", _up)):
            yield Case(
                name=f"burst: centre of mass, {axis}",
                level="momentum/burst",
                parameters=parameters,
                quantity=f"system.center.{axis}",
                expected=expected,
                tolerance=1e-12,
                because=EXACT,
                naive_misses=1e-4 if axis == "y" else None,
            )
        for name, piece in (("left", "m1"), ("middle", "m2"), ("right", "m3")):
            yield Case(
                name=f"burst: momentum of the {name} piece after it",
                level="momentum/burst",
                parameters=parameters,
                quantity=f"{name}.momentum.x",
                at=Expression("0.6*vy/g + 0.1"),
                expected=_after(name, piece),
                tolerance=1e-12,
                because="a sum over whole swellings of sin² is its integral, to rounding",
            )


def _after(name: str, piece: str) -> Expected:
    return lambda p, _: p[piece] * p["vx"] + GIVEN[name] * p["J"]


def _across(p: Values, t: Array) -> Array:
    start = 0.25 * (p["m3"] - p["m1"]) / (p["m1"] + p["m2"] + p["m3"])
    return momentum.center_of_mass([(1.0, start, p["vx"])], t)


def _up(p: Values, t: Array) -> Array:
    return kinematics.uniform_position(p["vy"], -p["g"], t)
