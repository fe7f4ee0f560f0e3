"""Projectiles: trajectory at every step; apex, range and time of flight between steps."""

from collections.abc import Iterator
from functools import partial
from math import radians

from sandbox.model.expressions import Expression, Values
from sandbox.model.level import ApexEvent, ContactEvent, LandingEvent
from validation.case import Case, Choices, Parameters
from validation.formulas import energy, kinematics

APEX = ApexEvent(event="apex", body="ball")
LANDING = LandingEvent(event="landing", body="ball")
LOCATED = "the time of the impact is that at which the parabola meets the ground"
HALF = "(speed*sin(angle*deg) + sqrt((speed*sin(angle*deg))**2 + 2*g*height))/g/2"
EXACT = "leapfrog's samples lie on the parabola, and the cubic between them is exact for one"

PARAMETERS: Choices = (
    {},
    {"angle": 30.0},
    {"angle": 60.0},
    {"speed": 12.5},
    {"speed": 30.0, "angle": 90.0, "g": 1.0},
    {"speed": 5.0, "angle": 5.0, "g": 25.0},
)
FROM_HEIGHT: Choices = (
    {},
    {"angle": 40.0, "speed": 20.0, "height": 30.0},
    {"angle": -60.0, "speed": 0.5, "height": 2.0, "g": 25.0},
    {"angle": 80.0, "speed": 20.0, "height": 30.0, "g": 1.0},
)


def cases() -> Iterator[Case]:
    """Yield the cases of projectiles."""
    for parameters in PARAMETERS:
        yield from _level_ground(parameters)
    for parameters in FROM_HEIGHT:
        yield from _from_height(parameters)


def _level_ground(parameters: Parameters) -> Iterator[Case]:
    case = partial(Case, level="kinematics/projectile", parameters=parameters, tolerance=1e-12)
    yield case(
        name="projectile: distance at every step",
        quantity="ball.position.x",
        expected=lambda p, t: kinematics.projectile_distance(p["speed"], radians(p["angle"]), t),
        because="a sum of equal drifts; pymunk's own is as good",
    )
    yield case(
        name="projectile: height at every step",
        quantity="ball.position.y",
        expected=lambda p, t: kinematics.projectile_height(
            p["speed"], radians(p["angle"]), p["g"], t
        ),
        because="leapfrog is exact for constant acceleration",
        naive_misses=1e-3,
    )
    yield case(
        name="projectile: apex",
        quantity="ball.position.y",
        at=APEX,
        expected=lambda p, _: kinematics.projectile_apex(p["speed"], radians(p["angle"]), p["g"]),
        because=EXACT,
        naive_misses=5e-4,
    )
    yield case(
        name="projectile: range",
        quantity="ball.position.x",
        at=LANDING,
        expected=lambda p, _: kinematics.projectile_range(p["speed"], radians(p["angle"]), p["g"]),
        because=EXACT,
        naive_misses=None if parameters.get("angle") == 90 else 2e-4,
    )
    yield case(
        name="projectile: time of flight",
        quantity="t",
        at=LANDING,
        expected=lambda p, _: kinematics.flight_time(p["speed"], radians(p["angle"]), p["g"]),
        because=EXACT,
        naive_misses=2e-4,
    )


def _from_height(parameters: Parameters) -> Iterator[Case]:
    case = partial(Case, level="kinematics/projectile-from-height", parameters=parameters)
    landing = ContactEvent(event="contact", bodies=("ball", "sand"))
    yield case(
        name="projectile from a height: range",
        quantity="ball.position.x",
        at=landing,
        expected=lambda p, _: kinematics.projectile_distance(
            p["speed"], radians(p["angle"]), _flight_time(p)
        ),
        tolerance=1e-12,
        because=LOCATED,
        naive_misses=4e-4,
    )
    yield case(
        name="projectile from a height: time of flight",
        quantity="t",
        at=landing,
        expected=lambda p, _: _flight_time(p),
        tolerance=1e-12,
        because=LOCATED,
        naive_misses=4e-4,
    )
    yield case(
        name="projectile from a height: speed after the first half",
        quantity="ball.speed",
        at=Expression(HALF),
        expected=lambda p, t: energy.landing_speed(
            p["speed"],
            p["g"],
            -float(kinematics.projectile_height(p["speed"], radians(p["angle"]), p["g"], t[0])),
        ),
        tolerance=1e-6,
        because="the speed is no polynomial of time: the cubic between steps is off by O(dt⁴)",
    )


def _flight_time(p: Values) -> float:
    return kinematics.flight_time(p["speed"], radians(p["angle"]), p["g"], p["height"])
