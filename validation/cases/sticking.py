"""Perfectly inelastic collisions: what meets becomes one body."""

from collections.abc import Iterator
from functools import partial

from sandbox.model.expressions import Expression
from sandbox.model.level import ContactEvent, CrossingEvent
from validation.case import SECOND_ORDER, Case, Choices
from validation.formulas import energy, momentum

PAIRS: Choices = (
    {},
    {"m1": 5.0, "m2": 0.2, "v": 4.0, "b": 0.55},
    {"m1": 0.2, "m2": 5.0, "v": 1.0, "b": 0.1},
)
PENDULUMS: Choices = (
    {},
    {"v": 20.0, "m": 0.2, "M": 1.0, "L": 1.0, "g": 8.0},
    {"v": 8.0, "m": 0.05, "M": 4.0, "L": 3.0, "g": 12.0},
)
MET = ContactEvent(event="contact", bodies=("puck", "stone"))
HIT = ContactEvent(event="contact", bodies=("clay", "block"))
HIGHEST = CrossingEvent(event="crossing", quantity="block.velocity.x", direction="down")
DT = 1 / 1000  # s, the step of the ballistic pendulum
INSIDE = "what sticks them together acts on both alike, at one point, to rounding"
CHORD = "second order: in a step the centres go along a chord, (ω dt)² / 6 shorter than the arc"


def cases() -> Iterator[Case]:
    """Yield the cases of bodies that stick."""
    yield from _pair()
    yield from _ballistic()


def _pair() -> Iterator[Case]:
    level = "momentum/sticking"
    for parameters in PAIRS:
        case = partial(Case, level=level, parameters=parameters)
        yield case(
            name="sticking: velocity of the truck after it",
            quantity="truck.velocity.x",
            at=ContactEvent(event="contact", bodies=("cart", "truck")),
            expected=lambda p, _: momentum.common_velocity(p["m1"], p["m2"], p["v"]),
            tolerance=1e-12,
            because="two bodies on a line and one impulse: linear",
        )
        yield case(
            name="sticking: angular momentum at every step",
            quantity="system.angular_momentum",
            expected=lambda p, _: -p["m1"] * p["v"] * (1.3 + p["b"]),
            tolerance=1e-13,
            because=INSIDE,
        )
        yield case(
            name="sticking off centre: spin after it",
            quantity="puck.angular_velocity",
            at=MET,
            expected=lambda p, _: momentum.stuck_spin(p["m1"], p["m2"], p["v"], p["b"], 0.3),
            tolerance=3e-5,
            order=SECOND_ORDER,
            because=CHORD,
        )
        yield case(
            name="sticking off centre: spin of the stone in the end",
            quantity="stone.angular_velocity",
            at=Expression(2),
            expected=lambda p, _: momentum.stuck_spin(p["m1"], p["m2"], p["v"], p["b"], 0.3),
            tolerance=3e-5,
            because=CHORD,
        )
        yield case(
            name="sticking off centre: energy after it",
            quantity="system.kinetic_energy",
            at=MET,
            expected=lambda p, _: (
                momentum.stuck_energy(p["m1"], p["m2"], p["v"], p["b"], 0.3)
                + momentum.stuck_energy(p["m1"], p["m2"], p["v"], 0.0, 0.3)
            ),
            tolerance=3e-5,
            because=CHORD,
        )


def _ballistic() -> Iterator[Case]:
    level = "momentum/ballistic-pendulum"
    for parameters in PENDULUMS:
        case = partial(Case, level=level, parameters=parameters)
        yield case(
            name="ballistic pendulum: velocity a step after the impact",
            quantity="block.velocity.x",
            at=HIT,
            expected=lambda p, _: momentum.ballistic_velocity(
                p["m"], p["M"], p["v"], p["L"], p["g"], DT
            ),
            tolerance=1e-9,
            because="the impact is exact; a step's swing is off by its angle's fourth power",
            naive_misses=1e-6,
        )
        yield case(
            name="ballistic pendulum: energy just after the impact",
            quantity="system.kinetic_energy",
            at=HIT,
            expected=lambda p, _: energy.kinetic_energy(
                (p["m"] + p["M"], momentum.common_velocity(p["m"], p["M"], p["v"]))
            ),
            tolerance=2e-5,
            because="the impact is exact; what swings up in a step is (g dt / v)² and less",
        )
        yield case(
            name="ballistic pendulum: tension just after the impact",
            quantity="rod.tension",
            at=HIT,
            expected=lambda p, _: momentum.ballistic_tension(
                p["m"], p["M"], p["v"], p["L"], p["g"]
            ),
            tolerance=1e-4,
            because="as the energy",
        )
        yield case(
            name="ballistic pendulum: greatest height",
            quantity="block.position.y",
            at=HIGHEST,
            expected=lambda p, _: momentum.ballistic_height(p["m"], p["M"], p["v"], p["g"]),
            tolerance=2e-5,
            order=SECOND_ORDER,
            because="second order: (ω dt)² of leapfrog's energy",
        )
