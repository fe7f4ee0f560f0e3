"""A centre that repels: how near a body comes, and what it keeps as it passes."""

from collections.abc import Iterator

from sandbox.model.level import CrossingEvent
from validation.case import SECOND_ORDER, Case, Choices
from validation.formulas import energy

LEVEL = "energy/repulsion"
CHOICES: Choices = ({}, {"k": 3.0, "v": 3.0, "b": 0.5}, {"k": 8.0, "v": 1.5, "b": 2.0})
START = 4.0  # m
SECOND = "second order: (v dt)² over the square of the closest distance, 7e-6 at the most"


def cases() -> Iterator[Case]:
    """Yield the cases of repulsion."""
    for parameters in CHOICES:
        for body, times, side in (("slow", 1.0, -1), ("fast", 1.5, 1)):
            yield Case(
                name=f"repulsion: how near the {body} one comes",
                level=LEVEL,
                parameters=parameters,
                quantity=f"{body}.position.x",
                at=_turns(body),
                expected=lambda p, _, times=times, side=side: (  # type: ignore[misc]
                    side * energy.closest_approach(START, times * p["v"], p["k"])
                ),
                tolerance=2e-5,
                because=SECOND,
                order=SECOND_ORDER,
                naive_misses=2.5e-5,
            )
            yield Case(
                name=f"repulsion: when the {body} one turns",
                level=LEVEL,
                parameters=parameters,
                quantity="t",
                at=_turns(body),
                expected=lambda p, _, times=times: (  # type: ignore[misc]
                    energy.repelled_time(START, times * p["v"], p["k"])
                ),
                tolerance=2e-5,
                because=SECOND,
                order=SECOND_ORDER,
                naive_misses=5e-5,
            )
        yield Case(
            name="repulsion: angular momentum of the one that passes",
            level=LEVEL,
            parameters=parameters,
            quantity="system.angular_momentum",
            expected=lambda p, _: -p["b"] * p["v"],
            tolerance=1e-12,
            because="a kick along the line to the centre has no torque about it",
        )


def _turns(body: str) -> CrossingEvent:
    return CrossingEvent(event="crossing", quantity=f"{body}.velocity.x")
