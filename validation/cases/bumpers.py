"""Springs that only push: bumpers, and what they drive apart."""

from collections.abc import Callable, Iterator
from functools import partial

from sandbox.model.expressions import Expression, Values
from sandbox.model.level import CrossingEvent
from validation.case import SECOND_ORDER, Case, Choices, Parameters
from validation.formulas import momentum

GAP = 0.8  # m, from a cart to its bumper
BUMPERS: Choices = (
    {},
    {"m": 1.0, "v": 1.5, "k_stiff": 800.0, "k_soft": 15.0},
    {"m": 3.0, "v": 0.5, "k_stiff": 200.0, "k_soft": 60.0},
)
RECOIL: Choices = (
    {},
    {"M": 2.0, "m": 0.5, "k": 200.0, "s": 0.2},
    {"M": 20.0, "m": 5.0, "k": 50.0, "s": 0.5},
)
SECOND = "second order: (ω dt)² / 8 and less, with ω dt up to 0.015"


def cases() -> Iterator[Case]:
    """Yield the cases of springs that only push."""
    for parameters in BUMPERS:
        yield _energy("bumpers", parameters, lambda p: p["m"] * p["v"] ** 2)
        for name in ("stiff", "soft"):
            yield from _bumper(name, parameters)
    for parameters in RECOIL:
        yield _energy("recoil", parameters, lambda p: p["k"] * p["s"] ** 2 / 2)
        yield from _recoil(parameters)


def _energy(name: str, parameters: Parameters, stored: Callable[[Values], float]) -> Case:
    return Case(
        name=f"{name}: energy at every step",
        level=f"momentum/{name}",
        parameters=parameters,
        quantity="system.energy",
        expected=lambda p, _: stored(p),
        tolerance=1e-4,
        order=SECOND_ORDER,
        because=SECOND,
        naive_misses=5e-4,
    )


def _bumper(name: str, parameters: Parameters) -> Iterator[Case]:
    case = partial(Case, level="momentum/bumpers", parameters=parameters)

    def stiffness(p: Values) -> float:
        return p[f"k_{name}"]

    yield case(
        name=f"{name} bumper: greatest force",
        quantity=f"{name}_bumper.tension",
        at=CrossingEvent(
            event="crossing",
            quantity=f"{name}.velocity.x",
            value=Expression(0),
            direction="down",
        ),
        expected=lambda p, _: -momentum.bumper_peak_force(p["m"], p["v"], stiffness(p)),
        tolerance=1e-4,
        order=SECOND_ORDER,
        because=SECOND,
    )
    yield case(
        name=f"{name} bumper: when it lets go",
        quantity="t",
        at=CrossingEvent(
            event="crossing",
            quantity=f"{name}.position.x",
            value=Expression(1.7),
            direction="down",
        ),
        expected=lambda p, _: GAP / p["v"] + momentum.bumper_time(p["m"], stiffness(p)),
        tolerance=2e-5,
        order=SECOND_ORDER,
        because=SECOND,
    )
    yield case(
        name=f"{name} bumper: momentum after it",
        quantity=f"{name}.momentum.x",
        at=Expression(f"0.85/v + pi*sqrt(m/k_{name})"),
        expected=lambda p, _: -p["m"] * p["v"],
        tolerance=1e-4,
        because=SECOND,
    )


def _recoil(parameters: Parameters) -> Iterator[Case]:
    level = "momentum/recoil"
    yield Case(
        name="recoil: momentum at every step",
        level=level,
        parameters=parameters,
        quantity="system.momentum.x",
        expected=lambda _p, _: 0.0,
        tolerance=1e-13,
        because="the spring pushes both alike, to rounding",
    )
    for i, body in enumerate(("cannon", "ball")):
        yield Case(
            name=f"recoil: velocity of the {body}",
            level=level,
            parameters=parameters,
            quantity=f"{body}.velocity.x",
            at=Expression("pi/2*sqrt(m*M/(m + M)/k) + 0.1"),
            expected=lambda p, _, i=i: momentum.recoil_velocities(  # type: ignore[misc]
                p["M"], p["m"], p["k"] * p["s"] ** 2 / 2
            )[i],
            tolerance=1e-4,
            because=SECOND,
        )
