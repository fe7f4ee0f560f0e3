"""Pendulums on rods, pins and springs."""

from collections.abc import Iterator
from functools import partial

import numpy as np

from sandbox.model.expressions import Array, Expression, Values
from sandbox.model.level import CrossingEvent
from validation.case import SECOND_ORDER, Case, Choices, Parameters
from validation.formulas import lagrange

LOWEST = CrossingEvent(event="crossing", quantity="bob.position.x", direction="down")
UPRIGHT = CrossingEvent(
    event="crossing", quantity="stick.angle", value=Expression("-pi/2"), direction="down"
)
SECOND = "second order: (ω dt)² / 24 for small swings, some tenfold for large ones"

SPRUNG: Choices = ({}, {"k": 20.0, "angle": 60.0}, {"k": 100.0, "angle": 20.0})


def cases() -> Iterator[Case]:
    """Yield the cases of the pendulums."""
    yield from _simple()
    yield from _physical()
    yield from _on_a_cart()
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
    yield from _double()
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
    for parameters in SPRUNG:
        yield Case(
            name="spring pendulum: place of the bob at every step",
            level="energy/spring-pendulum",
            parameters=parameters,
            quantity="bob.position.x",
            expected=_sprung,
            tolerance=1e-4,
            order=SECOND_ORDER,
            because=SECOND,
            naive_misses=2e-4,
        )


def _double() -> Iterator[Case]:
    """Yield the place of the lower bob: the level ends before a small error grows large."""
    starts: tuple[Parameters, ...] = (
        {},
        {"m": 0.5, "angle": 100.0},
        {"m": 2.0, "angle": 150.0},
    )
    for parameters in starts:
        yield Case(
            name="double pendulum: place of the lower bob before chaos",
            level="lagrange/double-pendulum",
            parameters=parameters,
            quantity="lower.position.x",
            expected=_lower,
            tolerance=1e-4,
            order=SECOND_ORDER,
            because=SECOND,
            naive_misses=1e-4,
        )


def _simple() -> Iterator[Case]:
    swings: tuple[tuple[str, Parameters], ...] = (
        ("lagrange/simple-pendulum", {}),
        ("lagrange/simple-pendulum", {"L": 3.0, "g": 1.0, "angle": 5.0}),
        ("lagrange/simple-pendulum", {"L": 0.5, "g": 25.0, "angle": 1.0}),
        ("lagrange/large-pendulum", {}),
        ("lagrange/large-pendulum", {"angle": 170.0}),
        ("lagrange/large-pendulum", {"L": 0.5, "g": 25.0, "angle": 90.0}),
        ("lagrange/large-pendulum", {"L": 2.0, "g": 1.0, "angle": 10.0}),
    )
    for level, parameters in swings:
        case = partial(Case, level=level, parameters=parameters)
        yield case(
            name="pendulum: a quarter of its period",
            quantity="t",
            expected=lambda p, _: lagrange.pendulum_period(p["L"], p["g"], _amplitude(p)) / 4,
            at=LOWEST,
            tolerance=2e-5,
            order=SECOND_ORDER,
            because=SECOND,
            naive_misses=2e-4,
        )
        yield case(
            name="pendulum: the length of its rod",
            quantity="rod.length",
            expected=lambda p, _: p["L"],
            tolerance=1e-12,
            because="the rod holds at position level, to rounding; pymunk's is off by 3e-7 or more",
            naive_misses=1e-7,
        )


def _physical() -> Iterator[Case]:
    swings: tuple[Parameters, ...] = (
        {},
        {"angle": 120.0},
        {"L": 2.0, "g": 1.0},
        {"L": 0.5, "g": 25.0, "angle": 10.0},
    )
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


def _on_a_cart() -> Iterator[Case]:
    swings: tuple[Parameters, ...] = (
        {},
        {"M": 1.0, "m": 2.0, "l": 0.8, "angle": 60.0},
        {"M": 4.0, "m": 0.5, "l": 1.5, "angle": 1.0},
    )
    for parameters in swings:
        case = partial(Case, level="lagrange/cart-and-pendulum", parameters=parameters)
        yield case(
            name="cart and pendulum: place of the cart at every step",
            quantity="cart.position.x",
            expected=_cart,
            tolerance=1e-4,
            order=SECOND_ORDER,
            because=SECOND,
            naive_misses=1e-3,
        )
        yield case(
            name="cart and pendulum: place of the bob at every step",
            quantity="bob.position.x",
            expected=lambda p, t: -p["M"] / p["m"] * _cart(p, t),
            tolerance=1e-4,
            order=SECOND_ORDER,
            because=SECOND,
            naive_misses=1e-3,
        )
        yield case(
            name="cart and pendulum: momentum along the rail",
            quantity="system.momentum.x",
            expected=lambda _p, _t: 0.0,
            tolerance=1e-12,
            because="rail and rod give nothing along the rail that they do not take: rounding",
        )
    yield Case(
        name="cart and pendulum: a quarter of its period, swinging little",
        level="lagrange/cart-and-pendulum",
        parameters={"angle": 1.0},
        quantity="t",
        at=CrossingEvent(event="crossing", quantity="bob.position.x", direction="down"),
        expected=lambda p, _: (
            np.pi / 2 / lagrange.cart_pendulum_frequency(p["M"], p["m"], p["l"], 9.81)
        ),
        tolerance=1e-4,
        because="(θ²/16 and more: the cart moves) of a swing of one degree: 5.6e-5",
        naive_misses=1e-3,
    )


def _cart(p: Values, t: Array) -> Array:
    """Return where the cart is: the centre of mass stays at 0."""
    start = -p["m"] * p["l"] * float(np.sin(_amplitude(p))) / (p["M"] + p["m"])
    return start + lagrange.cart_pendulum(t, p["M"], p["m"], p["l"], 9.81, _amplitude(p))[0]


def _amplitude(p: Values) -> float:
    return float(np.radians(p["angle"]))


def _lower(p: Values, t: Array) -> Array:
    """Return where the lower bob of the double pendulum is, across [m]."""
    start = _amplitude(p), _amplitude(p)
    theta, phi = lagrange.double_pendulum(t, (1.0, p["m"]), (1.0, 0.8), 9.81, start)
    return np.asarray(np.sin(theta) + 0.8 * np.sin(phi))


def _sprung(p: Values, t: Array) -> Array:
    """Return where the bob of the spring pendulum is, across [m]."""
    r, theta = lagrange.spring_pendulum(t, 1.0, p["k"], 1.0, 9.81, _amplitude(p))
    return np.asarray(r * np.sin(theta))


def _double_energy(p: Values) -> float:
    height = -float(np.cos(_amplitude(p)))
    upper = lagrange.pendulum_energy(1.0, 9.81, height)
    return upper + lagrange.pendulum_energy(p["m"], 9.81, 1.8 * height)
