"""Fourth order where all forces are smooth: a step of several drifts, some back in time."""

from itertools import pairwise
from math import cos, log2, pi, sin, sqrt

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipk

from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Array
from sandbox.model.level import Level, Scheme, Stepping
from sandbox.physics.measuring.interpolation_between_steps import crossing
from sandbox.physics.run import build
from sandbox.physics.state.snapshot import Snapshot
from tests.physics.scenes import GRAVITY, G, Spec, disc, fixed, floor, level, orbit, run, worst

FOURTH = Stepping(scheme="fourth-order")
PEG = fixed({"type": "disc", "radius": 0.1})
STICK = {"shape": {"type": "box", "width": 2, "height": 0.1}, "mass": 1}


def ends(scene: Level, rate: int, duration: float = 2, scheme: Scheme = "fourth-order") -> Snapshot:
    """Return the state at the end of a run."""
    stepping = Stepping(rate=rate, scheme=scheme)
    return build(scene, stepping=stepping).advance(round(duration * rate))


def spring(**rest: object) -> Spec:
    return {"type": "spring", "ends": ["peg", "ball"], "stiffness": 20, "length": 1, **rest}


SCENES = {
    "two stars": level(
        {"a": disc((1, 0), velocity=[0, 1.4]), "b": disc((-1, 0), mass=2, velocity=[0, -0.7])},
        {"gravitation": {"constant": 4}},
    ),
    "spring pendulum": level(
        {"ball": disc((1.2, 0)), "peg": PEG}, GRAVITY, joints={"s": spring()}
    ),
    "stick that turns on springs": level(
        {"stick": {**STICK, "angle": 0.4}, "peg": PEG},
        {**GRAVITY, "rotation": {}},
        joints={
            "s": spring(ends=[[-1, 1], {"body": "stick", "at": [-1, 0]}]),
            "r": spring(ends=[[1.5, 1], {"body": "stick", "at": [1, 0]}], stiffness=30),
        },
    ),
    "driven spring": level(
        {"ball": disc((1.2, 0)), "peg": PEG},
        {"force": [{"body": "ball", "force": ["3*cos(2*t)", "sin(t)"]}]},
        joints={"s": spring()},
    ),
    "force that turns with its body": level(
        {"stick": {**STICK, "angular_velocity": 5}},
        {"rotation": {}, "force": [{"body": "stick", "force": [2, 0], "frame": "body"}]},
    ),
}  # fmt: skip

WAVE = {"type": "wire", "bead": "bead", "curve": ["s", "0.2*sin(3*s) - s"], "s": [-1, 9]}
BEADS = {
    "bead on a wave": level({"bead": disc()}, GRAVITY, joints={"w": WAVE}),
    "bead on a spring": level(
        {"bead": disc()},
        GRAVITY,
        joints={"w": WAVE, "s": spring(ends=[[0, -2], "bead"], stiffness=2)},
    ),
    "two beads": level(
        {"bead": disc(), "other": disc((2, 0.2), velocity=[0.3, 0])},
        GRAVITY,
        joints={
            "w": WAVE,
            "v": {"type": "wire", "bead": "other", "curve": ["s", "0.05*s**2"], "s": [-3, 3]},
            "s": spring(ends=["bead", "other"]),
        },
    ),
}


PIN = {"type": "pivot", "ends": [[0, 0], {"body": "stick", "at": [-1, 0]}]}
SPUN: Spec = {**GRAVITY, "rotation": {}}
HELD = {
    "pendulum": level(
        {"bob": disc((sin(0.5), -cos(0.5)))},
        GRAVITY,
        joints={"rod": {"type": "rod", "ends": [[0, 0], "bob"]}},
    ),
    "two rods": level(
        {"a": disc((1, 0)), "b": disc((1.5, 0))},
        GRAVITY,
        joints={
            "upper": {"type": "rod", "ends": [[0, 0], "a"]},
            "lower": {"type": "rod", "ends": ["a", "b"]},
        },
    ),
    "stick on a pin": level({"stick": {**STICK, "position": [1, 0]}}, SPUN, joints={"p": PIN}),
    "weight welded to a stick": level(
        {"stick": {**STICK, "position": [1, 0]}, "weight": disc((2, 0), mass=2)},
        SPUN,
        joints={"p": PIN, "w": {"type": "weld", "ends": ["stick", "weight"]}},
    ),
    "cart with a pendulum": level(
        {"cart": disc(), "bob": disc((1, 0), mass=2)},
        GRAVITY,
        joints={
            "rail": {"type": "rail", "ends": [[0, 0], "cart"], "direction": [1, 0]},
            "rod": {"type": "rod", "ends": ["cart", "bob"]},
        },
    ),
}


@pytest.mark.sweep
@pytest.mark.parametrize("name", SCENES)
def test_places_and_velocities_are_of_fourth_order(name: str) -> None:
    """Each halving of the step leaves a sixteenth of the error: 16 to 4 are 3 in the ratio 15."""
    coarse, middle, fine = (ends(SCENES[name], rate) for rate in (60, 120, 240))

    fields = ["position", "velocity", "acceleration"]
    for field in fields[:2] if "turns with" in name else fields:  # a steady turn is exact
        first = np.abs(getattr(coarse, field) - getattr(middle, field)).max()
        second = np.abs(getattr(middle, field) - getattr(fine, field)).max()
        assert log2(first / second) == pytest.approx(4, abs=0.15), field  # 3.93 to 4.04


@pytest.mark.sweep
@pytest.mark.parametrize("name", [*BEADS, *HELD])
def test_what_joints_hold_is_of_fourth_order_too(name: str) -> None:
    """So are the forces with which they hold it, which leapfrog gives as means over a kick."""
    rates = (120, 240, 480) if name in BEADS else (60, 120, 240)
    coarse, middle, fine = (ends({**BEADS, **HELD}[name], rate, 1) for rate in rates)

    for field in ("position", "velocity", "acceleration", "tension"):
        first = np.abs(getattr(coarse, field) - getattr(middle, field)).max()
        second = np.abs(getattr(middle, field) - getattr(fine, field)).max()
        assert log2(first / second) == pytest.approx(4, abs=0.15), field  # 3.98 to 4.02


@pytest.mark.sweep
@pytest.mark.parametrize(
    ("scheme", "rate", "least", "most"),
    [("fourth-order", 15, 0, 7e-8), ("leapfrog", 90, 1e-5, 1e-4)],
)
def test_a_needle_swings_as_long_as_the_elliptic_integral_says(
    scheme: Scheme, rate: int, least: float, most: float
) -> None:
    """0.5 rad, 50 s, 25 swings: 2.3e-8 of the period; leapfrog by as many kicks 5e-5."""
    force = [
        {"body": "needle", "force": [0, -G], "at": [0, -1]},
        {"body": "needle", "force": [0, G]},
    ]
    needle = {**STICK, "moment": 1, "angle": 0.5}
    scene = level({"needle": needle}, {"rotation": {}, "force": force})
    flight = run(build(scene, stepping=Stepping(rate=rate, scheme=scheme)), 50 * rate)
    angle, late = flight.angle[:, 0], flight.t > 48.5
    swing = 4 / sqrt(G) * ellipk(sin(0.25) ** 2)

    last = crossing(flight.t[late], angle[late], 0.0, "down", smooth=4)

    assert last is not None
    assert least < abs(last / swing / 24.25 - 1) < most


@pytest.mark.sweep
def test_two_rods_swing_as_the_equations_of_motion_say() -> None:
    """Beside DOP853 after 2 s at 60, 120 and 240 Hz: 1.8e-5, 1.1e-6, 7e-8 m."""

    def slopes(_: float, y: Array) -> Array:
        a, b, u, v = y
        c, s = cos(a - b), sin(a - b)
        sides = (-s * v * v / 2 - 2 * G * sin(a), s * u * u - G * sin(b))
        return np.array([u, v, *np.linalg.solve([[2, c / 2], [c, 1 / 2]], sides)])

    start = (pi / 2, pi / 2, 0, 0)
    a, b = solve_ivp(slopes, (0, 2), start, "DOP853", rtol=1e-12, atol=1e-12).y[:2, -1]
    there = np.array([sin(a) + sin(b) / 2, -cos(a) - cos(b) / 2])

    def off(rate: int, scheme: Scheme = "fourth-order") -> float:
        world = build(HELD["two rods"], stepping=Stepping(rate=rate, scheme=scheme))
        return float(np.hypot(*(world.advance(2 * rate).position[1] - there)))

    errors = [off(rate) for rate in (60, 120, 240)]

    assert errors[0] < 2e-5
    assert [log2(x / y) for x, y in pairwise(errors)] == pytest.approx([4, 4], abs=0.1)
    assert off(300, "leapfrog") > 10 * errors[0]  # as many kicks as at 60 Hz


@pytest.mark.sweep
def test_a_bead_keeps_its_energy_to_the_fourth_order() -> None:
    """On a wave that it runs down at up to 6.6 m/s: 1.7e-9 and 1.1e-10, leapfrog 1.6e-6."""
    errors = []
    for scheme, rate in (("leapfrog", 960), ("fourth-order", 480), ("fourth-order", 960)):
        world = build(BEADS["bead on a wave"], stepping=Stepping(rate=rate, scheme=scheme))  # type: ignore[arg-type]
        flight = run(world, int(1.3 * rate))
        energy = (flight.velocity**2).sum(axis=-1)[:, 0] / 2 + G * flight.position[:, 0, 1]
        errors.append(float(np.abs(energy - energy[0]).max() / (flight.velocity**2).max()))
    leapfrog, coarse, fine = errors

    assert leapfrog > 20 * fine
    assert log2(coarse / fine) == pytest.approx(4, abs=0.3)


@pytest.mark.sweep
@pytest.mark.parametrize(("step", "error"), [(0.04, 3.6e-7), (0.02, 2.7e-8), (0.01, 1.8e-9)])
def test_an_eccentric_orbit_closes_after_five_turns(step: float, error: float) -> None:
    """e = 0.5, semi-major axis 1, mu 1; the error is that of the place, of leapfrog a million times
    as large."""
    steps = round(10 * pi / step)
    rate = steps / (10 * pi)
    scene = orbit(sqrt(1.5 * 8), rate, "fourth-order", mu=8.0)  # a = 2 m, period 2π s

    off = np.hypot(*(build(scene).advance(steps).position[0] - [1, 0])) / 2

    assert off == pytest.approx(error, rel=0.05)


@pytest.mark.sweep
def test_symplectic_euler_needs_more_than_twenty_times_the_kicks() -> None:
    """For 1e-6 m after two seconds: six kicks a step at 30 Hz are more than enough."""

    def place(rate: int, scheme: str) -> Array:
        return build(orbit(sqrt(12), rate, scheme, mu=8.0)).advance(2 * rate).position[0]

    exact = place(600, "fourth-order")

    assert np.hypot(*(place(30, "fourth-order") - exact)) < 1e-8  # 7e-9 m
    assert np.hypot(*(place(6 * 30 * 20, "symplectic-euler") - exact)) > 1e-3  # 2.3e-3 m


def test_what_falls_freely_is_exact() -> None:
    scene = level({"ball": disc(velocity=[3, 8])}, GRAVITY)
    flight = run(build(scene, stepping=FOURTH), 120)

    assert worst(flight.position[:, 0, 1], 8 * flight.t - G * flight.t**2 / 2) <= 1e-13
    assert worst(flight.velocity[:, 0, 1], 8 - G * flight.t) <= 1e-13
    assert worst(flight.acceleration[:, 0, 1], -G) <= 1e-12


def test_a_run_is_the_same_however_it_is_observed() -> None:
    scene = SCENES["spring pendulum"]
    one, many, bare = (build(scene, stepping=FOURTH) for _ in range(3))
    for _ in range(50):
        one.advance()
        bare.step()
    bare.advance()
    one.advance()
    many.advance(51)

    assert np.array_equal(one.snapshot.position, many.snapshot.position)
    assert np.array_equal(one.snapshot.velocity, many.snapshot.velocity)
    assert np.array_equal(one.snapshot.position, bare.snapshot.position)


def test_a_step_is_six_kicks_or_five_where_joints_hold() -> None:
    pendulum = HELD["pendulum"]

    assert build(orbit(1.0)).hooks == build(pendulum).hooks == 1
    assert build(orbit(1.0), stepping=FOURTH).hooks == 6
    assert build(pendulum, stepping=FOURTH).hooks == 5


@pytest.mark.sweep
def test_an_orbit_keeps_its_energy_for_a_hundred_turns() -> None:
    flight = run(build(orbit(1.1, 6, "fourth-order")), int(200 * pi * 6))
    place, speed = (np.hypot(*getattr(flight, f)[:, 0].T) for f in ("position", "velocity"))
    energy = speed**2 / 2 - 1 / place

    off = np.abs(energy - energy[0])

    assert off.max() <= 2e-9  # 1.7e-9
    assert off[-600:].max() == pytest.approx(off[:600].max(), rel=0.05)


@pytest.mark.sweep
def test_a_pendulum_keeps_its_energy_for_ten_durations() -> None:
    """No more is gone in the last swings than in the first: 7.5e-8 J, leapfrog 3.5e-5 J."""

    def lost(scheme: Scheme, rate: int) -> Array:
        flight = run(
            build(HELD["pendulum"], stepping=Stepping(rate=rate, scheme=scheme)), 20 * rate
        )
        energy: Array = (flight.velocity[:, 0] ** 2).sum(axis=-1) / 2 + G * flight.position[:, 0, 1]
        return np.abs(energy - energy[0])

    leapfrog, off = lost("leapfrog", 300), lost("fourth-order", 60)

    assert off.max() < leapfrog.max() / 400
    assert off[-120:].max() == pytest.approx(off[:120].max(), rel=0.01)


def test_a_hand_can_take_hold() -> None:
    """No hand pulls backwards in time: what is held goes on with leapfrog."""
    world = build(orbit(1.0), stepping=FOURTH)
    world.advance(60)
    place = world.snapshot.position.copy()
    world.grab("planet", (float(place[0, 0]), float(place[0, 1])))
    world.drag((2.0, 2.0))
    world.advance(240)

    assert np.hypot(*(world.snapshot.position[0] - [2, 2])) < 0.1


def test_a_hand_needs_a_rate_that_is_high_enough_for_leapfrog() -> None:
    """The scene stays as it is; taken hold of all the same, its ball is at 1e63 m after 2 s."""
    scene = level({"ball": disc((1.1, 0)), "peg": PEG}, {}, joints={"s": spring(stiffness=900)})
    world = build(scene, stepping=Stepping(rate=14, scheme="fourth-order"))
    world.advance(10)

    with pytest.raises(SandboxError, match="'s' needs a 'rate' of at least 15, not 14"):
        world.grab("ball", (1.0, 0.0))

    assert world.kicks.composed
    assert not world.disturbed


@pytest.mark.sweep
def test_a_spring_may_be_less_stiff_than_for_leapfrog() -> None:
    """Stable up to ω h = 3.163, where the trace of a step's matrix leaves −2 to 2."""
    scene = level(
        {"ball": disc((1.001, 0)), "peg": PEG}, {}, joints={"s": spring(stiffness=3600)}
    )  # ω = 60 /s
    swings = run(build(scene, stepping=Stepping(rate=29, scheme="fourth-order")), 2000)

    assert np.abs(swings.position[:, 0, 0] - 1).max() < 0.0011  # 0.001 m at the start
    assert build(scene, stepping=Stepping(rate=19, scheme="fourth-order")).t == 0
    with pytest.raises(SandboxError, match="at least 19, not 18"):
        build(scene, stepping=Stepping(rate=18, scheme="fourth-order"))
    with pytest.raises(SandboxError, match="at least 30, not 29"):
        build(scene, stepping=Stepping(rate=29))


ROD: Spec = {"type": "rod", "ends": ["peg", "ball"]}
MOTOR: Spec = {"type": "motor", "ends": [[1.2, 0], "ball"]}
DAMPED = {"damped": spring(damping=1), "lets go": spring(pushes_only=True)}


@pytest.mark.parametrize(
    ("effects", "joints", "told"),
    [
        ({**GRAVITY, "drag": {"linear": 1}}, {}, "the effect 'drag'"),
        ({**GRAVITY, "contact": {}}, {}, "the effect 'contact'"),
        (GRAVITY, {"r": {"type": "rope", "ends": ["peg", "ball"]}}, "the rope 'r', which can go"),
        (GRAVITY, {"r": {**ROD, "exact": False}}, "the rod 'r', which is pymunk's own"),
        (GRAVITY, {"r": {**ROD, "length": "1.2 + t"}}, "'r', whose length changes"),
        ({**GRAVITY, "rotation": {}}, {"r": {**MOTOR, "rate": 1}}, "the motor 'r'"),
        (GRAVITY, {"s": DAMPED["damped"]}, "the damping of 's'"),
        (GRAVITY, {"s": DAMPED["lets go"]}, "'s', which lets go"),
    ],
)
def test_what_is_not_smooth_refuses_it_by_name(effects: Spec, joints: Spec, told: str) -> None:
    bodies = {"ball": disc((1.2, 0)), "peg": PEG, "floor": floor(-9)}
    scene = level(bodies, effects, joints=joints)

    with pytest.raises(SandboxError, match=told):
        level(bodies, effects, joints=joints, stepping={"scheme": "fourth-order"})
    with pytest.raises(SandboxError, match=told):
        build(scene, stepping=FOURTH)
