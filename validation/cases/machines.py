"""Machines: many parts at once."""

from collections.abc import Iterator
from functools import partial
from math import asin, cos, exp, pi, radians, sin, sqrt

from sandbox.model.expressions import Expression, Values
from sandbox.model.level import ContactEvent, CrossingEvent
from validation.case import SECOND_ORDER, Case, Choices, ends
from validation.formulas import energy, machines

G = 9.81  # m/s²
SECOND = "second order in the step"


def cases() -> Iterator[Case]:
    """Yield the cases of the machines."""
    yield from _car()
    yield from _trebuchet()
    yield from _capstan()
    yield from _wrecking_ball()
    yield from _seesaw()
    yield from _ladder()
    yield from _marble_run()


def _car() -> Iterator[Case]:
    level = "machines/car-over-bumps"
    for parameters in ({}, *ends(level, "x")):
        for axle, (name, at, tolerance) in (
            (axle, time)
            for axle in (0, 1)
            for time in (("before", "0.5/v", 1e-11), ("behind", "12/v", 1e-10))
        ):
            wheel = ("rear", "front")[axle]
            yield Case(
                name=f"car: what the {wheel} wheel carries {name} the bumps",
                level=level,
                parameters=parameters,
                quantity=f"{wheel}.contact.normal",
                at=Expression(at),
                expected=partial(_axle_load, axle),
                tolerance=tolerance,
                because="joints and contacts are solved together, to rounding; measured: 5e-12",
                naive_misses=1e-6,
            )


def _axle_load(axle: int, p: Values, _: object) -> float:
    weights = [(200.0, 0.0), (40.0, 0.8), (p["load"], p["x"]), (15.0, -1.1), (15.0, 1.1)]
    return machines.axle_loads([(G * m, x) for m, x in weights], (-1.1, 1.1))[axle]


def _trebuchet() -> Iterator[Case]:
    level = "machines/trebuchet"
    on_its_way = CrossingEvent(
        event="crossing", quantity="arm.angle", value=Expression("150*deg"), direction="down"
    )
    for parameters, duration in zip(({}, *ends(level, "m")), (0.7, 1.32, 0.57), strict=True):
        yield Case(
            name="trebuchet: how fast the arm turns on its way",
            level=level,
            parameters=parameters,
            quantity="arm.angular_velocity",
            at=on_its_way,
            duration=duration,
            expected=lambda p, _: _arm_spin(p, radians(150)),
            tolerance=1e-3,
            order=SECOND_ORDER,
            because="second order: (ω dt)² / 2 of an arm that turns by 5 rad/s; measured: 2.4e-4",
        )


HELD = 3.7 - 0.28j  # m, where the stone lies on the arm


def _arm_spin(p: Values, angle: float) -> float:
    return machines.trebuchet_spin(
        pi + radians(p["start"]),
        angle,
        (20.0, 50.0 + 20.0 * 1.5**2, 1.5),
        0.9,
        (p["M"], 0.9),
        (p["m"], HELD),
        G,
    )


def _capstan() -> Iterator[Case]:
    level = "machines/capstan"
    case = partial(Case, level=level)
    held: Choices = (
        {},
        {"load": 1.0, "mu": 0.1},
        {"load": 0.99 * exp(0.25 * pi)},
        {"load": 0.99 * exp(0.5 * pi), "mu": 0.5},
    )
    for parameters in held:
        yield case(
            name="capstan: what friction holds",
            parameters=parameters,
            quantity="large.position.y",
            expected=lambda _p, _t: -1.8,
            tolerance=5e-4,
            because="at 1 % above what it holds it would slip by 1.5 mm; measured: 0.5 mm",
            naive_misses=1e-2,
        )
    slips: Choices = (
        {"load": 6.0, "mu": 0.5},
        {"load": 6.0, "mu": 0.1},
        {"load": 1.01 * exp(0.25 * pi)},
        {"load": 1.02 * exp(0.5 * pi), "mu": 0.5},
    )
    for parameters in slips:
        yield case(
            name="capstan: how fast it slips",
            parameters=parameters,
            quantity="large.acceleration.y",
            at=Expression(0),
            expected=lambda p, _: -machines.capstan_acceleration(p["load"], p["mu"], 25, 1e-3, G),
            tolerance=1e-6,
            because="joints, contacts and friction are solved together; measured: 1e-8",
        )


def _wrecking_ball() -> Iterator[Case]:
    level = "machines/wrecking-ball"
    lowest = CrossingEvent(event="crossing", quantity="ball.position.x", direction="up")
    for parameters in ({}, *ends(level, "M")):
        case = partial(
            Case,
            level=level,
            parameters=parameters,
            at=lowest,
            duration=1.25,
            order=SECOND_ORDER,
        )
        yield case(
            name="wrecking ball: its speed before the blow",
            quantity="ball.speed",
            expected=lambda p, _: energy.landing_speed(0.0, G, _drop(p)),
            tolerance=3e-5,
            because=SECOND,
        )
        yield case(
            name="wrecking ball: the pull of its cable then",
            quantity="cable.tension",
            expected=lambda p, _: p["M"] * (G + 2 * G * _drop(p) / 4.5),
            tolerance=3e-5,
            because=SECOND,
        )


def _drop(p: Values) -> float:
    return 4.5 * (1 - cos(radians(p["angle"])))


AT, SHOT = -1.5 + 0.33j, 1.7 + 0.28j  # m, weight and ball on the plank


def _seesaw() -> Iterator[Case]:
    level = "machines/seesaw"
    for parameters in ({}, *ends(level, "ball")):
        case = partial(Case, level=level, parameters=parameters)
        yield case(
            name="seesaw: how fast the plank turns after the blow",
            quantity="plank.angular_velocity",
            at=ContactEvent(event="contact", bodies=("weight", "plank")),
            expected=lambda p, _: _struck(p),
            tolerance=1e-3,
            because="first order: the rest of the step in which the blow falls",
        )


def _struck(p: Values) -> float:
    moments = 18.0 + p["m"] * AT.real**2 + p["ball"] * abs(SHOT) ** 2
    return machines.struck_spin(p["m"] * sqrt(2 * G * p["h"]), -AT.real, moments)


def _ladder() -> Iterator[Case]:
    level = "machines/sliding-ladder"
    for parameters in ({}, *ends(level, "L")):
        case = partial(Case, level=level, parameters=parameters)
        yield case(
            name="ladder: push of the wall on the way",
            quantity="wall.contact.normal",
            at=_lying("pi - asin(5/6*sin(angle*deg))"),
            expected=lambda p, _: machines.ladder_push(
                radians(p["angle"]), asin(5 / 6 * sin(radians(p["angle"]))), 12.0, p["L"], p["g"]
            ),
            tolerance=1e-3,
            because="a force is that of the middle of its kick, and the way to it a line: 5e-4",
            naive_misses=2e-3,
        )
        yield case(
            name="ladder: it goes on at the speed at which it left the wall",
            quantity="ladder.velocity.x",
            at=_lying("pi - 0.1"),
            expected=lambda p, _: machines.ladder_drift(radians(p["angle"]), p["L"], p["g"]),
            tolerance=1e-3,
            because="the push that ends within a step is that of its beginning",
        )
        yield case(
            name="ladder: how fast it falls flat",
            quantity="ladder.angular_velocity",
            at=_lying("pi - 0.1"),
            expected=lambda p, _: machines.fallen_ladder_spin(
                radians(p["angle"]), 0.1, p["L"], p["g"]
            ),
            tolerance=1e-3,
            because=SECOND,
        )


def _lying(angle: str) -> CrossingEvent:
    return CrossingEvent(
        event="crossing", quantity="ladder.angle", value=Expression(angle), direction="up"
    )


def _marble_run() -> Iterator[Case]:
    level = "machines/marble-run"
    crossing = partial(CrossingEvent, event="crossing", quantity="marble.position.x")
    places = (("bottom", 0.0, crossing(direction="up")), ("top", pi, crossing(direction="down")))
    for parameters in ({}, *ends(level, "R")):
        for name, turned, at in places:
            case = partial(Case, level=level, parameters=parameters, at=at, order=SECOND_ORDER)
            yield case(
                name=f"marble run: speed at the {name}",
                quantity="marble.speed",
                expected=partial(_marble_speed, turned),
                tolerance=1e-4,
                because=SECOND,
            )
            yield case(
                name=f"marble run: force of the wire at the {name}",
                quantity="run.tension",
                expected=partial(_wire_force, turned),
                tolerance=1e-3,
                because=SECOND,
            )


def _marble_speed(turned: float, p: Values, _: object) -> float:
    start = machines.spiral(p["R"], 0.12, -radians(p["start"]))
    return energy.landing_speed(0.0, p["g"], (start - machines.spiral(p["R"], 0.12, turned)).imag)


def _wire_force(turned: float, p: Values, _: object) -> float:
    return machines.spiral_force(0.5, p["R"], 0.12, -radians(p["start"]), turned, p["g"])
