"""What rolls and slides in hollows: a disc in a half-pipe, a marble in a loop."""

from collections.abc import Iterator
from functools import partial
from math import radians

from sandbox.model.expressions import Values
from sandbox.model.level import CrossingEvent
from validation.case import SECOND_ORDER, Case, ends
from validation.formulas import energy, rotation

PIPE, LOOP = "rotation/half-pipe", "energy/loop"
LOWEST = CrossingEvent(event="crossing", quantity="disc.position.x", direction="down")
TOP = CrossingEvent(event="crossing", quantity="marble.position.x", direction="down")
MARBLE, MASS = 0.08, 0.1  # m, kg
SECOND = "second order: the way along the arc is one of chords, whose angle is v dt / (R − r)"


def cases() -> Iterator[Case]:
    """Yield the cases of hollows."""
    for parameters in ({}, *ends(PIPE), *ends(PIPE, "angle", "g")):
        case = partial(Case, level=PIPE, parameters=parameters, at=LOWEST, because=SECOND)
        yield case(
            name="half-pipe: quarter of a period",
            quantity="t",
            expected=lambda p, _: rotation.rolling_period(rotation.DISC, *_pipe(p)) / 4,
            tolerance=1e-4,
            naive_misses=3e-4,
        )
        yield case(
            name="half-pipe: speed at the lowest point",
            quantity="disc.speed",
            expected=lambda p, _: rotation.trough_speed(rotation.DISC, *_pipe(p)),
            tolerance=5e-4,
            order=SECOND_ORDER,
        )
        yield case(
            name="half-pipe: turning there",
            quantity="disc.angular_velocity",
            expected=lambda p, _: rotation.trough_speed(rotation.DISC, *_pipe(p)) / p["r"],
            tolerance=5e-4,
            order=SECOND_ORDER,
        )
    for parameters in ({}, *ends(LOOP)):
        case = partial(Case, level=LOOP, parameters=parameters, at=TOP, because=SECOND)
        yield case(
            name="loop: speed at the top",
            quantity="marble.speed",
            expected=lambda p, _: energy.loop_speed(p["speed"], p["R"] - MARBLE, p["g"]),
            tolerance=3e-4,
            order=SECOND_ORDER,
            naive_misses=5e-3,
        )
        yield case(
            name="loop: normal force at the top",
            quantity="marble.contact.normal",
            expected=lambda p, _: energy.loop_force(MASS, p["speed"], p["R"] - MARBLE, p["g"]),
            tolerance=5e-4,
            order=SECOND_ORDER,
            naive_misses=1e-2,
        )


def _pipe(p: Values) -> tuple[float, float, float]:
    return p["R"] - p["r"], p["g"], radians(p["angle"])
