"""Inclines at their limits: two masses side by side, flat ground, and a vertical drop."""

from collections.abc import Iterator
from functools import partial
from math import radians

from sandbox.model.expressions import Values
from validation.case import Case, Choices, Expected, Parameters
from validation.formulas import newton
from validation.formulas.arrays import Array

MASSES: Choices = (
    {},
    {"times": 1000.0, "m": 10.0, "angle": 60.0, "g": 1.0},
    {"times": 1.0, "m": 0.1, "angle": 5.0, "g": 25.0},
)
LIMITS: Choices = (
    {},
    {"angle": 0.0},
    {"angle": 89.0, "mass": 0.1, "g": 25.0},
    {"angle": 1.0, "g": 1.0, "mass": 100.0},
)

START = 6.0  # m, along the ramp from its foot, where a block's face begins
HELD = "constant acceleration, and contact impulses solved to rounding"


def cases() -> Iterator[Case]:
    """Yield the cases of two masses, then those of the limits."""
    for parameters in MASSES:
        for block in ("light", "heavy"):
            case = partial(Case, level="newton/heavy-and-light", parameters=parameters)
            yield case(
                name=f"heavy and light: way of the {block} block",
                quantity=f"{block}.position.x",
                expected=_x(0.2),
                tolerance=1e-13,
                because=HELD,
                naive_misses=1e-3,
            )
            yield case(
                name=f"heavy and light: acceleration of the {block} block",
                quantity=f"{block}.acceleration",
                expected=_acceleration,
                tolerance=1e-12,
                because=HELD,
            )
    for parameters in LIMITS:
        yield from _limits(parameters)


def _limits(parameters: Parameters) -> Iterator[Case]:
    case = partial(Case, level="newton/incline-limits", parameters=parameters)
    moves = parameters.get("angle") != 0
    yield case(
        name="incline limits: acceleration at every step",
        quantity="block.acceleration",
        expected=_acceleration,
        tolerance=1e-12,
        because=HELD,
    )
    yield case(
        name="incline limits: height at every step",
        quantity="block.position.y",
        expected=lambda p, t: newton.incline_height(_along(p, t), 0.25, radians(p["angle"])),
        tolerance=1e-13,
        because=HELD,
        naive_misses=5e-4 if moves else None,
    )
    yield case(
        name="incline limits: normal force at every step",
        quantity="block.contact.normal",
        expected=lambda p, _: newton.incline_normal_force(p["mass"], radians(p["angle"]), p["g"]),
        tolerance=1e-12,
        because="the sum of the solver's impulses over a step; at 90° an absolute 1e-15 N",
    )


def _along(p: Values, t: Array) -> Array:
    """Return how far the block is from the foot of the ramp [m]."""
    return START - newton.incline_acceleration(radians(p["angle"]), p["g"]) * t**2 / 2


def _acceleration(p: Values, _: Array) -> float:
    return newton.incline_acceleration(radians(p["angle"]), p["g"])


def _x(above: float) -> Expected:
    """Return the closed form of a block's place across, for half its height [m]."""
    return lambda p, t: newton.incline_point(_along(p, t), above, radians(p["angle"]))
