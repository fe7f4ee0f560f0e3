"""Bounces: between walls, where they are exact, and on the ground, where they are found late."""

from collections.abc import Iterator

from sandbox.model.level import ApexEvent, ContactEvent
from validation.case import Case, Choices, Parameters
from validation.formulas import leapfrog, momentum

WALLS: Choices = ({}, {"e": 1.0, "speed": 6.0}, {"e": 0.4, "speed": 2.0, "mass": 100.0})
LOSSY: Choices = (
    {},
    {"e": 0.7, "height": 3.0, "g": 10.0},
)
ELASTIC: Choices = (
    {"e": 1.0},
    {"e": 1.0, "height": 6.0, "g": 5.0},
)
DEFAULTS = {"height": 3.0, "e": 0.8, "g": 9.81}
DT = 1 / 3000  # s, the step of the bouncing ball
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
    level = "momentum/bouncing-ball"
    p = {**DEFAULTS, **parameters}
    kick = p["g"] * DT / momentum.rebound_speed(p["height"], p["e"], p["g"])
    yield Case(
        name="bouncing ball: speed after the bounce",
        level=level,
        parameters=parameters,
        quantity="ball.velocity.y",
        at=BOUNCE,
        expected=lambda p, _: momentum.rebound_speed(p["height"], p["e"], p["g"]),
        tolerance=(1 + p["e"]) / 2 * kick + 1e-12,
        because="scaled half a step early and read a step late: up to (1 + e) g dt / 2 too slow",
    )
    yield Case(
        name="bouncing ball: height after the bounce",
        level=level,
        parameters=parameters,
        quantity="ball.position.y",
        at=APEX,
        expected=lambda p, _: momentum.rebound_height(p["height"], p["e"]),
        tolerance=leapfrog.rebound_height_error(p["height"], p["e"], p["g"], DT),
        because="the impact is found up to a step late: see rebound_height_error",
    )
    yield Case(
        name="bouncing ball: time of the apex",
        level=level,
        parameters=parameters,
        quantity="t",
        at=APEX,
        expected=lambda p, _: momentum.rebound_time(p["height"], p["e"], p["g"]),
        tolerance=(1.5 + p["e"] / 2) * DT / momentum.rebound_time(p["height"], p["e"], p["g"]),
        because="the impact is up to dt late, and by e g dt + (1 − e) g dt / 2 too fast",
    )


def _elastic(parameters: Parameters) -> Iterator[Case]:
    level = "momentum/bouncing-ball"
    yield Case(
        name="bouncing ball, elastic: energy at every step",
        level=level,
        parameters=parameters,
        quantity="ball.energy",
        expected=lambda p, _: p["g"] * p["height"],
        tolerance=3e-13,
        because="wherever the impact is found, it turns the speed there round and no more",
        naive_misses=1e-4,
    )
    yield Case(
        name="bouncing ball, elastic: height after the bounce",
        level=level,
        parameters=parameters,
        quantity="ball.position.y",
        at=APEX,
        expected=lambda p, _: momentum.rebound_height(p["height"], 1.0),
        tolerance=3e-13,
        because="energy is kept to rounding, and the cubic between steps is exact for a parabola",
    )
