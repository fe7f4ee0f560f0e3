"""Bounces: between walls, and on the ground with their time located."""

from collections.abc import Iterator
from functools import partial

from sandbox.model.level import ApexEvent, ContactEvent
from validation.case import Case, Choices, Parameters
from validation.formulas import momentum

WALLS: Choices = (
    {},
    {"e": 1.0, "speed": 6.0, "mass": 0.1},
    {"e": 0.4, "speed": 2.0, "mass": 100.0},
)
LOSSY: Choices = (
    {},
    {"e": 0.3, "height": 1.0, "g": 10.0},
)
ELASTIC: Choices = (
    {"e": 1.0},
    {"e": 1.0, "height": 6.0, "g": 5.0},
)
BOUNCE = ContactEvent(event="contact", bodies=("ball", "ground"))
APEX = ApexEvent(event="apex", body="ball")


def cases() -> Iterator[Case]:
    """Yield the cases of bounces."""
    for parameters in WALLS:
        yield from _walls(parameters)
    for parameters in LOSSY:
        yield from _lossy(parameters)
    for parameters in ELASTIC:
        yield from _elastic(parameters)


def _walls(parameters: Parameters) -> Iterator[Case]:
    for hits, wall in enumerate(("right_wall", "left_wall"), start=1):
        yield Case(
            name=f"between walls: velocity after the {wall.replace('_', ' ')}",
            level="momentum/between-walls",
            parameters=parameters,
            quantity="puck.velocity.x",
            at=ContactEvent(event="contact", bodies=("puck", wall)),
            expected=lambda p, _, n=hits: momentum.velocity_between_walls(  # type: ignore[misc]
                p["speed"], p["e"], n
            ),
            tolerance=1e-14,
            because="nothing pulls between the walls: the solver scales the very speed that hits",
        )


def _lossy(parameters: Parameters) -> Iterator[Case]:
    case = partial(Case, level="momentum/bouncing-ball", parameters=parameters)
    yield case(
        name="bouncing ball: time of the bounce",
        quantity="t",
        at=BOUNCE,
        expected=lambda p, _: momentum.fall_time(p["height"], p["g"]),
        tolerance=1e-12,
        because="the drift is cut where the parabola touches the ground",
        naive_misses=1e-3,
    )
    yield case(
        name="bouncing ball: speed after the bounce",
        quantity="ball.velocity.y",
        at=BOUNCE,
        expected=lambda p, _: momentum.rebound_speed(p["height"], p["e"], p["g"]),
        tolerance=1e-12,
        because="the speed at the impact itself is scaled",
        naive_misses=1e-3,
    )
    yield case(
        name="bouncing ball: height after the bounce",
        quantity="ball.position.y",
        at=APEX,
        expected=lambda p, _: momentum.rebound_height(p["height"], p["e"]),
        tolerance=1e-12,
        because="the drift goes on from the impact along a new parabola",
        naive_misses=1e-3,
    )
    yield case(
        name="bouncing ball: time of the apex",
        quantity="t",
        at=APEX,
        expected=lambda p, _: momentum.rebound_time(p["height"], p["e"], p["g"]),
        tolerance=1e-12,
        because="the time of the impact is no step's, but its own",
        naive_misses=1e-3,
    )


def _elastic(parameters: Parameters) -> Iterator[Case]:
    case = partial(Case, level="momentum/bouncing-ball", parameters=parameters)
    yield case(
        name="bouncing ball, elastic: energy at every step",
        quantity="ball.energy",
        expected=lambda p, _: p["g"] * p["height"],
        tolerance=3e-13,
        because="wherever the impact is found, it turns the speed there round and no more",
        naive_misses=1e-4,
    )
    yield case(
        name="bouncing ball, elastic: height after the bounce",
        quantity="ball.position.y",
        at=APEX,
        expected=lambda p, _: momentum.rebound_height(p["height"], 1.0),
        tolerance=3e-13,
        because="energy is kept to rounding, and the cubic between steps is exact for a parabola",
    )
