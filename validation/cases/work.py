"""Work and kinetic energy: a refrigerator pushed, braking from twice the speed, a ramp."""

from cmath import rect
from collections.abc import Iterator
from functools import partial
from math import pi, radians

from sandbox.model.expressions import Array, Expression, Values
from sandbox.model.level import CrossingEvent, LandingEvent
from validation.case import Case, Choices, Expected, Parameters
from validation.formulas import energy

BRAKING: Choices = (
    {},
    {"speed": 30.0, "mu": 1.0, "g": 15.0, "mass": 500.0},
    {"speed": 65.0, "mu": 0.4, "g": 5.0, "mass": 3000.0},
)
RAMPS: Choices = (
    {},
    {"angle": 75.0, "height": 0.5, "g": 25.0, "mass": 0.1},
    {"angle": 15.0, "height": 5.0, "g": 1.0, "mass": 10.0},
)
PUSHES: Choices = (
    {},
    {"F": 300.0, "phi": 80.0, "mu": 0.06, "m": 60.0},
    {"F": 50.0, "phi": 10.0, "d": 1.0, "mu": 0.03, "m": 150.0},
)
KMH = 1 / 3.6  # m/s
LANDING = LandingEvent(event="landing", body="ball")


def cases() -> Iterator[Case]:
    """Yield the cases of work and kinetic energy."""
    for parameters in PUSHES:
        yield from _pushed(parameters)
    for parameters in BRAKING:
        yield from _braking("slow", 1, parameters)
        yield from _braking("fast", 2, parameters)
    for parameters in RAMPS:
        yield from _ramp(parameters)


def _braking(car: str, times: float, parameters: Parameters) -> Iterator[Case]:
    case = partial(Case, level="energy/braking-distance", parameters=parameters)

    def speed(p: Values) -> float:
        return times * p["speed"] * KMH

    yield case(
        name=f"braking: distance of the {car} car",
        quantity=f"{car}.position.x",
        at=Expression(f"{times}*speed/3.6/(mu*g) + 0.1"),
        # four times that of the slow car
        expected=lambda p, _: (
            times**2
            * energy.work_distance(p["mass"], p["speed"] * KMH, p["mu"] * p["mass"] * p["g"])
        ),
        tolerance=1e-12,
        because="constant acceleration, and the stop located within its step: 2e-14",
        naive_misses=3e-4,
    )
    yield case(
        name=f"braking: energy of the {car} car at half its speed",
        quantity=f"{car}.kinetic_energy",
        at=Expression(f"{times}*speed/3.6/(mu*g)/2"),
        expected=lambda p, _: energy.kinetic_energy((p["mass"], speed(p))) / 4,
        tolerance=1e-12,
        because="a sum of up to 550 equal kicks, squared: 6e-14; pymunk's own is as good",
    )


def _ramp(parameters: Parameters) -> Iterator[Case]:
    case = partial(Case, level="energy/ramp", parameters=parameters)
    yield case(
        name="ramp: speed at the bottom",
        quantity="ball.speed",
        at=LANDING,
        expected=lambda p, _: energy.landing_speed(0.0, p["g"], p["height"]),
        tolerance=1e-13,
        because="constant acceleration: samples and the cubic between them are exact",
        naive_misses=5e-4,
    )
    yield case(
        name="ramp: time to the bottom",
        quantity="t",
        at=LANDING,
        expected=lambda p, _: energy.ramp_time(p["height"], radians(p["angle"]), p["g"]),
        tolerance=1e-13,
        because="constant acceleration: samples and the cubic between them are exact",
        naive_misses=5e-4,
    )
    yield case(
        name="ramp: energy at every step",
        quantity="ball.energy",
        expected=lambda p, _: p["mass"] * p["g"] * p["height"],
        tolerance=3e-13,
        because="heights and speeds exact to rounding; the normal force does no work",
        naive_misses=1e-3,
    )


def _pushed(parameters: Parameters) -> Iterator[Case]:
    for name, share, right in (("straight", 0, 0), ("oblique", 1, 0), ("across", 0, 1)):
        yield Case(
            name=f"refrigerator: energy of the {name} one after its way",
            level="energy/refrigerator",
            parameters=parameters,
            quantity=f"{name}.kinetic_energy",
            at=CrossingEvent(
                event="crossing", quantity=f"{name}.position.x", value=Expression("d")
            ),
            expected=_worked(share, right),
            tolerance=1e-12,
            because="constant acceleration: samples and the cubic between them are exact",
            naive_misses=5e-7 if name != "across" else None,
        )


def _worked(share: float, right: float) -> Expected:
    """Return the energy after a push downwards by a share of φ, or by so many right angles."""

    def expected(p: Values, _: Array) -> float:
        push = rect(p["F"], -share * radians(p["phi"]) - right * pi / 2)
        normal = p["m"] * 9.81 - push.imag
        start = energy.kinetic_energy((p["m"], 2.5))
        return start + energy.work(push - p["mu"] * normal, complex(p["d"]))

    return expected
