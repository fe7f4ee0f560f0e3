"""What rolls and slides in hollows: in a half-pipe, in a loop, and in cycloids."""

from collections.abc import Iterator
from functools import partial
from math import pi, radians

from sandbox.model.expressions import Array, Values
from sandbox.model.level import CrossingEvent
from validation.case import SECOND_ORDER, Case, ends
from validation.formulas import energy, lagrange, rotation

PIPE, LOOP = "rotation/half-pipe", "energy/loop"
BOWLS, SLIDE = "rotation/cycloid-bowls", "energy/cycloid-slide"
STARTS = {"high": (1.0, 0.0), "middle": (0.6, 0.9), "low": (0.3, 1.8)}
"""Of the discs, as shares of the angle; and how high the bowls are, over R."""
LOWEST = CrossingEvent(event="crossing", quantity="disc.position.x", direction="down")
TOP = CrossingEvent(event="crossing", quantity="marble.position.x", direction="down")
MARBLE, MASS = 0.08, 0.1  # m, kg
BENDS = "second order, as on arcs, with the curvature in place of 1 / r; and an overlap of 5e-7 m"
SECOND = "second order: the way along the arc is one of chords, whose angle is v dt / (R − r)"


def cases() -> Iterator[Case]:
    """Yield the cases of hollows."""
    yield from _arcs()
    yield from _bowls()
    yield from _slides()


def _arcs() -> Iterator[Case]:
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


def _bowls() -> Iterator[Case]:
    for parameters in ({}, *ends(BOWLS), *ends(BOWLS, "R", "g")):
        case = partial(Case, level=BOWLS, parameters=parameters, because=BENDS)
        for disc in STARTS:
            yield case(
                name=f"cycloid bowls: time of the {disc} disc to its lowest point",
                quantity="t",
                expected=lambda p, _: rotation.cycloid_quarter(rotation.DISC, p["R"], p["g"]),
                at=CrossingEvent(event="crossing", quantity=f"{disc}.position.x", direction="down"),
                tolerance=5e-6,
                naive_misses=2e-4,
            )
            yield case(
                name=f"cycloid bowls: height of the {disc} disc at every step",
                quantity=f"{disc}.position.y",
                expected=partial(_height, disc),
                tolerance=5e-5,
                naive_misses=1e-3 if disc == "high" else None,
            )


def _height(disc: str, p: Values, t: Array) -> Array:
    share, up = STARTS[disc]
    start = share * radians(p["angle"])
    return up * p["R"] + rotation.cycloid_height(rotation.DISC, p["R"], p["g"], start, t)


def _slides() -> Iterator[Case]:
    for parameters in ({}, *ends(SLIDE)):
        case = partial(Case, level=SLIDE, parameters=parameters, because=BENDS)
        yield case(
            name="two slides: time on the cycloid",
            quantity="t",
            expected=lambda p, _: lagrange.cycloid_time(p["R"], p["g"]),
            at=CrossingEvent(event="crossing", quantity="cycloid.position.x", direction="up"),
            tolerance=5e-6,
            order=SECOND_ORDER,
            naive_misses=5e-4,
        )
        yield case(
            name="two slides: height on the cycloid at every step",
            quantity="cycloid.position.y",
            expected=lambda p, t: lagrange.cycloid_height(t, p["R"], p["g"], pi),
            tolerance=5e-6,
            order=SECOND_ORDER,
            naive_misses=2e-3,
        )


def _pipe(p: Values) -> tuple[float, float, float]:
    return p["R"] - p["r"], p["g"], radians(p["angle"])
