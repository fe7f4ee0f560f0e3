"""Driven springs: the steady state, the start from rest, and the resonance curve."""

from collections.abc import Callable, Iterator
from math import sqrt

import numpy as np

from sandbox.model.expressions import Array, Expression, Values
from validation.case import SECOND_ORDER, Case, Choices, Expected
from validation.formulas import lagrange

DRIVES: Choices = (
    {},
    {"ratio": 0.2, "k": 20.0, "c": 0.8},
    {"ratio": 1.0, "k": 5.0, "c": 0.8},
    {"ratio": 2.0, "k": 20.0, "c": 3.0, "F": 0.5},
)
SPRINGS: Choices = ({}, {"k": 12.0, "c": 0.8, "F": 1.0}, {"k": 6.0, "c": 2.0, "F": 3.0})
RATIOS = {
    "slowest": 0.2, "slow": 0.4, "low": 0.6, "below": 0.8, "tuned": 1.0,
    "above": 1.2, "high": 1.4, "fast": 1.7, "fastest": 2.0,
}  # fmt: skip
DEFAULTS = {"ratio": 0.8, "k": 10.0}
ROW_DEFAULTS = {"k": 9.0}
MASS = 1.0  # kg
DT, ROW_DT = 1 / 480, 1 / 400  # s
SECOND = "second order: (w dt)² / 3 of the amplitude at the most, from slow drives to fast ones"

Swing = Callable[[Array, float, float, float, float, float], Array]


def cases() -> Iterator[Case]:
    """Yield the cases of one driven spring, then those of the row of them."""
    swings: tuple[tuple[str, Swing], ...] = (
        ("steady", lagrange.driven_oscillation),
        ("starting", lagrange.started_oscillation),
    )
    for parameters in DRIVES:
        p = {**DEFAULTS, **parameters}
        for body, swing in swings:
            fastest = p["ratio"] if body == "steady" else max(p["ratio"], 1.0)
            yield Case(
                name=f"driven spring: place of the {body} one at every step",
                level="energy/driven-spring",
                parameters=parameters,
                quantity=f"{body}.position.x",
                expected=_driven(swing),
                tolerance=_bound(fastest, p["k"], DT),
                because=SECOND,
                order=SECOND_ORDER,
                naive_misses=1e-4 + _bound(fastest, p["k"], DT),
            )
    for parameters in SPRINGS:
        stiffness = {**ROW_DEFAULTS, **parameters}["k"]
        for body, ratio in RATIOS.items():
            yield Case(
                name=f"resonance: place of the {body} one at every step",
                level="energy/resonance",
                parameters=parameters,
                quantity=f"{body}.position.y",
                expected=_in_row(ratio),
                tolerance=_bound(ratio, stiffness, ROW_DT),
                because=SECOND,
                order=SECOND_ORDER,
                naive_misses=1e-4 + _bound(ratio, stiffness, ROW_DT),
            )
        yield Case(
            name="resonance: amplitude in tune, F / (c ω)",
            level="energy/resonance",
            parameters=parameters,
            quantity="tuned.position.y",
            at=Expression("5*pi/2/sqrt(k)"),
            expected=lambda p, _: (
                p["F"] * abs(lagrange.response(MASS, p["k"], p["c"], sqrt(p["k"] / MASS)))
            ),
            tolerance=_bound(1.0, stiffness, ROW_DT),
            because=SECOND,
            order=SECOND_ORDER,
        )


def _bound(ratio: float, stiffness: float, dt: float) -> float:
    """Return (w dt)² / 2, with w the fastest angular frequency of a swing."""
    return (ratio * dt) ** 2 * stiffness / MASS / 2


def _driven(swing: Swing) -> Expected:
    def expected(p: Values, t: Array) -> Array:
        drive = p["ratio"] * sqrt(p["k"] / MASS)
        return swing(t, MASS, p["k"], p["c"], p["F"], drive)

    return expected


def _in_row(ratio: float) -> Expected:
    def expected(p: Values, t: Array) -> Array:
        drive = ratio * sqrt(p["k"] / MASS)
        return np.asarray(lagrange.driven_oscillation(t, MASS, p["k"], p["c"], p["F"], drive))

    return expected
