"""Springs: free, damped, and coupled to each other."""

from collections.abc import Iterator
from functools import partial

import numpy as np

from sandbox.model.expressions import Array, Expression, Values
from sandbox.model.level import CrossingEvent
from validation.case import SECOND_ORDER, Case, Expected, Parameters, ends
from validation.formulas import lagrange

CRITICAL = ends("energy/critical-damping", "m") + ends("energy/critical-damping")
SECOND = "second order: a phase of (ω dt)² / 24 a radian, 1e-4 over the run at the most"


def cases() -> Iterator[Case]:
    """Yield the cases of the springs."""
    yield from _alone()
    yield from _modes()
    yield from _coupled_places()


def _coupled_places() -> Iterator[Case]:
    level = "lagrange/coupled-oscillators"
    for parameters in ({}, *ends(level), *ends(level, "b")):
        case = partial(Case, level=level, parameters=parameters, order=SECOND_ORDER)
        for index, body in enumerate(("left", "right")):
            yield case(
                name=f"coupled oscillators: the {body} one",
                quantity=f"{body}.position.x",
                expected=_coupled(index),
                tolerance=5e-5,
                because=SECOND,
                naive_misses=2e-4,
            )


def _modes() -> Iterator[Case]:
    """Yield a quarter of each mode's period, and the beats of the two."""
    for name, b in (("together", 0.3), ("against each other", -0.3)):
        yield Case(
            name=f"coupled oscillators: a quarter period {name}",
            level="lagrange/coupled-oscillators",
            parameters={"a": 0.3, "b": b},
            quantity="t",
            at=CrossingEvent(event="crossing", quantity="left.position.x", value=Expression(-0.5)),
            expected=_quarter(b < 0),
            tolerance=1e-5,
            order=SECOND_ORDER,
            because="second order: (ω dt)² / 24",
        )
    beats: tuple[Parameters, ...] = ({}, {"k": 12.0, "c": 2.0}, {"k": 8.0, "c": 4.0, "a": 0.1})
    for parameters in beats:
        for index, body in enumerate(("left", "right")):
            yield Case(
                name=f"beats: the {body} one",
                level="lagrange/beats",
                parameters=parameters,
                quantity=f"{body}.position.x",
                expected=_beating(index),
                tolerance=1e-4,
                order=SECOND_ORDER,
                because="second order: (ω dt)² / 24 a radian, over thirty radians or more",
                naive_misses=2e-4,
            )


def _quarter(against: bool) -> Expected:
    return lambda p, _: np.pi / 2 / lagrange.mode_frequencies(p["m"], p["k"], p["k"])[against]


def _beating(index: int) -> Expected:
    def expected(p: Values, t: Array) -> Array:
        swing = lagrange.coupled_oscillations(t, 1.0, p["k"], (p["a"], 0.0), p["c"])[index]
        return np.asarray(1.2 * index - 0.6 + swing)

    return expected


def _alone() -> Iterator[Case]:
    levels: tuple[tuple[str, Parameters, float, float, float], ...] = (
        ("energy/spring-oscillator", {}, 0.0, 3e-5, 5e-4),
        ("energy/spring-oscillator", {"m": 0.5, "k": 50.0, "A": 0.5}, 0.0, 1e-4, 1e-3),
        ("energy/spring-oscillator", {"m": 4.0, "k": 5.0, "A": 0.1}, 0.0, 1e-6, 5e-5),
        ("energy/damped-spring", {"c": 3.0}, 3.0, 2e-4, 1e-3),
        ("energy/damped-spring", {"c": 20.0}, 20.0, 2e-4, 4e-4),
        ("energy/damped-spring", {"c": 58.0}, 58.0, 1e-4, 1e-4),
        ("energy/damped-spring", {"c": 1.0, "A": 0.1}, 1.0, 2e-4, 5e-4),
        ("energy/damped-spring", {"c": 60.0, "A": 0.5}, 60.0, 1e-4, 1e-4),
        ("energy/critical-damping", {}, 2 * 20**0.5, 5e-5, 2e-4),
        *(
            ("energy/critical-damping", p, 2 * (p["m"] * p["k"]) ** 0.5, bound, naive)
            for p in CRITICAL
            for bound, naive in [(5e-5, 2e-4) if p["k"] > 5 else (1e-6, 1e-5)]
        ),
    )
    for level, parameters, damping, tolerance, naive in levels:
        yield Case(
            name="spring: place at every step",
            level=level,
            parameters=parameters,
            quantity="block.position.x",
            expected=_damped(damping),
            tolerance=tolerance,
            # at an eighth of the rate a step is too long for the damper, and refused
            order=SECOND_ORDER if damping < 60 else None,
            because=SECOND,
            naive_misses=naive,
        )


def _coupled(index: int) -> Expected:
    def expected(p: Values, t: Array) -> Array:
        swing = lagrange.coupled_oscillations(t, p["m"], p["k"], (p["a"], p["b"]))[index]
        return np.asarray(index - 0.5 + swing)

    return expected


def _damped(damping: float) -> Expected:
    def expected(p: Values, t: Array) -> Array:
        mass, stiffness = p.get("m", 2.0), p.get("k", 50.0)
        return 1 + lagrange.damped_oscillation(t, mass, stiffness, damping, p["A"])

    return expected
