"""Blocks on inclines: without friction, sliding with it, and held by it."""

from collections.abc import Iterator
from functools import partial
from math import radians

from sandbox.model.expressions import Values
from validation.case import Case, Choices, Expected, Parameters, ends
from validation.formulas import newton
from validation.formulas.arrays import Array

SLIDES: Choices = (
    {},
    {"angle": 75.0, "g": 1.0, "mass": 0.1},
    {"angle": 5.0, "g": 25.0, "mass": 100.0},
)
RUBS: Choices = ({}, {"angle": 20.0, "mu": 0.1}, *ends("newton/incline-with-friction"))
HOLDS: Choices = (
    {},
    {"angle": 40.0, "mu": 1.0, "mass": 100.0},
    {"angle": 5.0, "mu": 0.1, "mass": 0.1, "g": 25.0},
    {"g": 1.0},
)
SLIDES_ALL_THE_SAME: Choices = ({"angle": 75.0}, {"mu": 0.0})

START = 6.0  # m, along the ramp from its foot, where the block's face begins
HALF_HEIGHT = 0.25  # m, of the block


def cases() -> Iterator[Case]:
    """Yield the cases of inclines."""
    for parameters in SLIDES:
        yield from _sliding("incline", "newton/incline", parameters)
        yield Case(
            name="incline: normal force",
            level="newton/incline",
            parameters=parameters,
            quantity="block.contact.normal",
            expected=lambda p, _: newton.incline_normal_force(
                p["mass"], radians(p["angle"]), p["g"]
            ),
            tolerance=1e-10,
            because="the sum of the solver's impulses over a step",
        )
    for parameters in RUBS:
        yield from _sliding("incline with friction", "newton/incline-with-friction", parameters)
        yield _friction("incline with friction", "newton/incline-with-friction", parameters)
    for parameters in (*HOLDS, *SLIDES_ALL_THE_SAME):
        yield _friction("incline that holds", "newton/incline-that-holds", parameters)
    for parameters in HOLDS:
        yield Case(
            name="incline that holds: creep in 10 s",
            level="newton/incline-that-holds",
            parameters=parameters,
            quantity="block.position.x",
            duration=10.0,
            expected=_x(5.0),
            tolerance=1e-10,  # of some 5 m: 5e-10 m
            because="the solver's impulses hold the block to rounding",
        )


def _sliding(name: str, level: str, parameters: Parameters) -> Iterator[Case]:
    case = partial(Case, level=level, parameters=parameters)
    yield case(
        name=f"{name}: displacement at every step",
        quantity="block.position.x",
        expected=_x(START),
        tolerance=1e-10,
        because="constant acceleration, and contact impulses solved to rounding",
        naive_misses=5e-4,
    )
    yield case(
        name=f"{name}: acceleration at every step",
        quantity="block.acceleration",
        expected=lambda p, _: newton.incline_acceleration(
            radians(p["angle"]), p["g"], p.get("mu", 0.0)
        ),
        tolerance=1e-10,
        because="contact impulses solved to rounding",
        naive_misses=1e-3,  # its block falls freely in the first step: touching is no contact
    )


def _friction(name: str, level: str, parameters: Parameters) -> Case:
    return Case(
        name=f"{name}: friction",
        level=level,
        parameters=parameters,
        quantity="block.contact.friction",
        expected=lambda p, _: newton.incline_friction(
            p["mass"], radians(p["angle"]), p["g"], p["mu"]
        ),
        tolerance=1e-10,
        because="the sum of the solver's impulses over a step",
    )


def _x(start: float) -> Expected:
    """Return the closed form of the block's place across, for where it starts on the ramp [m]."""

    def x(p: Values, t: Array) -> Array:
        angle = radians(p["angle"])
        way = newton.incline_acceleration(angle, p["g"], p.get("mu", 0.0)) * t**2 / 2
        return newton.incline_point(start - way, HALF_HEIGHT, angle)

    return x
