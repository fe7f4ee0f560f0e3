"""Throws side by side: several angles, twice the speed, and one component at a time."""

from collections.abc import Callable, Iterator
from functools import partial
from math import pi, radians

from sandbox.model.expressions import Values
from sandbox.model.level import ApexEvent, ContactEvent, LandingEvent
from validation.case import Case, Choices, Parameters
from validation.formulas import kinematics

COMPLEMENTARY: Choices = (
    {},
    {"angle": 44.0, "speed": 30.0, "g": 2.0},
    {"angle": 10.0, "speed": 5.0, "g": 25.0},
)
DOUBLED: Choices = ({}, {"speed": 15.0, "g": 1.0}, {"speed": 2.0, "g": 25.0})
COMPONENTS: Choices = (
    {},
    {"angle": 15.0, "speed": 20.0, "g": 2.0},
    {"angle": 85.0, "speed": 5.0, "g": 25.0},
)
FANS: Choices = ({}, {"speed": 30.0, "g": 2.0}, {"speed": 5.0, "g": 25.0})
UPWARDS: Choices = (
    {},
    {"up": 20.0, "ahead": 12.0, "g": 2.0},
    {"up": 4.0, "ahead": 1.0, "g": 25.0},
)
STARTS = {"low": 1.2, "high": -1.2}  # m

EXACT = "samples on a parabola, and a cubic between them; some hundred roundings, at most 6e-14"


def cases() -> Iterator[Case]:
    """Yield the cases of throws side by side."""
    for parameters in COMPLEMENTARY:
        yield from _range("low", lambda p: radians(p["angle"]), parameters)
        yield from _range("high", lambda p: pi / 2 - radians(p["angle"]), parameters)
    for parameters in DOUBLED:
        yield from _apex("slow", 1, parameters)
        yield from _apex("fast", 2, parameters)
    for parameters in COMPONENTS:
        yield from _components(parameters)
    for parameters in FANS:
        yield from _fan(parameters)
    for parameters in UPWARDS:
        yield from _upwards(parameters)


def _range(ball: str, angle: Callable[[Values], float], parameters: Parameters) -> Iterator[Case]:
    level = "kinematics/complementary-angles"
    landing = ContactEvent(event="contact", bodies=(ball, "sand"))
    case = partial(Case, level=level, parameters=parameters)
    yield case(
        name=f"complementary angles: where the {ball} throw lands",
        quantity=f"{ball}.position.x",
        at=landing,
        # both the range at the angle of the low throw, for that is what the level claims
        expected=lambda p, _: (
            STARTS[ball] + kinematics.projectile_range(p["speed"], radians(p["angle"]), p["g"])
        ),
        tolerance=3e-13,
        because=EXACT,
        naive_misses=5e-4,
    )
    yield case(
        name=f"complementary angles: time of flight of the {ball} throw",
        quantity="t",
        at=landing,
        expected=lambda p, _: kinematics.flight_time(p["speed"], angle(p), p["g"]),
        tolerance=3e-13,
        because=EXACT,
        naive_misses=5e-4,
    )


def _apex(ball: str, times: float, parameters: Parameters) -> Iterator[Case]:
    case = partial(Case, level="kinematics/doubled-speed", parameters=parameters)
    apex = ApexEvent(event="apex", body=ball)
    yield case(
        name=f"doubled speed: height of the {ball} ball",
        quantity=f"{ball}.position.y",
        at=apex,
        expected=lambda p, _: times**2 * kinematics.projectile_apex(p["speed"], pi / 2, p["g"]),
        tolerance=3e-13,
        because=EXACT,
        naive_misses=2e-4,
    )
    yield case(
        name=f"doubled speed: how long the {ball} ball rises",
        quantity="t",
        at=apex,
        expected=lambda p, _: times * kinematics.rise_time(p["speed"], p["g"]),
        tolerance=3e-13,
        because="velocities are a sum of equal kicks; pymunk's own are as good",
    )


def _components(parameters: Parameters) -> Iterator[Case]:
    level = "kinematics/components"
    for body in ("ball", "horizontal"):
        case = partial(Case, level=level, parameters=parameters)
        yield case(
            name=f"components: {body}, across",
            quantity=f"{body}.position.x",
            expected=lambda p, t: kinematics.projectile_distance(
                p["speed"], radians(p["angle"]), t
            ),
            tolerance=1e-13,
            because="a sum of equal drifts; pymunk's own is as good",
        )
    for body in ("ball", "vertical"):
        yield case(
            name=f"components: {body}, up",
            quantity=f"{body}.position.y",
            expected=lambda p, t: kinematics.projectile_height(
                p["speed"], radians(p["angle"]), p["g"], t
            ),
            tolerance=3e-13,
            because="leapfrog is exact for constant acceleration",
            naive_misses=1e-3,
        )
    yield Case(
        name="components: speed of the ball",
        level=level,
        parameters=parameters,
        quantity="ball.speed",
        expected=lambda p, t: kinematics.projectile_speed(
            p["speed"], radians(p["angle"]), p["g"], t
        ),
        tolerance=1e-13,
        because="Pythagoras over two sums of equal kicks; pymunk's own is as good",
    )


def _fan(parameters: Parameters) -> Iterator[Case]:
    for degrees in (15, 30, 45, 60, 75):
        yield Case(
            name=f"best angle: range at {degrees}°",
            level="kinematics/best-angle",
            parameters=parameters,
            quantity=f"a{degrees}.position.x",
            at=ContactEvent(event="contact", bodies=(f"a{degrees}", "sand")),
            expected=lambda p, _, degrees=degrees: (  # type: ignore[misc]
                (45 - degrees) / 600 * p["speed"] ** 2 / p["g"]
                + kinematics.projectile_range(p["speed"], radians(degrees), p["g"])
            ),
            tolerance=3e-13,
            because="the time of the impact is that at which the parabola meets the ground",
            naive_misses=5e-4,
        )


def _upwards(parameters: Parameters) -> Iterator[Case]:
    for ball in ("straight", "slow", "fast"):
        yield Case(
            name=f"time of flight: {ball}",
            level="kinematics/time-of-flight",
            parameters=parameters,
            quantity="t",
            at=LandingEvent(event="landing", body=ball),
            expected=lambda p, _: kinematics.flight_time(p["up"], pi / 2, p["g"]),
            tolerance=3e-13,
            because=EXACT,
            naive_misses=5e-4,
        )
