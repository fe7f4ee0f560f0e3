"""Balls that touch: cradles and a break at billiards."""

from collections.abc import Iterator
from functools import partial

import numpy as np

from sandbox.model.expressions import Expression, Values
from validation.case import SECOND_ORDER, Case, Choices, Parameters
from validation.formulas import energy, momentum

COUNT = 5
BALL = 0.17  # kg, of billiards
LINE: Choices = ({}, {"n": 1.0}, {"n": 3.0, "v": 3.0, "m": 10.0}, {"n": 4.0, "v": 0.5, "m": 0.1})
HUNG: Choices = (
    {},
    {"n": 2.0, "angle": 10.0},
    {"n": 3.0, "angle": 45.0, "L": 0.8},
    {"n": 4.0, "L": 1.4, "g": 5.0},
    {"g": 12.0},
)
BREAKS: Choices = ({}, {"v": 5.0, "offset": -2.0}, {"v": 1.0, "offset": 2.0})
SWAPPED = "the fastest pair collides first, and equal masses swap velocities: to rounding"


def cases() -> Iterator[Case]:
    """Yield the cases of balls that touch."""
    for parameters in LINE:
        yield from _on_a_line(parameters)
    for parameters in HUNG:
        yield from _hung(parameters)
    for parameters in BREAKS:
        yield from _break(parameters)


def _on_a_line(parameters: Parameters) -> Iterator[Case]:
    level = "momentum/cradle-on-a-line"
    after = 0.8 / parameters.get("v", 1.5) + 0.2
    for i in range(COUNT):
        yield Case(
            name=f"cradle on a line: velocity of ball {i + 1} after it",
            level=level,
            parameters=parameters,
            quantity=f"ball{i + 1}.velocity.x",
            at=Expression(after),
            expected=lambda p, _, i=i: momentum.cradle_velocities(  # type: ignore[misc]
                int(p["n"]), COUNT, p["v"]
            )[i],
            tolerance=1e-14,
            because=SWAPPED,
            naive_misses=1e-2 if i == 0 else None,
        )
    yield Case(
        name="cradle on a line: kinetic energy at every step",
        level=level,
        parameters=parameters,
        quantity="system.kinetic_energy",
        expected=lambda p, _: int(p["n"]) * energy.kinetic_energy((p["m"], p["v"])),
        tolerance=1e-14,
        because=SWAPPED,
    )


def _hung(parameters: Parameters) -> Iterator[Case]:
    case = partial(Case, level="momentum/cradle", parameters=parameters)
    yield case(
        name="cradle: energy at every step",
        quantity="system.energy",
        expected=lambda p, _: int(p["n"]) * _lifted(p),
        tolerance=2e-5,
        order=SECOND_ORDER,
        because="leapfrog's swing, of second order; the impacts themselves leave 1e-8",
        naive_misses=1e-3,
    )
    yield case(
        name="cradle: all the energy of a ball is in the last",
        quantity="ball5.energy",
        at=Expression("pi*sqrt(L/g)"),
        expected=lambda p, _: _lifted(p),
        tolerance=1e-4,
        because="the impacts come at their own time, the fastest pair first",
        naive_misses=1e-4 if parameters else 1e-2,
    )


def _lifted(p: Values) -> float:
    """Return the energy of a ball that was drawn aside [J]."""
    return p["g"] * p["L"] * float(1 - np.cos(np.radians(p["angle"])))


def _break(parameters: Parameters) -> Iterator[Case]:
    expected = {
        "system.momentum.x": lambda p, _: BALL * p["v"],
        "system.momentum.y": lambda _p, _: 0.0,
        "system.kinetic_energy": lambda p, _: energy.kinetic_energy((BALL, p["v"])),
    }
    for quantity, formula in expected.items():
        yield Case(
            name=f"break at billiards: {quantity.replace('.', ' ').replace('_', ' ')}",
            level="momentum/billiard-break",
            parameters=parameters,
            quantity=quantity,
            expected=formula,
            tolerance=1e-13,
            because="each impact keeps both, to rounding, however many there are",
            naive_misses=5e-3 if "energy" in quantity else None,
        )
