"""Bodies that attract each other, and an orbit that turns."""

from collections.abc import Iterator
from functools import partial

import numpy as np

from sandbox.model.expressions import Array, Values
from sandbox.model.level import CrossingEvent
from validation.case import FOURTH_ORDER, SECOND_ORDER, Case, Choices, Expected, Parameters
from validation.formulas import energy

G = 4.0  # m³/(kg s²), in the levels of two and of three bodies
NEAR = 1.5  # m, the perihelion of the orbit that turns

STARS: Choices = ({}, {"m1": 1.0, "m2": 3.0, "d": 4.0}, {"m1": 6.0, "m2": 0.5, "d": 2.0})
EIGHTS: Choices = ({}, {"a": 1.5, "m": 4.0}, {"a": 3.0, "m": 1.0})
TURNING: Choices = (
    {},
    {"mu": 10.0, "e": 0.5, "share": 0.25},
    {"mu": 6.0, "e": 0.2, "share": 0.05},
)


def cases() -> Iterator[Case]:
    """Yield the cases of two bodies, of three, and of one whose ellipse turns."""
    for parameters in STARS:
        yield from _two(parameters)
    for parameters in EIGHTS:
        yield from _eight(parameters)
    for parameters in TURNING:
        yield from _turning(parameters)


def _two(parameters: Parameters) -> Iterator[Case]:
    case = partial(Case, level="energy/two-bodies", parameters=parameters)
    yield case(
        name="two bodies: period",
        quantity="t",
        at=CrossingEvent(event="crossing", quantity="light.position.y", direction="up"),
        expected=lambda p, _: energy.two_body_period(p["m1"], p["m2"], G, p["d"]),
        tolerance=5e-5,
        order=SECOND_ORDER,
        because="second order: a quarter of (ω dt)², 6.5e-6 at the most",
    )
    yield case(
        name="two bodies: momentum",
        quantity="system.momentum",
        expected=lambda _p, _t: 0.0,
        tolerance=1e-12,
        because="every pull has its counterpart: rounding, 1.4e-14",
    )
    yield case(
        name="two bodies: place of the heavy one",
        quantity="heavy.position.y",
        expected=_heavy,
        tolerance=1e-4,
        order=SECOND_ORDER,
        because="second order: (ω dt)² / 3 a radian, 4e-5 in a turn",
        naive_misses=5e-4,
    )


def _heavy(p: Values, t: Array) -> Array:
    turn = 2 * np.pi * t / energy.two_body_period(p["m1"], p["m2"], G, p["d"])
    return np.asarray(-p["m2"] / (p["m1"] + p["m2"]) * p["d"] * np.sin(turn))


def _eight(parameters: Parameters) -> Iterator[Case]:
    for row, body in enumerate(("one", "two", "three")):
        yield Case(
            name=f"figure eight: star {body} at every step",
            level="energy/figure-eight",
            parameters=parameters,
            quantity=f"{body}.position.x",
            expected=_star(row),
            tolerance=1e-4,
            order=FOURTH_ORDER,
            because="fourth order, 1.4e-5 at the most; an eight is stable, and forgives",
            naive_misses=2e-3,
        )


def _star(row: int) -> Expected:
    return lambda p, t: energy.figure_eight(p["m"], G, p["a"], t)[2 * row]


def _turning(parameters: Parameters) -> Iterator[Case]:
    case = partial(Case, level="energy/precession", parameters=parameters)
    yield case(
        name="precession: distance at every step",
        quantity="planet.position",
        expected=lambda p, t: _revolving(p, t)[0],
        tolerance=1e-5,
        order=FOURTH_ORDER,
        because="fourth order: it runs behind, by 4e-7 at the most",
        naive_misses=1e-3,
    )
    yield case(
        name="precession: place at every step",
        quantity="planet.position.y",
        expected=_revolving_height,
        tolerance=1e-5,
        order=FOURTH_ORDER,
        because="as its distance; a hundredth of three turns' advance is 5e-3 rad or more",
        naive_misses=3e-3,
    )


def _revolving(p: Values, t: Array) -> tuple[Array, Array]:
    extra = p["share"] / (1 - p["share"]) * p["mu"] * NEAR * (1 + p["e"])
    return energy.revolving_place(NEAR, p["e"], p["mu"], extra, t)


def _revolving_height(p: Values, t: Array) -> Array:
    """Return how high it is, from where the level starts on: three perihelia before angle 0."""
    r, angle = _revolving(p, t)
    return r * np.sin(angle - 6 * np.pi / np.sqrt(1 - p["share"]))
