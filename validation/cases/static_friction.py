"""Static friction that is stronger than kinetic: a pull that grows, and an incline."""

from collections.abc import Iterator
from functools import partial
from math import radians

from sandbox.model.expressions import Array, Expression, Values
from validation.case import SECOND_ORDER, Case, Choices, Parameters
from validation.formulas import newton

PULLS: Choices = (
    {},
    {"mu_s": 0.8, "mu_k": 0.0, "mass": 4.0, "pull": 2.0, "g": 15.0},
    {"mu_s": 0.4, "mu_k": 0.4, "mass": 1.0, "pull": 10.0, "g": 5.0},
)
SLOPES: Choices = (
    {"angle": 31.0},  # tan 30.96° = 0.6
    {"angle": 60.0, "mu_s": 0.9, "mu_k": 0.0, "mass": 100.0, "g": 1.0},
)
HOLDS: Choices = (
    {"angle": 30.9},
    {"angle": 10.0, "mu_s": 0.5, "mass": 0.1},
    {"angle": 41.9, "mu_s": 0.9, "mu_k": 0.5, "g": 25.0},  # tan 41.99° = 0.9
)

START = 5.0  # m, along the ramp from its foot
HALF_HEIGHT = 0.25  # m


def cases() -> Iterator[Case]:
    """Yield the cases of static friction."""
    end = Expression("mu_s*mass*g/pull + 1")
    for parameters in PULLS:
        case = partial(Case, level="newton/breaking-loose", parameters=parameters)
        yield case(
            name="breaking loose: velocity a second later",
            quantity="block.velocity.x",
            at=end,
            expected=lambda p, t: _pulled(p, t)[1],
            tolerance=2e-5,
            because="the moment is found between two steps: second order",
            naive_misses=1e-4,
        )
        yield case(
            name="breaking loose: way a second later",
            quantity="block.position.x",
            at=end,
            expected=lambda p, t: _pulled(p, t)[0],
            tolerance=1e-4,
            order=SECOND_ORDER,
            because="second order, as the velocity",
        )
        yield case(
            name="breaking loose: friction just before",
            quantity="block.contact.friction",
            at=Expression("0.98*mu_s*mass*g/pull"),
            expected=lambda p, _: 0.98 * p["mu_s"] * p["mass"] * p["g"],
            tolerance=1e-10,
            because="the solver's impulse over a step, of a load that grows evenly",
        )
    for parameters in (*SLOPES, *HOLDS):
        yield from _slope(parameters, slips=parameters in SLOPES)


def _slope(parameters: Parameters, *, slips: bool) -> Iterator[Case]:
    solved = "contact impulses solved to rounding"
    case = partial(Case, level="newton/incline-breaks-loose", parameters=parameters)
    yield case(
        name="sticks or slips: place at every step",
        quantity="block.position.x",
        expected=_on_slope,
        tolerance=1e-12,
        because=f"constant acceleration, and {solved}",
        naive_misses=1e-3 if slips else None,
    )
    yield case(
        name="sticks or slips: acceleration",
        quantity="block.acceleration",
        expected=lambda p, _: newton.sticking_acceleration(
            radians(p["angle"]), p["g"], p["mu_s"], p["mu_k"]
        ),
        tolerance=1e-10,
        because=solved,
    )
    yield case(
        name="sticks or slips: friction",
        quantity="block.contact.friction",
        expected=lambda p, _: newton.sticking_friction(
            p["mass"], radians(p["angle"]), p["g"], p["mu_s"], p["mu_k"]
        ),
        tolerance=1e-10,
        because=solved,
    )


def _pulled(p: Values, t: Array) -> tuple[Array, Array]:
    normal = p["mass"] * p["g"]
    return newton.pulled_loose(p["mu_s"] * normal, p["mu_k"] * normal, p["mass"], p["pull"], t)


def _on_slope(p: Values, t: Array) -> Array:
    angle = radians(p["angle"])
    a = newton.sticking_acceleration(angle, p["g"], p["mu_s"], p["mu_k"])
    return newton.incline_point(START - a * t**2 / 2, HALF_HEIGHT, angle)
