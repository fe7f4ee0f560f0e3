"""Bodies that lose or gain mass: rockets, and a cart that is filled."""

from collections.abc import Iterator
from functools import partial

from sandbox.model.expressions import Array, Expression, Values
from validation.case import SECOND_ORDER, Case, Choices
from validation.formulas import newton

SPACE: Choices = (
    {},
    {"u": 60.0, "share": 0.9, "burn": 2.0, "mass": 10.0},
    {"u": 10.0, "share": 0.2, "burn": 6.0, "mass": 1000.0},
)
LAUNCHES: Choices = (
    {},
    {"u": 100.0, "share": 0.9, "burn": 4.0, "mass": 10.0, "g": 5.0},
    {"u": 40.0, "share": 0.9, "burn": 4.0, "mass": 1000.0, "g": 15.0},
    {"u": 40.0, "share": 0.5, "burn": 8.0, "g": 15.0},  # never lifts off
)
CARTS: Choices = (
    {},
    {"drive": 1.0},
    {"v": 5.0, "rate": 2.0, "mass": 1.0},
    {"v": 1.0, "rate": 0.1, "mass": 5.0, "drive": 0.5},
)


def cases() -> Iterator[Case]:
    """Yield the cases of changing mass."""
    for parameters in SPACE:
        case = partial(Case, level="newton/rocket", parameters=parameters)
        yield case(
            name="rocket: velocity half-way",
            quantity="rocket.velocity.x",
            at=Expression("burn/2"),
            expected=lambda p, t: newton.rocket_velocity(p["u"], _mass(p, t), p["mass"]),
            tolerance=1e-5,
            order=SECOND_ORDER,
            because="each kick takes the mass at its middle: second order",
            naive_misses=5e-5,
        )
        yield case(
            name="rocket: way when it is burnt out",
            quantity="rocket.position.x",
            at=Expression("burn"),
            expected=lambda p, t: newton.rocket_way(p["u"], _rate(p), p["mass"], t),
            tolerance=5e-5,
            order=SECOND_ORDER,
            because="second order; a kick in which the burning ends has its share of it",
            naive_misses=5e-4,
        )
    for parameters in LAUNCHES:
        yield Case(
            name="launch: velocity at every step",
            level="newton/rocket-launch",
            parameters=parameters,
            quantity="rocket.velocity.y",
            expected=lambda p, t: newton.launch_velocity(p["u"], _rate(p), p["mass"], p["g"], t),
            tolerance=5e-5,
            because="second order, and the pad lets go of itself",
            naive_misses=1e-3 if parameters.get("share") != 0.5 else None,
        )
        yield Case(
            name="launch: what the pad holds up at the start",
            level="newton/rocket-launch",
            parameters=parameters,
            quantity="rocket.contact.normal",
            at=Expression(0),
            expected=lambda p, _: newton.pad_force(p["u"], _rate(p), p["mass"], p["g"]),
            tolerance=1e-10,
            because="one contact, solved to rounding",
        )
    for parameters in CARTS:
        yield Case(
            name="filling cart: velocity at every step",
            level="newton/cart-under-hopper",
            parameters=parameters,
            quantity="cart.velocity.x",
            expected=lambda p, t: _cart(p, t)[1],
            tolerance=2e-5,
            because="second order in the change of mass over a step",
        )
        yield Case(
            name="filling cart: momentum at every step",
            level="newton/cart-under-hopper",
            parameters=parameters,
            quantity="cart.momentum.x",
            expected=lambda p, t: _cart(p, t)[0] * _cart(p, t)[1],
            tolerance=5e-5,
            because="the mass of each instant, and the velocity to second order",
        )


def _rate(p: Values) -> float:
    return p["share"] * p["mass"] / p["burn"]


def _mass(p: Values, t: Array) -> Array:
    return p["mass"] - _rate(p) * t


def _cart(p: Values, t: Array) -> tuple[Array, Array]:
    force = p["drive"] * p["rate"] * p["v"]
    return newton.filling_cart(force, p["rate"], p["mass"], p["v"], t)
