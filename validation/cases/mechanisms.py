"""Linkages, a crane and a ragdoll: kinematics, virtual work, statics, and what any fall keeps."""

from collections.abc import Callable, Iterator, Mapping
from functools import partial

import numpy as np

from sandbox.model.expressions import Array, Expression, Values
from validation.case import SECOND_ORDER, Case, Choices, Expected, Parameters, ends
from validation.formulas import mechanisms, rotation

G = 9.81  # m/s²
PINS = ("shoulder", "elbow", "hip", "knee")
AIR = 0.1  # s, before any part of the ragdoll touches
BODY = 68.0  # kg, the ragdoll

LIFTS: Choices = ({}, *ends("machines/crane"))
ENGINES: Choices = ({}, *ends("machines/engine", "r"))
WHEELS: Choices = ({}, *ends("machines/flywheel"))
SCISSORS: Choices = ({}, *ends("machines/scissor-lift", "T"))
BELTS: Choices = ({}, *ends("machines/belt-drive", "b"))
LINKAGES: Choices = ({}, *ends("machines/chebyshev-linkage"))
RAISED: tuple[tuple[Parameters, float], ...] = (
    ({}, 1.6),
    ({"M": 1200.0, "m": 400.0, "H": 7.0}, 0.9),
    ({"M": 1200.0, "m": 1500.0, "H": 7.0}, 1.5),
)
HELD: Choices = ({"M": 100.0, "m": 1500.0, "H": 4.6}, {"M": 300.0})
FALLS: Choices = ({}, *ends("machines/ragdoll"))

HALF_KICK = "the first kick looks a quarter of a step ahead, and forces grow from the start on"
SECOND = "second order: velocities are chords, forces the differences of such"
ROUNDING = "the geometry is solved at every step, to rounding"
RAMP = "the motor's angle is the sum of its rates, of second order as it starts"


def cases() -> Iterator[Case]:
    """Yield the cases of machines."""
    yield from _crane()
    yield from _engine()
    yield from _flywheel()
    yield from _scissor()
    yield from _chebyshev()
    yield from _belt()
    yield from _drawbridge()
    yield from _ragdoll()


def _crane() -> Iterator[Case]:
    expected: Mapping[str, Expected] = {
        "cable.tension": _cable,
        "stay.tension": _stay,
        "back_stay.tension": _back_stay,
        "left_foot.contact.normal": lambda p, t: _feet(p, t)[0],
        "right_foot.contact.normal": lambda p, t: _feet(p, t)[1],
    }
    for parameters in LIFTS:
        for quantity, formula in expected.items():
            still = quantity == "back_stay.tension"
            yield Case(
                name=f"crane: {quantity}",
                level="machines/crane",
                parameters=parameters,
                quantity=quantity,
                expected=formula,
                tolerance=1e-9 if still else 1e-3,
                because="at rest: rounding of places over the step squared" if still else HALF_KICK,
                naive_misses=0.5,
            )


def _rise(p: Values, t: Array) -> Array:
    """Return the acceleration of the crane's load [m/s²]: its speed is v sin² (π t / 3)."""
    return np.asarray(p["v"] * np.pi / 3 * np.sin(2 * np.pi * t / 3))


def _cable(p: Values, t: Array) -> Array:
    return p["m"] * (G + _rise(p, t))


def _stay(p: Values, t: Array) -> Array:
    """Return the tension of the stay [N]: beam, trolley, drum and cable about the jib's pin."""
    twist = rotation.round_moment(rotation.DISC, 40.0, 0.3) * _rise(p, t) / 0.3
    weights = G * (400 * 4 + (50 + 40) * (p["r"] - 0.4))
    torque = weights + _cable(p, t) * (p["r"] + 0.3 - 0.4) + twist
    return mechanisms.stay_tension(torque, 0.4 + 9j, 6.8 + 9j, 12j)


def _back_stay(p: Values, _: Array) -> Array:
    torque = G * (200 * 2 + p["C"] * 3.2)
    return mechanisms.stay_tension(torque, -0.4 + 9j, -3.6 + 9j, 12j)


def _feet(p: Values, t: Array) -> list[Array]:
    """Return what the two feet bear [N]: a couple of forces 1 m apart turns the drum."""
    parts = ((-2, 50), (2, 50), (0, 1800), (4.4, 400), (-2.4, 200), (-3.6, p["C"]), (p["r"], 90))
    twist = rotation.round_moment(rotation.DISC, 40.0, 0.3) * _rise(p, t) / 0.3
    weights = [(x, np.full_like(t, G * mass)) for x, mass in parts]
    moving = [(p["r"] + 0.3, _cable(p, t)), (1.0, twist), (0.0, -twist)]
    return mechanisms.supports([*weights, *moving], -2.0, 2.0)


def _engine() -> Iterator[Case]:
    for parameters in ENGINES:
        case = partial(Case, level="machines/engine", parameters=parameters)
        yield case(
            name="engine: place of the piston",
            quantity="piston.position.x",
            expected=lambda p, t: _piston(p, t).place,
            naive_misses=1e-6,
            tolerance=1e-12,
            because=ROUNDING,
        )
        yield case(
            name="engine: speed of the piston",
            quantity="piston.velocity.x",
            expected=lambda p, t: _piston(p, t).speed,
            naive_misses=2e-3,
            tolerance=1e-3,
            order=SECOND_ORDER,
            because=SECOND,
        )
        yield case(
            name="engine: acceleration of the piston",
            quantity="piston.acceleration.x",
            expected=lambda p, t: _piston(p, t).acceleration,
            tolerance=1e-3,
            order=SECOND_ORDER,
            because=SECOND,
        )
        yield case(
            name="engine: torque of the motor",
            quantity="motor.torque",
            expected=lambda p, t: mechanisms.engine_torque(
                _rate(p) * t, _rate(p), p["r"], p["l"], (1.0, p["m"])
            ),
            tolerance=1e-3,
            because=HALF_KICK,
        )


def _rate(p: Values) -> float:
    return float(p["rpm"] * np.pi / 30)


def _piston(p: Values, t: Array) -> mechanisms.Slider:
    return mechanisms.slider(_rate(p) * t, _rate(p), p["r"], p["l"])


def _flywheel() -> Iterator[Case]:
    for parameters in WHEELS:
        case = partial(Case, level="machines/flywheel", parameters=parameters)
        yield case(
            name="flywheel and piston: angle at every step",
            quantity="flywheel.angle",
            expected=lambda p, t: mechanisms.coasting_angle(
                t, _rate(p), _wheel(p), p["r"], 1.5, (1.0, p["m"])
            ),
            tolerance=2e-5,
            order=SECOND_ORDER,
            because=SECOND,
        )
        yield case(
            name="flywheel and piston: energy at every step",
            quantity="system.energy",
            expected=lambda p, _: rotation.rotational_energy(
                _wheel(p) + rotation.rod_moment(1.0, p["r"], p["r"] / 2), _rate(p)
            ),
            tolerance=2e-5,
            order=SECOND_ORDER,
            because="leapfrog's energy swings by (ω dt)² of its scale, and does not drift",
        )


def _wheel(p: Values) -> float:
    return rotation.round_moment(rotation.DISC, p["M"], p["r"] + 0.1)


def _scissor() -> Iterator[Case]:
    for parameters in SCISSORS:
        case = partial(Case, level="machines/scissor-lift", parameters=parameters)
        yield case(
            name="scissor lift: pull of the ram, at every step",
            quantity="ram.tension",
            expected=_ram,
            tolerance=5e-5,
            order=SECOND_ORDER,
            because=SECOND,
        )
        yield case(
            name="scissor lift: work of the ram, all told",
            quantity="system.work.joints",
            at=Expression("T + 0.4"),
            expected=lambda p, _: (
                G * (3 * (p["m"] + 20) + 90) * 2 * float(_sine(p, "high") - _sine(p, "low"))
            ),
            tolerance=2e-6,
            because="force times way, summed over the steps of an eased motion: 2e-7",
        )


def _sine(p: Values, name: str) -> float:
    return float(np.sin(np.radians(p[name])))


def _ram(p: Values, t: Array) -> Array:
    way, speed, change = mechanisms.eased(t / p["T"])
    wide, narrow = (2 * np.cos(np.radians(p[name])) for name in ("low", "high"))
    lift = mechanisms.Scissor(3, 2.0, 10.0, p["m"] + 20)
    less = narrow - wide
    return lift.force(wide + less * way, less * speed / p["T"], less * change / p["T"] ** 2, G)


def _chebyshev() -> Iterator[Case]:
    parts: Mapping[str, Callable[[Array], Array]] = {"x": np.real, "y": np.imag}
    for parameters in LINKAGES:
        for foot, ahead in (("foot", np.pi), ("other_foot", 0.0)):
            for axis, part in parts.items():
                yield Case(
                    name=f"Chebyshev's linkage: {axis} of the {foot.replace('_', ' ')}",
                    level="machines/chebyshev-linkage",
                    parameters=parameters,
                    quantity=f"{foot}.position.{axis}",
                    expected=partial(_foot, ahead, part),
                    tolerance=1e-5,
                    order=SECOND_ORDER,
                    because=RAMP,
                )


def _foot(ahead: float, part: Callable[[Array], Array], p: Values, t: Array) -> Array:
    """Return where a foot is: the motor has turned by ∫ ω (1 − e^(−3 t)) dt."""
    turned = _rate(p) * (t + np.expm1(-3 * t) / 3)
    return part(mechanisms.chebyshev_foot(ahead + turned, p["a"]))


def _belt() -> Iterator[Case]:
    for parameters in BELTS:
        case = partial(Case, level="machines/belt-drive", parameters=parameters)
        yield case(
            name="belt: how far it turns the other wheel",
            quantity="driven.angle",
            expected=lambda p, t: p["a"] / p["b"] * p["w"] * (t + np.expm1(-3 * t) / 3),
            tolerance=3e-6,
            order=SECOND_ORDER,
            because=RAMP,
        )
        for quantity, row in (("upper_right.tension", 0), ("lower_right.tension", 1)):
            yield case(
                name=f"belt: {quantity}",
                quantity=quantity,
                expected=partial(_tension, row),
                tolerance=3e-4,
                because=HALF_KICK,
            )
        yield case(
            name="belt: torque of the motor",
            quantity="motor.torque",
            expected=partial(_tension, 2),
            tolerance=1e-3,
            because="the same: 3 dt / 4 of what speeds it up, which dies away as e^(−3 t)",
        )


def _tension(row: int, p: Values, t: Array) -> Array:
    """Return a side of the belt, or the motor's torque; two marks of 20 g go with it."""
    grows = 3 * p["w"] * np.exp(-3 * t)
    wheel = rotation.round_moment(rotation.DISC, 2.0, p["b"]) * grows * p["a"] / p["b"]
    driver = rotation.round_moment(rotation.DISC, 2.0, p["a"]) * grows
    marks = rotation.round_moment(rotation.HOOP, 0.04, p["a"]) * grows
    return mechanisms.belt(
        p["torque"] + wheel, 300.0, (p["a"], p["b"]), 4.0, at_driver=driver + marks
    )[row]


def _drawbridge() -> Iterator[Case]:
    case = partial(Case, level="machines/drawbridge")
    for parameters, duration in RAISED:
        yield case(
            name="drawbridge: its angle as it rises",
            parameters=parameters,
            duration=duration,
            quantity="bridge.angle",
            expected=lambda p, t: mechanisms.bridge_angle(t, 4.0, p["H"], p["m"], p["M"], G),
            naive_misses=2e-3,
            tolerance=1e-5,
            order=SECOND_ORDER,
            because=SECOND,
        )
    for parameters in HELD:
        yield case(
            name="drawbridge: what the far bank bears",
            parameters=parameters,
            quantity="bridge.contact.normal",
            expected=lambda p, _: mechanisms.supports(
                [(2.0, p["m"] * G), (4.0, -p["M"] * G * p["H"] / abs(4 + 1j * p["H"]))], 0.0, 3.8
            )[1],
            naive_misses=0.1,
            tolerance=1e-9,
            because="at rest: rounding of places over the step squared",
        )


def _ragdoll() -> Iterator[Case]:
    pins = (*(f"{side}_{pin}" for side in ("left", "right") for pin in PINS), "neck")
    for parameters in FALLS:
        case = partial(Case, level="machines/ragdoll", parameters=parameters)
        for pin in pins:
            yield case(
                name=f"ragdoll: the {pin.replace('_', ' ')} holds",
                quantity=f"{pin}.length",
                expected=lambda _p, _t: 0.0,
                tolerance=1e-9,
                because="exact joints hold at position level, whatever hits them: 7e-13",
                naive_misses=1e-3,
            )
        yield case(
            name="ragdoll: momentum along, in the air",
            duration=AIR,
            quantity="system.momentum.x",
            expected=lambda p, _: BODY * p["push"],
            tolerance=1e-12,
            because="nothing acts along, and pins only pass on: rounding",
        )
        yield case(
            name="ragdoll: momentum upwards, in the air",
            duration=AIR,
            quantity="system.momentum.y",
            expected=lambda _, t: -BODY * G * t,
            tolerance=1e-12,
            because="the weight of all its parts: rounding",
        )
