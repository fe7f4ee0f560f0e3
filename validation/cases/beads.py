"""Beads on wires: slides of every shape, the quickest one, the cycloid, and a hoop that turns."""

from collections.abc import Iterator
from functools import partial

import numpy as np

from sandbox.model.expressions import Array, Values
from sandbox.model.level import CrossingEvent, Instant, LandingEvent
from validation.case import SECOND_ORDER, Case, Choices, Parameters, ends
from validation.formulas import energy, lagrange

FALLS: Choices = ({}, {"height": 3.0, "g": 5.0}, {"g": 12.0, "mass": 10.0})
CYCLOIDS: Choices = (
    {},
    {"angle": 20.0},
    {"R": 0.2, "g": 25.0, "angle": 165.0},
    {"R": 1.0, "g": 1.0},
)
QUICKEST: Choices = ({}, {"R": 0.4, "g": 25.0}, {"R": 2.0, "g": 1.0})
FAST: Choices = (
    {},
    {"w": 10.0, "R": 2.0, "kick": 3.0},
    {"w": 5.0, "R": 0.7, "g": 9.81},
    {"g": 1.0},
)
SLOW: Choices = ({"w": 2.0}, {"w": 1.0, "R": 0.5, "g": 25.0, "kick": 1.0})

ROUND = 0.85
"""How sharp the corners of the zigzag are: 1 for a real one."""

BOTTOM = CrossingEvent(event="crossing", quantity="ball.position.x", direction="up")
LANDING = LandingEvent(event="landing", body="ball")
BACK = CrossingEvent(event="crossing", quantity="bead.velocity.x", direction="up")


def cases() -> Iterator[Case]:
    """Yield the cases of the slides, the cycloid and the hoop."""
    for slide, at in (("curved-ramp", BOTTOM), ("zigzag", LANDING), ("helix", LANDING)):
        for parameters in (*FALLS, *ends(f"energy/{slide}")):
            yield from _slide(slide, at, parameters)
    yield from _side_by_side()
    yield from _quickest()
    yield from _cycloids()
    yield from _hoops()


def _slide(slide: str, at: Instant, parameters: Parameters) -> Iterator[Case]:
    bowl = slide == "curved-ramp"
    case = partial(Case, level=f"energy/{slide}", parameters=parameters)
    turn = f"{'second' if bowl else 'fourth'} order in how far the wire turns in a step"
    yield case(
        name="slide of any shape: speed at the bottom",
        quantity="ball.speed",
        expected=lambda p, _: energy.landing_speed(0, p["g"], p["height"]),
        at=at,
        tolerance=1e-5 if bowl else 1e-10,
        because=turn,
        # in the bowl pymunk's velocities, half a step late, are level when they are read
        naive_misses=None if bowl else 1e-4,
    )
    yield case(
        name="slide of any shape: time to the bottom",
        quantity="t",
        expected=partial(_descent, slide),
        at=at,
        tolerance=5e-6,
        because=turn,
        naive_misses=1e-4,
    )
    yield case(
        name="slide of any shape: energy at every step",
        quantity="ball.energy",
        expected=lambda p, _: p["mass"] * p["g"] * p["height"],
        tolerance=1e-5,
        because=turn,
        naive_misses=2e-4,
    )
    if bowl:
        yield case(
            name="curved ramp: force of the ramp at the bottom",
            quantity="ramp.tension",
            # a parabola y = h (x / w)² bends with 1 / r = 2 h / w² where it is lowest
            expected=lambda p, _: energy.trough_force(
                p["mass"], p["height"], p["width"] ** 2 / (2 * p["height"]), p["g"]
            ),
            at=at,
            tolerance=2e-5,
            because=turn,
        )


def _side_by_side() -> Iterator[Case]:
    for parameters in (*FALLS, *ends("energy/four-slides")):
        for ball in ("straight", "curved", "zigzag", "wave"):
            bowl = CrossingEvent(event="crossing", quantity="curved.position.x", direction="up")
            yield Case(
                name=f"four slides: speed at the bottom, {ball}",
                level="energy/four-slides",
                parameters=parameters,
                quantity=f"{ball}.speed",
                expected=lambda p, _: energy.landing_speed(0, p["g"], p["height"]),
                at=bowl if ball == "curved" else LandingEvent(event="landing", body=ball),
                tolerance=2e-9,
                because="fourth order, as each slide by itself",
                naive_misses=None if ball == "curved" else 1e-4,
            )


def _quickest() -> Iterator[Case]:
    for parameters in QUICKEST:
        for bead in ("straight", "cycloid"):
            exact = bead == "straight"
            yield Case(
                name=f"the quickest slide: time on the {bead} wire",
                level="energy/brachistochrone",
                parameters=parameters,
                quantity="t",
                expected=partial(_race, bead),
                at=CrossingEvent(event="crossing", quantity=f"{bead}.position.x", direction="up"),
                tolerance=1e-10 if exact else 5e-5,
                order=None if exact else SECOND_ORDER,
                because="straight: exact" if exact else "second order, from the cusp on",
                naive_misses=1e-4,
            )
        yield Case(
            name="the quickest slide: height on the cycloid at every step",
            level="energy/brachistochrone",
            parameters=parameters,
            quantity="cycloid.position.y",
            expected=lambda p, t: lagrange.cycloid_height(t, p["R"], p["g"], np.pi),
            tolerance=5e-5,
            order=SECOND_ORDER,
            because="second order; the wire turns by √(g/R) dt / 2 in every step",
            naive_misses=2e-4,
        )


def _race(bead: str, p: Values, _: Array) -> float:
    """Return the time to the bottom [s]; of the straight wire, by its slope of 2 over π."""
    if bead == "cycloid":
        return lagrange.cycloid_time(p["R"], p["g"])
    return energy.time_of_descent(
        lambda s: np.pi * p["R"] * s, lambda s: 2 * p["R"] * (1 - s), p["g"]
    )


def _descent(level: str, p: Values, _: Array) -> float:
    h = p["height"]
    if level == "curved-ramp":
        return energy.time_of_descent(
            lambda s: p["width"] * (s - 1), lambda s: h * (1 - s) ** 2, p["g"]
        )
    if level == "zigzag":
        return energy.time_of_descent(
            lambda s: h / 4 * np.arcsin(ROUND * np.sin(3 * np.pi * s)) / np.arcsin(ROUND),
            lambda s: h * (1 - s),
            p["g"],
        )
    return energy.time_of_descent(
        lambda s: h / 5 * np.sin(4 * np.pi * s), lambda s: h * (1 - s), p["g"]
    )


def _cycloids() -> Iterator[Case]:
    for parameters in CYCLOIDS:
        for bead, share in (("high", 1.0), ("middle", 0.6), ("low", 0.3)):
            yield Case(
                name=f"bead on a cycloid: height of the {bead} one at every step",
                level="lagrange/bead-on-a-wire",
                parameters=parameters,
                quantity=f"{bead}.position.y",
                expected=partial(_cycloid_height, share),
                tolerance=1e-4,
                because="second order: (ω dt)² / 24 a swing, some tenfold near the cusps",
                order=SECOND_ORDER,
                naive_misses=2e-4,
            )


def _cycloid_height(share: float, p: Values, t: Array) -> Array:
    start = share * np.radians(p["angle"])
    return lagrange.cycloid_height(t, p["R"], p["g"], float(start))


def _hoops() -> Iterator[Case]:
    for parameters in (*FAST, *SLOW):
        yield Case(
            name="bead on a rotating hoop: half a swing",
            level="lagrange/rotating-hoop",
            parameters=parameters,
            quantity="t",
            expected=lambda p, _: (
                np.pi / lagrange.hoop_frequency(p["R"], p["w"], p["g"], np.radians(p["kick"]))
            ),
            at=BACK,
            tolerance=1e-3,
            because="the formula is that of small swings: off by the square of the kick",
            naive_misses=None,
        )
