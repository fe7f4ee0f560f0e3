"""Kepler's three laws, and the speed with which a body never comes back."""

from collections.abc import Iterator
from functools import partial

from sandbox.model.level import ApexEvent, CrossingEvent
from validation.case import SECOND_ORDER, Case, Choices, Parameters
from validation.formulas import energy, leapfrog

ELLIPSES: Choices = (
    {},
    {"near": 1.5, "e": 0.6, "mu": 12.0},
    {"near": 2.5, "e": 0.0, "mu": 6.0},
)
PERIODS: Choices = (
    {},
    {"r": 1.5, "times": 1.5, "e": 0.3, "mu": 10.0},
    {"r": 2.0, "times": 4.0, "e": 0.0, "mu": 6.0},
)
ESCAPES: Choices = (
    {},
    {"r": 1.5, "share": 0.85, "mu": 10.0},
    {"r": 2.5, "share": 0.5, "mu": 5.0},
)
DEFAULTS = {"near": 1.5, "e": 0.5, "mu": 8.0}
ESCAPE_DEFAULTS = {"r": 1.5, "share": 0.8, "mu": 8.0}
DT = 1 / 480  # s, the step of the ellipse and of the escape
ROUNDING = 1e-8
"""Beside the errors of second order there are those of the fourth: (ω dt)⁴ is 6e-10 at the most."""

FAR_END = CrossingEvent(event="crossing", quantity="planet.position.y", direction="down")


def cases() -> Iterator[Case]:
    """Yield the cases of the three laws, then those of the escape velocity."""
    for parameters in ELLIPSES:
        yield from _ellipse(parameters)
    for parameters in PERIODS:
        yield from _period("inner", parameters)
        yield from _period("outer", parameters)
    for parameters in ESCAPES:
        yield from _escape(parameters)


def _ellipse(parameters: Parameters) -> Iterator[Case]:
    case = partial(Case, level="energy/kepler-ellipse", parameters=parameters)
    p = {**DEFAULTS, **parameters}
    bound = 1.05 * leapfrog.far_end_error(p["near"], p["e"], p["mu"], DT) + ROUNDING
    yield case(
        name="Kepler's ellipse: place at every step",
        quantity="planet.position.x",
        expected=lambda p, t: energy.kepler_place(p["near"], p["e"], p["mu"], t)[0],
        tolerance=1e-4,
        order=SECOND_ORDER,
        because="second order: the angle runs behind a little more each radian, 5.5e-5 in a turn",
        naive_misses=1e-3,
    )
    yield case(
        name="Kepler's ellipse: far end",
        quantity="planet.position.x",
        at=FAR_END,
        expected=lambda p, _: -p["near"] * (1 + p["e"]) / (1 - p["e"]),
        tolerance=bound,
        order=SECOND_ORDER,
        because="the energy that leapfrog keeps is a little off: far_end_error, at most 9.4e-6",
    )
    yield case(
        name="Kepler's ellipse: speed at the far end",
        quantity="planet.speed",
        at=FAR_END,
        expected=lambda p, _: energy.apsis_speed(
            p["near"] * (1 + p["e"]) / (1 - p["e"]), p["near"], p["mu"]
        ),
        tolerance=bound,
        order=SECOND_ORDER,
        because="the energy that leapfrog keeps is a little off: far_end_error, at most 9.4e-6",
    )
    yield case(
        name="Kepler's ellipse: angular momentum at every step",
        quantity="system.angular_momentum",
        expected=lambda p, _: (
            p["near"]
            * energy.apsis_speed(p["near"], p["near"] * (1 + p["e"]) / (1 - p["e"]), p["mu"])
        ),
        tolerance=1e-13,
        because="a kick towards the sun has no moment about it, in pymunk's own scheme neither",
    )


def _period(planet: str, parameters: Parameters) -> Iterator[Case]:
    case = partial(Case, level="energy/kepler-third-law", parameters=parameters)
    inner = planet == "inner"
    yield case(
        name=f"Kepler's third law: period of the {planet} planet",
        quantity="t",
        at=CrossingEvent(event="crossing", quantity=f"{planet}.position.y", direction="up"),
        expected=lambda p, _: energy.kepler_period(
            p["r"] * (1.0 if inner else p["times"]), p["mu"]
        ),
        tolerance=1e-4,
        order=SECOND_ORDER,
        because="second order in ω dt, measured a third of it on a circle: 1.1e-5",
    )
    yield case(
        name=f"Kepler's third law: energy of the {planet} planet",
        quantity=f"{planet}.energy",
        expected=lambda p, _: energy.kepler_energy(
            p["r"] * (1.0 if inner else p["times"]), p["mu"]
        ),
        tolerance=1e-8 if inner else 1e-4,
        because=(
            "fourth order in ω dt on a circle, 2.7e-10"
            if inner
            else "second order in ω dt, and only while the distance changes: 5.3e-6"
        ),
        naive_misses=1e-7 if inner else None,
    )


def _escape(parameters: Parameters) -> Iterator[Case]:
    case = partial(Case, level="energy/escape-velocity", parameters=parameters)
    p = {**ESCAPE_DEFAULTS, **parameters}
    bound = 1.05 * leapfrog.turning_error(p["r"], p["share"], p["mu"], DT) + ROUNDING
    yield case(
        name="escape velocity: distance at every step",
        quantity="escapes.position.x",
        expected=lambda p, t: energy.escape_distance(p["r"], p["mu"], t),
        tolerance=5e-5,
        order=SECOND_ORDER,
        because="it loses dt² μ² 9 / (24 r⁴) of energy at the start, 3.2e-5 J: 6.3e-6 of the way",
        naive_misses=2e-4,
    )
    yield case(
        name="escape velocity: speed at every step",
        quantity="escapes.speed",
        expected=lambda p, t: energy.escape_speed(
            p["mu"], energy.escape_distance(p["r"], p["mu"], t)
        ),
        tolerance=5e-5,
        order=SECOND_ORDER,
        because="it loses dt² μ² 9 / (24 r⁴) of energy at the start, 3.2e-5 J: 6.3e-6 of the way",
        naive_misses=2e-4,
    )
    turning = ApexEvent(event="apex", body="returns")
    yield case(
        name="escape velocity: where the slow one turns",
        quantity="returns.position.y",
        at=turning,
        expected=lambda p, _: energy.turning_distance(p["r"], p["share"]),
        tolerance=bound,
        order=SECOND_ORDER,
        because="it loses a little energy at the start: turning_error, at most 1.3e-5, as measured",
        naive_misses=2e-4,
    )
    yield case(
        name="escape velocity: when the slow one turns",
        quantity="t",
        at=turning,
        expected=lambda p, _: energy.turning_time(p["r"], p["share"], p["mu"]),
        tolerance=2.5 * bound,
        order=SECOND_ORDER,
        because="the period goes as the distance to the power 3/2, and the start is late: 2.1e-5",
        naive_misses=2e-4,
    )
