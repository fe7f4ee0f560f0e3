"""Fourth order where all forces are smooth: of three substeps the middle one goes back in time."""

from math import log2, pi, sqrt

import numpy as np
import pytest

from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Array
from sandbox.model.level import Level, Stepping
from sandbox.physics.snapshot import Snapshot
from sandbox.physics.world import build
from tests.physics.scenes import GRAVITY, G, Spec, disc, fixed, floor, level, orbit, run, worst

YOSHIDA = Stepping(scheme="yoshida")
PEG = fixed({"type": "disc", "radius": 0.1})
STICK = {"shape": {"type": "box", "width": 2, "height": 0.1}, "mass": 1}


def ends(scene: Level, rate: int, duration: float = 2) -> Snapshot:
    """Return the state at the end of a run."""
    stepping = Stepping(rate=rate, scheme="yoshida")
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
        {"stick": {**STICK, "angular_velocity": 1}},
        {"rotation": {}, "force": [{"body": "stick", "force": [2, 0], "frame": "body"}]},
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", SCENES)
def test_places_and_velocities_are_of_fourth_order(name: str) -> None:
    """Each halving of the step leaves a sixteenth of the error: 16 to 4 are 3 in the ratio 15."""
    coarse, middle, fine = (ends(SCENES[name], rate) for rate in (60, 120, 240))

    fields = ["position", "velocity", "acceleration"]
    for field in fields[:2] if "turns with" in name else fields:  # a steady turn is exact
        first = np.abs(getattr(coarse, field) - getattr(middle, field)).max()
        second = np.abs(getattr(middle, field) - getattr(fine, field)).max()
        assert log2(first / second) == pytest.approx(4, abs=0.15), field  # 3.93 to 4.04


@pytest.mark.parametrize(("step", "error"), [(0.02, 2.7e-4), (0.01, 1.7e-5), (0.005, 1.1e-6)])
def test_an_eccentric_orbit_closes_after_five_turns(step: float, error: float) -> None:
    """e = 0.5, semi-major axis 1, mu 1; the error is that of the place, of leapfrog 330 to 5200
    times as large."""
    steps = round(10 * pi / step)
    rate = steps / (10 * pi)
    scene = orbit(sqrt(1.5 * 8), rate, "yoshida", mu=8.0)  # a = 2 m, period 2π s

    off = np.hypot(*(build(scene).advance(steps).position[0] - [1, 0])) / 2

    assert off == pytest.approx(error, rel=0.05)


def test_symplectic_euler_needs_more_than_twenty_times_the_kicks() -> None:
    """For 1e-6 m after two seconds: three kicks a step at 150 Hz are enough."""

    def place(rate: int, scheme: str) -> Array:
        return build(orbit(sqrt(12), rate, scheme, mu=8.0)).advance(2 * rate).position[0]

    exact = place(3000, "yoshida")

    assert np.hypot(*(place(150, "yoshida") - exact)) < 1e-6  # 4.4e-7 m
    assert np.hypot(*(place(3 * 150 * 20, "symplectic-euler") - exact)) > 1e-4  # 9e-4 m


def test_what_falls_freely_is_exact() -> None:
    scene = level({"ball": disc(velocity=[3, 8])}, GRAVITY)
    flight = run(build(scene, stepping=YOSHIDA), 120)

    assert worst(flight.position[:, 0, 1], 8 * flight.t - G * flight.t**2 / 2) <= 1e-13
    assert worst(flight.velocity[:, 0, 1], 8 - G * flight.t) <= 1e-13
    assert worst(flight.acceleration[:, 0, 1], -G) <= 1e-12


def test_a_run_is_the_same_however_it_is_observed() -> None:
    scene = SCENES["spring pendulum"]
    one, many, bare = (build(scene, stepping=YOSHIDA) for _ in range(3))
    for _ in range(50):
        one.advance()
        bare.step()
    bare.advance()
    one.advance()
    many.advance(51)

    assert np.array_equal(one.snapshot.position, many.snapshot.position)
    assert np.array_equal(one.snapshot.velocity, many.snapshot.velocity)
    assert np.array_equal(one.snapshot.position, bare.snapshot.position)


def test_a_step_is_three_substeps() -> None:
    assert build(orbit(1.0)).hooks == 1
    assert build(orbit(1.0), stepping=YOSHIDA).hooks == 3


def test_an_orbit_keeps_its_energy_for_a_hundred_turns() -> None:
    flight = run(build(orbit(1.1, 20, "yoshida")), int(200 * pi * 20))
    place, speed = (np.hypot(*getattr(flight, f)[:, 0].T) for f in ("position", "velocity"))
    energy = speed**2 / 2 - 1 / place

    off = np.abs(energy - energy[0])

    assert off.max() <= 5e-7  # 4.7e-7
    assert off[-1000:].max() == pytest.approx(off[:1000].max(), rel=0.05)


def test_a_hand_can_take_hold() -> None:
    """No hand pulls backwards in time: what is held goes on with leapfrog."""
    world = build(orbit(1.0), stepping=YOSHIDA)
    world.advance(60)
    place = world.snapshot.position.copy()
    world.grab("planet", (float(place[0, 0]), float(place[0, 1])))
    world.drag((2.0, 2.0))
    world.advance(240)

    assert np.hypot(*(world.snapshot.position[0] - [2, 2])) < 0.1


def test_a_spring_may_be_less_stiff_than_for_leapfrog() -> None:
    """Stable up to ω h = 1.573, where the trace of a step's matrix leaves −2 to 2."""
    scene = level(
        {"ball": disc((1.001, 0)), "peg": PEG}, {}, joints={"s": spring(stiffness=3600)}
    )  # ω = 60 /s
    swings = run(build(scene, stepping=Stepping(rate=60, scheme="yoshida")), 2000)

    assert np.abs(swings.position[:, 0, 0] - 1).max() < 0.0011  # 0.001 m at the start
    assert build(scene, stepping=Stepping(rate=39, scheme="yoshida")).t == 0
    with pytest.raises(SandboxError, match="at least 39, not 38"):
        build(scene, stepping=Stepping(rate=38, scheme="yoshida"))
    assert build(scene, stepping=Stepping(rate=38)).t == 0


DAMPED = {"damped": spring(damping=1), "lets go": spring(pushes_only=True)}


@pytest.mark.parametrize(
    ("effects", "joints", "told"),
    [
        ({**GRAVITY, "drag": {"linear": 1}}, {}, "the effect 'drag'"),
        ({**GRAVITY, "contact": {}}, {}, "the effect 'contact'"),
        (GRAVITY, {"r": {"type": "rod", "ends": ["peg", "ball"]}}, "the rod 'r', which holds"),
        (GRAVITY, {"s": DAMPED["damped"]}, "the damping of 's'"),
        (GRAVITY, {"s": DAMPED["lets go"]}, "that 's' lets go"),
    ],
)
def test_what_is_not_smooth_refuses_it_by_name(effects: Spec, joints: Spec, told: str) -> None:
    bodies = {"ball": disc((1.2, 0)), "peg": PEG, "floor": floor(-9)}
    scene = level(bodies, effects, joints=joints)

    with pytest.raises(SandboxError, match=told):
        level(bodies, effects, joints=joints, stepping={"scheme": "yoshida"})
    with pytest.raises(SandboxError, match=told):
        build(scene, stepping=YOSHIDA)
