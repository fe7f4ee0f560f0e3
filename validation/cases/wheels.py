"""Strings wound on wheels, welds and motors: where moments of inertia show."""

from collections.abc import Iterator
from functools import partial

from sandbox.model.expressions import Values
from validation.case import SECOND_ORDER, Case, Choices
from validation.formulas import newton, rotation

ATWOODS: Choices = (
    {},
    {"m1": 10.0, "m2": 0.1, "M": 20.0},
    {"m1": 0.1, "m2": 10.0, "M": 0.1, "R": 1.0},
    {"R": 0.3, "g": 1.0},
    {"g": 25.0},
)
YO_YOS: Choices = (
    {},
    {"r": 0.1, "R": 0.5, "g": 25.0},
    {"r": 0.3, "R": 0.3, "mass": 100.0, "g": 2.0},
    {"mass": 0.1},
)
DRUMS: Choices = (
    {},
    {"d": 1.2, "m": 5.0, "weight": 0.5, "g": 2.0},
    {"d": 0.5, "m": 0.5, "weight": 4.0, "g": 12.0},
)
MOTORS: Choices = ({}, {"alpha": 2.0, "m": 10.0, "L": 1.5}, {"alpha": 0.5, "m": 0.1, "L": 0.5})
STRAIGHT = "the strings are straight and the wheel stays: all accelerations are constant"
DIGITS = "the string is known to 1e-15 m; twice differenced that is 1e-11 m/s² of what is measured"
CHORD = "second order: in a step a point goes along a chord, (ω dt)² / 6 shorter than its arc"


def cases() -> Iterator[Case]:
    """Yield the cases of wheels, welds and motors."""
    yield from _atwood()
    yield from _yo_yo()
    yield from _drum()
    yield from _motor()


def _atwood() -> Iterator[Case]:
    level = "newton/atwood-massive-pulley"
    for parameters in ATWOODS:
        yield Case(
            name="massive pulley: displacement at every step",
            level=level,
            parameters=parameters,
            quantity="left.position.y",
            expected=lambda p, t: (
                -0.5
                + newton.massive_pulley_acceleration(p["m1"], p["m2"], p["M"], p["g"]) * t**2 / 2
            ),
            tolerance=1e-13,
            because=STRAIGHT,
            naive_misses=1e-3,
        )
        for i, string in enumerate(("string", "other")):
            yield Case(
                name=f"massive pulley: tension of the {string}",
                level=level,
                parameters=parameters,
                quantity=f"{string}.tension",
                expected=lambda p, _, i=i: newton.massive_pulley_tensions(  # type: ignore[misc]
                    p["m1"], p["m2"], p["M"], p["g"]
                )[i],
                tolerance=1e-10,
                because=DIGITS,
            )


def _yo_yo() -> Iterator[Case]:
    for parameters in YO_YOS:
        case = partial(Case, level="rotation/yo-yo", parameters=parameters)
        yield case(
            name="yo-yo: height at every step",
            quantity="disc.position.y",
            expected=lambda p, t: -rotation.yo_yo_acceleration(p["r"], p["R"], p["g"]) * t**2 / 2,
            tolerance=1e-13,
            because=STRAIGHT,
            naive_misses=1e-3,
        )
        yield case(
            name="yo-yo: tension",
            quantity="string.tension",
            expected=lambda p, _: (
                p["mass"] * (p["g"] - rotation.yo_yo_acceleration(p["r"], p["R"], p["g"]))
            ),
            tolerance=1e-10,
            because=DIGITS,
        )


def _drum() -> Iterator[Case]:
    for parameters in DRUMS:
        yield Case(
            name="drum: height of the weight",
            level="rotation/drum-and-weight",
            parameters=parameters,
            quantity="load.position.y",
            expected=lambda p, t: -1.5 - 0.3 * _drum_acceleration(p) * t**2 / 2,
            tolerance=3e-5,
            order=SECOND_ORDER,
            because=CHORD,
            naive_misses=4e-5,
        )


def _drum_acceleration(p: Values) -> float:
    discs = 2 * rotation.disc_moment(p["m"], 0.2, p["d"])
    moment = rotation.disc_moment(1.0, 0.3) + discs
    return rotation.driven_by_weight(p["weight"], 0.3, moment, p["g"])


def _motor() -> Iterator[Case]:
    for parameters in MOTORS:
        case = partial(Case, level="rotation/motor", parameters=parameters)
        yield case(
            name="motor: torque at every step",
            quantity="motor.torque",
            expected=lambda p, _: (
                p["alpha"]
                * (
                    rotation.rod_moment(1.0, p["L"], p["L"] / 2)
                    + rotation.disc_moment(p["m"], 0.2, p["L"])
                )
            ),
            tolerance=1e-4,
            order=SECOND_ORDER,
            because=CHORD,
            naive_misses=1e-2,
        )
        yield case(
            name="motor: force of the clamp on the load",
            quantity="clamp.tension",
            expected=lambda p, t: (
                p["m"] * abs(rotation.rim_acceleration(p["L"], p["alpha"] * t, p["alpha"]))
            ),
            tolerance=5e-5,
            because=CHORD,
        )
        yield case(
            name="motor: torque of the clamp on the load",
            quantity="clamp.torque",
            expected=lambda p, _: rotation.disc_moment(p["m"], 0.2) * p["alpha"],
            tolerance=1e-7,
            because="a weld turns the load alone: what is left is the rounding of its angle",
        )
        yield case(
            name="motor: angle at every step",
            quantity="load.angle",
            expected=lambda p, t: p["alpha"] * t**2 / 2,
            tolerance=1e-12,
            because="the midpoint rule is exact for a rate that grows steadily",
        )
