"""The first law: velocity stays without a force, and friction is the force that hides it."""

from collections.abc import Iterator
from math import radians

from sandbox.model.expressions import Expression
from validation.case import Case, Choices, Parameters
from validation.formulas import kinematics, leapfrog, newton

FREE: Choices = ({}, {"speed": 10.0, "angle": 360.0, "mass": 0.1}, {"speed": 0.5, "mass": 1000.0})
SLIDING: Choices = (
    {},
    {"speed": 10.0, "mu": 0.2, "g": 5.0, "mass": 100.0},
    {"speed": 3.02, "mu": 0.8, "g": 12.0, "mass": 0.1},  # stops half-way between two steps
)
STOP = "stopped inside a step, short by at most (μ g dt / 2v)² of its way: see stopping_error"
DEFAULTS = {"speed": 6.0, "mu": 0.3, "g": 9.81}
DT = 1 / 240  # s, the level's step


def cases() -> Iterator[Case]:
    """Yield the cases of the first law."""
    for parameters in FREE:
        yield Case(
            name="first law: velocity at every step",
            level="newton/first-law",
            parameters=parameters,
            quantity="moving.speed",
            expected=lambda p, _: p["speed"],
            tolerance=1e-15,
            because="nothing changes it; what remains is the root of the components' squares",
        )
        yield Case(
            name="first law: way at every step",
            level="newton/first-law",
            parameters=parameters,
            quantity="moving.position.x",
            expected=lambda p, t: (
                kinematics.projectile_distance(p["speed"], radians(p["angle"]), t) - 6.0
            ),
            tolerance=1e-13,
            because="a sum of 360 equal drifts",
        )
        yield Case(
            name="first law: rest at every step",
            level="newton/first-law",
            parameters=parameters,
            quantity="resting.momentum",
            expected=lambda _, __: 0.0,
            tolerance=1e-15,
            because="nothing is added to zero",
        )
    for parameters in SLIDING:
        yield from _sliding(parameters)


def _sliding(parameters: Parameters) -> Iterator[Case]:
    level = "newton/friction-brings-to-rest"
    p = {**DEFAULTS, **parameters}
    bound = leapfrog.stopping_error(p["speed"], p["mu"], p["g"], DT) + 1e-12
    yield Case(
        name="friction brings to rest: way at every step",
        level=level,
        parameters=parameters,
        quantity="puck.position.x",
        expected=lambda p, t: newton.sliding_way(p["speed"], p["mu"], p["g"], t),
        tolerance=bound,
        because=STOP,
        naive_misses=3e-4,
    )
    yield Case(
        name="friction brings to rest: stopping distance",
        level=level,
        parameters=parameters,
        quantity="puck.position.x",
        at=Expression("speed/(mu*g) + 0.3"),
        expected=lambda p, _: newton.stopping_distance(p["speed"], p["mu"], p["g"]),
        tolerance=bound,
        because=STOP,
        naive_misses=3e-4,
    )
    yield Case(
        name="friction brings to rest: speed after half the time",
        level=level,
        parameters=parameters,
        quantity="puck.speed",
        at=Expression("speed/(2*mu*g)"),
        expected=lambda p, _: p["speed"] / 2,
        tolerance=5e-13,
        because="a sum of equal kicks, 1200 of them where it slides longest: 6e-14",
    )
    yield Case(
        name="friction brings to rest: speed afterwards",
        level=level,
        parameters=parameters,
        quantity="puck.speed",
        at=Expression("speed/(mu*g) + 0.1"),
        expected=lambda _, __: 0.0,
        tolerance=1e-15,
        because="friction takes exactly what there is, and gives nothing back",
    )
