"""Bodies in one dimension, in the three wells of the chapter's section 5."""

from collections.abc import Iterator
from functools import partial

from sandbox.model.level import CrossingEvent
from validation.case import FOURTH_ORDER, SECOND_ORDER, Case, Choices, Parameters
from validation.formulas import energy, kinematics, lagrange

SLOPES: Choices = ({}, {"v": 8.0, "g": 4.0, "m": 2.0}, {"v": 3.0, "g": 25.0, "m": 0.2})
BOWLS: Choices = ({}, {"m": 0.5, "k": 20.0}, {"m": 2.0, "k": 5.0, "v": 1.0})
FUNNELS: Choices = ({}, {"share": 0.5, "mu": 10.0, "m": 0.5}, {"share": 0.88, "mu": 5.0, "m": 2.0})


def cases() -> Iterator[Case]:
    """Yield the cases of gravity's slope, of the spring's bowl and of the 1/r funnel."""
    for parameters in SLOPES:
        yield from _slope(parameters)
    for parameters in BOWLS:
        yield from _bowl(parameters)
    for parameters in FUNNELS:
        yield from _funnel(parameters)


def _turn(body: str) -> CrossingEvent:
    return CrossingEvent(event="crossing", quantity=f"{body}.velocity.x", direction="down")


def _slope(parameters: Parameters) -> Iterator[Case]:
    case = partial(Case, level="energy/well-gravity", parameters=parameters, tolerance=1e-12)
    yield case(
        name="well of gravity: turning point",
        quantity="ball.position.x",
        at=_turn("ball"),
        expected=lambda p, _: energy.work_distance(p["m"], p["v"], p["m"] * p["g"]),
        because="leapfrog's samples lie on the parabola",
        naive_misses=5e-4,
    )
    yield case(
        name="well of gravity: place at every step",
        quantity="ball.position.x",
        expected=lambda p, t: kinematics.uniform_position(p["v"], -p["g"], t),
        because="leapfrog is exact for constant acceleration",
        naive_misses=1e-3,
    )


def _bowl(parameters: Parameters) -> Iterator[Case]:
    case = partial(Case, level="energy/well-spring", parameters=parameters, tolerance=1e-4)
    yield case(
        name="well of a spring: half a period, however hard the push",
        quantity="t",
        at=CrossingEvent(event="crossing", quantity="block.position.x", direction="down"),
        expected=lambda p, _: lagrange.oscillator_period(p["m"], p["k"]) / 2,
        order=SECOND_ORDER,
        because="second order: (ω dt)² / 24, 3e-6 at the most",
    )
    yield case(
        name="well of a spring: turning point",
        quantity="block.position.x",
        at=_turn("block"),
        expected=lambda p, _: lagrange.oscillator_amplitude(p["m"], p["k"], p["v"]),
        order=SECOND_ORDER,
        because="second order: (ω dt)² / 8, 1e-5 at the most; pymunk starts luckily here",
    )
    yield case(
        name="well of a spring: energy at every step",
        quantity="block.energy",
        expected=lambda p, _: energy.kinetic_energy((p["m"], p["v"])),
        order=SECOND_ORDER,
        because="second order: (ω dt)² / 4 of it, 2e-5 at the most",
        naive_misses=5e-4,
    )


def _funnel(parameters: Parameters) -> Iterator[Case]:
    case = partial(Case, level="energy/well-one-over-r", parameters=parameters, tolerance=1e-6)
    yield case(
        name="well of 1/r: turning point",
        quantity="probe.position.x",
        at=_turn("probe"),
        expected=lambda p, _: energy.turning_distance(1.5, p["share"]),
        order=FOURTH_ORDER,
        because="fourth order: what is lost at the start, 2e-8 at the most",
        naive_misses=2e-4,
    )
    yield case(
        name="well of 1/r: time until it turns",
        quantity="t",
        at=_turn("probe"),
        expected=lambda p, _: energy.turning_time(1.5, p["share"], p["mu"]),
        order=FOURTH_ORDER,
        because="fourth order, 3e-8 at the most",
        naive_misses=2e-4,
    )
    yield case(
        name="well of 1/r: energy at every step",
        quantity="probe.energy",
        expected=lambda p, _: -p["m"] * p["mu"] / energy.turning_distance(1.5, p["share"]),
        order=FOURTH_ORDER,
        because="fourth order, 2e-8 at the most",
        naive_misses=2e-4,
    )
