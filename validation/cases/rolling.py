"""Rolling: down an incline, in a race of shapes, and out of a slide."""

from collections.abc import Iterator
from functools import partial
from math import radians

from sandbox.model.expressions import Expression
from sandbox.model.level import CrossingEvent
from validation.case import Case, Choices, Parameters
from validation.formulas import newton, rotation

INCLINES: Choices = (
    {},
    {"angle": 60.0, "mu": 0.2, "r": 0.4, "g": 25.0},  # both slip
    {"angle": 60.0, "mu": 0.7},  # only the hoop slips
    {"angle": 5.0, "mu": 0.2, "r": 0.1, "mass": 100.0, "g": 1.0},
    {"mu": 1.0, "mass": 0.1},
)
RACES: Choices = (
    {},
    {"angle": 40.0, "r": 0.1, "g": 25.0, "mass": 0.1},
    {"angle": 5.0, "r": 0.4, "g": 1.0, "mass": 100.0},
)
SLIDES: Choices = (
    {},
    {"speed": 3.0, "mu": 0.8, "g": 12.0, "r": 0.5, "mass": 100.0},
    {"speed": 10.0, "mu": 0.1, "g": 5.0, "r": 0.2, "mass": 0.1},
)
FACTORS = {"disc": rotation.DISC, "hoop": rotation.HOOP}
RACERS = {
    "block": rotation.SLIDING,
    "sphere": rotation.SPHERE,
    "disc": rotation.DISC,
    "hollow_sphere": rotation.HOLLOW_SPHERE,
    "hoop": rotation.HOOP,
}
WAY = 6.0  # m, from the start of the race to its end
LEVER = "a contact is known to 1e-15 m, so its speed to 1e-15 ω: over a step, 5e-12 of friction"


def cases() -> Iterator[Case]:
    """Yield the cases of rolling."""
    for parameters in INCLINES:
        for body, factor in FACTORS.items():
            yield from _incline(body, factor, parameters)
    for parameters in RACES:
        for body, factor in RACERS.items():
            yield _race(body, factor, parameters)
    for parameters in SLIDES:
        for body, factor in FACTORS.items():
            yield from _slide(body, factor, parameters)
        yield Case(
            name="slide to roll: angular momentum about the ground, at every step",
            level="rotation/slide-to-roll",
            parameters=parameters,
            quantity="system.angular_momentum",
            expected=lambda p, _: -2 * p["mass"] * p["r"] * p["speed"],
            tolerance=1e-10,
            because="70 m away the contact is known to 1e-14 m, and so is the lever of the weight",
        )


def _incline(body: str, factor: float, parameters: Parameters) -> Iterator[Case]:
    case = partial(Case, level="rotation/rolling", parameters=parameters)
    yield case(
        name=f"rolling: acceleration of the {body}",
        quantity=f"{body}.acceleration",
        expected=lambda p, _: rotation.rolling_acceleration(
            factor, radians(p["angle"]), p["g"], p["mu"]
        ),
        tolerance=3e-11,
        because=LEVER,
    )
    yield case(
        name=f"rolling: speed of the {body}",
        quantity=f"{body}.speed",
        expected=lambda p, t: (
            rotation.rolling_acceleration(factor, radians(p["angle"]), p["g"], p["mu"]) * t
        ),
        tolerance=3e-13,
        because="a sum of equal kicks, some hundred roundings",
    )
    yield case(
        name=f"rolling: turning of the {body}",
        quantity=f"{body}.angular_velocity",
        expected=lambda p, t: (
            rotation.rolling_spin(factor, p["r"], radians(p["angle"]), p["g"], p["mu"]) * t
        ),
        tolerance=3e-13,
        because="where it rolls, the solver leaves the point of contact at rest, to rounding",
    )
    yield case(
        name=f"rolling: way of the {body}",
        quantity=f"{body}.position.x",
        expected=lambda p, t: newton.incline_point(
            6.0
            - rotation.rolling_acceleration(factor, radians(p["angle"]), p["g"], p["mu"])
            * t**2
            / 2,
            p["r"],
            radians(p["angle"]),
        ),
        tolerance=1e-13,
        because="constant acceleration, and a contact solved to rounding",
        naive_misses=5e-4,
    )
    yield case(
        name=f"rolling: friction of the {body}",
        quantity=f"{body}.contact.friction",
        expected=lambda p, _: rotation.rolling_friction(
            factor, p["mass"], radians(p["angle"]), p["g"], p["mu"]
        ),
        tolerance=3e-11,
        because=LEVER,
    )


def _race(body: str, factor: float, parameters: Parameters) -> Case:
    return Case(
        name=f"race: time of the {body.replace('_', ' ')}",
        level="rotation/race",
        parameters=parameters,
        quantity="t",
        at=CrossingEvent(event="crossing", quantity=f"{body}.position.x"),
        expected=lambda p, _: rotation.race_time(factor, WAY, radians(p["angle"]), p["g"]),
        tolerance=2e-13,
        because="constant acceleration: samples and the cubic between them are exact",
        naive_misses=3e-4,
    )


def _slide(body: str, factor: float, parameters: Parameters) -> Iterator[Case]:
    level = "rotation/slide-to-roll"
    rolling = Expression(f"{factor}/{1 + factor}*speed/(mu*g) + 0.05")
    start = 2.0 if body == "disc" else 0.0
    case = partial(Case, level=level, parameters=parameters)
    yield case(
        name=f"slide to roll: speed of the {body} in the end",
        quantity=f"{body}.velocity.x",
        at=rolling,
        expected=lambda p, _: rotation.rolling_speed(factor, p["speed"]),
        tolerance=3e-13,
        because="every kick keeps the angular momentum about the ground, the last one to slip too",
    )
    yield case(
        name=f"slide to roll: spin of the {body} in the end",
        quantity=f"{body}.angular_velocity",
        at=rolling,
        expected=lambda p, _: -rotation.rolling_speed(factor, p["speed"]) / p["r"],
        tolerance=3e-13,
        because="the same, and the point of contact is at rest to rounding",
    )
    yield case(
        name=f"slide to roll: way of the {body}",
        quantity=f"{body}.position.x",
        expected=lambda p, t: (
            start + rotation.slide_and_roll_way(factor, p["speed"], p["mu"], p["g"], t)
        ),
        tolerance=1e-12,
        because="constant accelerations, and the end of slipping located within its step: 2e-14",
        naive_misses=7e-5,
    )
