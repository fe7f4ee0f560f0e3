"""The pendulum of the chapter's code, by the three schemes."""

from collections.abc import Iterator

import numpy as np

from sandbox.model.expressions import Array, Values
from sandbox.model.level import CrossingEvent
from validation.case import SECOND_ORDER, Case, Choices
from validation.formulas import document, lagrange

PENDULUMS: Choices = (
    {},
    {"start": 0.8, "L": 0.5, "g": 12.0},
    {"start": 0.2, "L": 1.5, "g": 5.0},
)
BOTTOM = CrossingEvent(event="crossing", quantity="needle.angle", direction="down")


def cases() -> Iterator[Case]:
    """Yield the cases of plain Euler, of symplectic Euler and of leapfrog."""
    for parameters in PENDULUMS:
        yield Case(
            name="plain Euler: angle at every step, as the chapter's code has it",
            level="lagrange/euler-pendulum",
            parameters=parameters,
            quantity="needle.angle",
            expected=_plain,
            tolerance=1e-12,
            because="the same recurrence in the same order: bit for bit where L is 1 m, else 6e-15",
            naive_misses=1e-1,
        )
        yield Case(
            name="symplectic Euler: angle at every step, as the chapter's code has it",
            level="lagrange/symplectic-pendulum",
            parameters=parameters,
            quantity="needle.angle",
            expected=_symplectic,
            tolerance=1e-12,
            because="the same recurrence, which here begins with a drift",
        )
        yield Case(
            name="leapfrog: energy at every step",
            level="lagrange/leapfrog-pendulum",
            parameters=parameters,
            quantity="system.energy",
            expected=lambda p, _: lagrange.pendulum_energy(1.0, p["g"], -_drop(p)),
            tolerance=1.25e-4,
            order=SECOND_ORDER,
            because="second order: (ω dt)² / 8 of the kinetic energy, 6e-5 at the most",
        )
        yield Case(
            name="leapfrog: a quarter of its period",
            level="lagrange/leapfrog-pendulum",
            parameters=parameters,
            quantity="t",
            at=BOTTOM,
            expected=lambda p, _: lagrange.pendulum_period(p["L"], p["g"], p["start"]) / 4,
            tolerance=5e-5,
            order=SECOND_ORDER,
            because="second order: (ω dt)² / 24 for small swings, 1.3e-5",
            naive_misses=2e-3,
        )


def _drop(p: Values) -> float:
    return p["L"] * float(np.cos(p["start"]))


def _plain(p: Values, t: Array) -> Array:
    return document.swings(document.step_euler, p["start"], 0.0, p["L"], p["g"], t)


def _symplectic(p: Values, t: Array) -> Array:
    """Start the chapter, which kicks first, with what that first kick takes away."""
    ahead = p["g"] / p["L"] * float(np.sin(p["start"])) * document.DT
    return document.swings(document.step_symplectic, p["start"], ahead, p["L"], p["g"], t)
