"""Torques: doors, the moments of inertia of the chapter's table, and a balance beam."""

from cmath import rect
from collections.abc import Callable, Iterator
from functools import partial
from math import radians

from sandbox.model.expressions import Array, Expression, Values
from sandbox.model.level import CrossingEvent
from validation.case import SECOND_ORDER, Case, Choices, Expected
from validation.formulas import lagrange, rotation

PUSHES: Choices = (
    {},
    {"F": 30.0, "phi": 80.0, "w": 0.7, "m": 10.0},
    {"F": 5.0, "phi": 10.0, "w": 1.1, "m": 40.0},
)
COUPLES: Choices = (
    {},
    {"torque": 2.0, "M": 1.0, "R": 0.25},
    {"torque": 0.2, "M": 5.0, "R": 0.45},
)
PINS: Choices = (
    {},
    {"torque": 2.0, "M": 0.5, "L": 0.8, "d": 0.4},
    {"torque": 0.2, "M": 3.0, "L": 1.4, "d": 0.05},
)
BALANCED: Choices = ({}, {"m1": 5.0, "r1": 0.4, "m2": 5.0, "r2": 0.4, "g": 25.0})
TIPPING: Choices = (
    {"r2": 1.2},
    {"m1": 1.0, "r2": 1.8, "g": 2.0},
    {"m1": 5.0, "r1": 1.8, "m2": 1.0, "r2": 0.4, "g": 25.0},
)
BEAM, HALF = 3.0, 2.0  # kg, m
HANGS = CrossingEvent(
    event="crossing", quantity="beam.angle", value=Expression("pi/2*sign(m1*r1 - m2*r2)")
)
EXACT = "free bodies under a constant torque: leapfrog is exact"
PINNED = "second order: the centre's arc for its chord, (ω dt)² / 2 at the end, less on the way"

Moment = Callable[[Values], float]


def cases() -> Iterator[Case]:
    """Yield the cases of torques."""
    for parameters in PUSHES:
        for door, push in _pushes().items():
            yield Case(
                name=f"door: angle of the one pushed '{door}'",
                level="rotation/door",
                parameters=parameters,
                quantity=f"{door}.angle",
                expected=_door(push),
                tolerance=1e-12 if door in ("hinge", "along") else 1e-4,
                because="no torque" if door in ("hinge", "along") else PINNED,
                order=None if door in ("hinge", "along") else SECOND_ORDER,
                naive_misses=None if door in ("hinge", "along") else 1e-3,
            )
    for parameters in COUPLES:
        for body, moment in _bodies().items():
            yield Case(
                name=f"moment of inertia: angle of the {body}",
                level="rotation/moments-of-inertia",
                parameters=parameters,
                quantity=f"{body}.angle",
                expected=_spun(moment),
                tolerance=1e-4 if body == "pinned" else 1e-12,
                because=PINNED if body == "pinned" else EXACT,
                order=SECOND_ORDER if body == "pinned" else None,
                naive_misses=5e-4,
            )
    for parameters in PINS:
        for body, moment in _pinned().items():
            yield Case(
                name=f"parallel axis: angle of the rod on its pin, {body}",
                level="rotation/parallel-axis",
                parameters=parameters,
                quantity=f"{body}.angle",
                expected=_spun(moment),
                tolerance=1e-12 if body == "center" else 1e-4,
                because=EXACT if body == "center" else PINNED,
                order=None if body == "center" else SECOND_ORDER,
                naive_misses=5e-4,
            )
    yield from _beam()


def _pushes() -> dict[str, Callable[[Values], tuple[complex, complex]]]:
    """Return the arm from the hinge and the push of each door, along the door and across it."""
    return {
        "hinge": lambda p: (0j, p["F"] * 1j),
        "middle": lambda p: (p["w"] / 2 + 0j, p["F"] * 1j),
        "handle": lambda p: (p["w"] + 0j, p["F"] * 1j),
        "slanted": lambda p: (p["w"] + 0j, -rect(p["F"], -radians(p["phi"]))),
        "along": lambda p: (p["w"] + 0j, -p["F"] + 0j),
    }


def _door(push: Callable[[Values], tuple[complex, complex]]) -> Expected:
    def expected(p: Values, t: Array) -> Array:
        moment = rotation.rod_moment(p["m"], p["w"], p["w"] / 2)
        return rotation.spun_angle(rotation.torque(*push(p)), moment, t)

    return expected


def _bodies() -> dict[str, Moment]:
    factors = {
        "hoop": rotation.HOOP,
        "disc": rotation.DISC,
        "sphere": rotation.SPHERE,
        "hollow": rotation.HOLLOW_SPHERE,
    }
    return {
        **{name: _round(factor) for name, factor in factors.items()},
        "rod": lambda p: rotation.rod_moment(p["M"], 2 * p["R"]),
        "pinned": lambda p: rotation.rod_moment(p["M"], 2 * p["R"], p["R"]),
    }


def _round(factor: float) -> Moment:
    return lambda p: rotation.round_moment(factor, p["M"], p["R"])


def _pinned() -> dict[str, Moment]:
    return {
        "center": lambda p: rotation.rod_moment(p["M"], p["L"]),
        "between": lambda p: rotation.rod_moment(p["M"], p["L"], p["d"]),
        "end": lambda p: rotation.rod_moment(p["M"], p["L"], p["L"] / 2),
    }


def _spun(moment: Moment) -> Expected:
    return lambda p, t: rotation.spun_angle(p["torque"], moment(p), t)


def _beam() -> Iterator[Case]:
    beam = partial(Case, level="rotation/balance-beam")
    for parameters in BALANCED:
        yield beam(
            parameters=parameters,
            name="balance beam: level where m1 r1 = m2 r2",
            quantity="beam.angle",
            expected=lambda _p, _t: 0.0,
            tolerance=1e-12,
            because="equal and opposite torques, to rounding; pymunk's pin gives way to one",
            naive_misses=1e-8,
        )
    for parameters in TIPPING:
        case = partial(beam, parameters=parameters)
        yield case(
            name="balance beam: net torque over moment",
            quantity="beam.angular_acceleration",
            at=Expression(0.0),
            expected=lambda p, _: _net(p) / _inertia(p),
            tolerance=1e-7,
            because="the first kick, from rest: Newton's method ends at 1e-9",
        )
        yield case(
            name="balance beam: time until it hangs",
            quantity="t",
            at=HANGS,
            expected=lambda p, _: lagrange.tipping_time(_inertia(p), abs(_net(p))),
            tolerance=1e-4,
            because="second order: (ω dt)² / 24 and some, 2e-5 at the most",
            order=SECOND_ORDER,
            naive_misses=2e-4,
        )
        yield case(
            name="balance beam: how fast it turns when it hangs",
            quantity="beam.angular_velocity",
            at=HANGS,
            expected=_turning,
            tolerance=1e-4,
            because="second order: (ω dt)² / 24 and some; pymunk's own keeps the energy as well",
            order=SECOND_ORDER,
        )


def _net(p: Values) -> float:
    """Return the torque of the weights while the beam is level [N m]."""
    weights = ((-p["r1"], p["m1"]), (p["r2"], p["m2"]))
    return sum(rotation.torque(complex(arm), -1j * mass * p["g"]) for arm, mass in weights)


def _inertia(p: Values) -> float:
    """Return the moment of the beam and its weights about the pin [kg m²]."""
    weights = ((p["r1"], p["m1"]), (p["r2"], p["m2"]))
    beam = rotation.rod_moment(BEAM, 2 * HALF)
    return beam + sum(rotation.round_moment(rotation.HOOP, mass, arm) for arm, mass in weights)


def _turning(p: Values, _: Array) -> float:
    """Return the angular velocity from the work of the weights, I ω² / 2 = τ [rad/s]."""
    net = _net(p)
    return (1 if net > 0 else -1) * (2 * abs(net) / _inertia(p)) ** 0.5
