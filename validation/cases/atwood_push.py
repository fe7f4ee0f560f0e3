"""The Atwood machine with an initial velocity: forces do not know how fast anything moves."""

from collections.abc import Iterator
from functools import partial
from math import pi

from sandbox.model.expressions import Values
from sandbox.model.level import ApexEvent
from validation.case import Case, Choices
from validation.formulas import kinematics, newton

LEVEL = "newton/atwood-with-a-push"
PARAMETERS: Choices = (
    {},
    {"m1": 10.0, "m2": 0.2, "v0": 2.0, "g": 25.0},
    {"m1": 0.2, "m2": 10.0, "v0": -2.0},
    {"m1": 10.0, "m2": 10.0, "v0": -2.0, "g": 1.0},
)
RIGHT_UP = pi / 2
APEX = ApexEvent(event="apex", body="left")


def cases() -> Iterator[Case]:
    """Yield the cases of the Atwood machine with an initial velocity."""
    for parameters in PARAMETERS:
        balanced = parameters.get("m1", 1.5) == parameters.get("m2", 1.0)
        case = partial(Case, level=LEVEL, parameters=parameters)
        yield case(
            name="Atwood with a push: way at every step",
            quantity="left.position.y",
            expected=lambda p, t: kinematics.uniform_position(p["v0"], _acceleration(p), t),
            tolerance=1e-13,
            because="the string is straight: one Newton step solves it, to rounding",
            naive_misses=None if balanced else 1e-3,
        )
        yield case(
            name="Atwood with a push: tension at every step",
            quantity="string.tension",
            expected=lambda p, _: newton.atwood_tension(p["m1"], p["m2"], p["g"]),
            tolerance=1e-13,
            because="known to the rounding of the velocities: 4e-16 m/s over dt is 3e-14 m/s²",
        )
        if parameters.get("v0", 2.0) > 0:
            yield Case(
                name="Atwood with a push: turning point",
                level=LEVEL,
                parameters=parameters,
                quantity="left.position.y",
                at=APEX,
                # as high as a body thrown up under the machine's own, weaker gravity
                expected=lambda p, _: kinematics.projectile_apex(
                    p["v0"], RIGHT_UP, -_acceleration(p)
                ),
                tolerance=1e-13,
                because="the cubic between steps is exact for a parabola",
                naive_misses=1e-3,
            )


def _acceleration(p: Values) -> float:
    return newton.atwood_acceleration(p["m1"], p["m2"], p["g"])
