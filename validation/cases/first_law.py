"""The first law: velocity stays without a force, and friction is the force that hides it."""

from collections.abc import Iterator
from functools import partial
from math import radians

from sandbox.model.expressions import Expression
from validation.case import Case, Choices, Parameters
from validation.formulas import kinematics, newton

FREE: Choices = (
    {},
    {"speed": 10.0, "angle": 360.0, "mass": 0.1},
    {"speed": 0.5, "angle": 0.0, "mass": 1000.0},
)
SLIDING: Choices = (
    {},
    {"speed": 10.0, "mu": 0.2, "g": 5.0, "mass": 100.0},
    {"speed": 3.12, "mu": 0.8, "g": 12.0, "mass": 0.1},  # stops half-way between two steps
    {"speed": 3.0},
)
STOP = "constant acceleration, and the stop located within its step: 2e-14"


def cases() -> Iterator[Case]:
    """Yield the cases of the first law."""
    for parameters in FREE:
        case = partial(Case, level="newton/first-law", parameters=parameters)
        yield case(
            name="first law: velocity at every step",
            quantity="moving.speed",
            expected=lambda p, _: p["speed"],
            tolerance=1e-15,
            because="nothing changes it; what remains is the root of the components' squares",
        )
        yield case(
            name="first law: way at every step",
            quantity="moving.position.x",
            expected=lambda p, t: (
                kinematics.projectile_distance(p["speed"], radians(p["angle"]), t) - 6.0
            ),
            tolerance=1e-13,
            because="a sum of 360 equal drifts",
        )
        yield case(
            name="first law: rest at every step",
            quantity="resting.momentum",
            expected=lambda _, __: 0.0,
            tolerance=1e-15,
            because="nothing is added to zero",
        )
    for parameters in SLIDING:
        yield from _sliding(parameters)


def _sliding(parameters: Parameters) -> Iterator[Case]:
    case = partial(Case, level="newton/friction-brings-to-rest", parameters=parameters)
    yield case(
        name="friction brings to rest: way at every step",
        quantity="puck.position.x",
        expected=lambda p, t: newton.sliding_way(p["speed"], p["mu"], p["g"], t),
        tolerance=1e-12,
        because=STOP,
        naive_misses=3e-4,
    )
    yield case(
        name="friction brings to rest: stopping distance",
        quantity="puck.position.x",
        at=Expression("speed/(mu*g) + 0.3"),
        expected=lambda p, _: newton.stopping_distance(p["speed"], p["mu"], p["g"]),
        tolerance=1e-12,
        because=STOP,
        naive_misses=3e-4,
    )
    yield case(
        name="friction brings to rest: speed after half the time",
        quantity="puck.speed",
        at=Expression("speed/(2*mu*g)"),
        expected=lambda p, _: p["speed"] / 2,
        tolerance=5e-13,
        because="a sum of equal kicks, 300 of them where it slides longest: 2e-14",
    )
    yield case(
        name="friction brings to rest: speed afterwards",
        quantity="puck.speed",
        at=Expression("speed/(mu*g) + 0.1"),
        expected=lambda _, __: 0.0,
        tolerance=1e-15,
        because="friction takes exactly what there is, and gives nothing back",
    )
