"""Pendulums on rods, pins and springs."""

from collections.abc import Iterator

import numpy as np

from sandbox.model.expressions import Expression, Values
from sandbox.model.level import CrossingEvent
from validation.case import SECOND_ORDER, Case, Parameters
from validation.formulas import lagrange

LOWEST = CrossingEvent(event="crossing", quantity="bob.position.x", direction="down")
UPRIGHT = CrossingEvent(
    event="crossing", quantity="stick.angle", value=Expression("-pi/2"), direction="down"
)
SECOND = "second order: (ω dt)² / 24 for small swings, some tenfold for large ones"


def cases() -> Iterator[Case]:
    """Yield the cases of the pendulums."""
    yield from _simple()
    yield from _physical()
    yield Case(
        name="double pendulum: energy at every step",
        level="lagrange/double-pendulum",
        quantity="system.energy",
        expected=lambda p, _: _double_energy(p),
        tolerance=1e-4,
        order=SECOND_ORDER,
        because="leapfrog's energy swings by (ω dt)² of its scale, and does not drift",
        naive_misses=5e-4,
    )
    yield Case(
        name="spring pendulum: energy at every step",
        level="energy/spring-pendulum",
        quantity="system.energy",
        expected=lambda p, _: lagrange.pendulum_energy(1.0, 9.81, -np.cos(np.radians(p["angle"]))),
        tolerance=2e-5,
        order=SECOND_ORDER,
        naive_misses=5e-4,
        because="as for the double pendulum",
    )


def _simple() -> Iterator[Case]:
    swings: tuple[tuple[str, Parameters], ...] = (
        ("lagrange/simple-pendulum", {}),
        ("lagrange/simple-pendulum", {"L": 3.0, "g": 1.0, "angle": 5.0}),
        ("lagrange/large-pendulum", {}),
        ("lagrange/large-pendulum", {"angle": 170.0}),
        ("lagrange/large-pendulum", {"L": 0.5, "g": 25.0, "angle": 90.0}),
    )
    for level, parameters in swings:
        yield Case(
            name="pendulum: a quarter of its period",
            level=level,
            parameters=parameters,
            quantity="t",
            expected=lambda p, _: lagrange.pendulum_period(p["L"], p["g"], _amplitude(p)) / 4,
            at=LOWEST,
            tolerance=2e-5,
            order=SECOND_ORDER,
            because=SECOND,
            naive_misses=2e-4,
        )
        yield Case(
            name="pendulum: the length of its rod",
            level=level,
            parameters=parameters,
            quantity="rod.length",
            expected=lambda p, _: p["L"],
            tolerance=1e-12,
            because="the rod holds at position level, to rounding",
        )


def _physical() -> Iterator[Case]:
    swings: tuple[Parameters, ...] = ({}, {"angle": 120.0}, {"L": 2.0, "g": 1.0})
    for parameters in swings:
        yield Case(
            name="stick on a pin: a quarter of its period",
            level="rotation/physical-pendulum",
            parameters=parameters,
            quantity="t",
            expected=lambda p, _: (
                lagrange.physical_pendulum_period(p["L"], p["g"], _amplitude(p)) / 4
            ),
            at=UPRIGHT,
            tolerance=2e-5,
            order=SECOND_ORDER,
            because=SECOND,
            naive_misses=2e-4,
        )


def _amplitude(p: Values) -> float:
    return float(np.radians(p["angle"]))


def _double_energy(p: Values) -> float:
    height = -float(np.cos(_amplitude(p)))
    upper = lagrange.pendulum_energy(1.0, 9.81, height)
    return upper + lagrange.pendulum_energy(p["m"], 9.81, 1.8 * height)
