"""Beads on wires: they stay on them, keep their energy, and are told when they cannot."""

from math import cos, log2, pi, sin, sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sandbox.model.level import Level
from sandbox.physics.measuring.interpolation_between_steps import crossing
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.stepping.world import World
from tests.physics.scenes import GRAVITY, G, Spec, disc, level, measured, worst

R = 0.5
"""m, of the circle that rolls out the cycloids."""


def wire(x: str, y: str, first: float, last: float, bead: object = "bead") -> Spec:
    return {"type": "wire", "bead": bead, "curve": [x, y], "s": [first, last]}


def on_hoop(angle: float, rate: float = 60, speed: float = 0) -> Level:
    """A bead of 2 kg on a hoop of a metre, at an angle from its lowest point."""
    return level(
        {"bead": disc((sin(angle), -cos(angle)), mass=2, velocity=[speed, 0])},
        GRAVITY,
        joints={"arm": wire("sin(s)", "-cos(s)", -pi, pi)},
        stepping={"rate": rate},
    )


def on_cycloid(angle: float, rate: float = 60) -> Level:
    start = R * (angle + sin(angle)), -R * (1 + cos(angle))
    joints = {"wire": wire(f"{R}*(s + sin(s))", f"-{R}*(1 + cos(s))", -3, 3)}
    return level({"bead": disc(start)}, GRAVITY, joints=joints, stepping={"rate": rate})


def quarter(angle: float, rate: float) -> float:
    """Return the time to the lowest point of a cycloid [s]."""
    found = measured(build(on_cycloid(angle, rate)), round(rate), "bead.position.x", "t")
    passed = crossing(found["t"], found["bead.position.x"], 0.0, "down")
    assert passed is not None
    return passed


def test_a_bead_on_a_hoop_is_a_pendulum() -> None:
    """The same equation, solved on a spline and as a length: they differ by rounding."""
    names = "bead.position.x", "bead.position.y", "bead.energy", "arm.tension"
    pendulum = level(
        {"bead": disc((sin(1.5), -cos(1.5)), mass=2)},
        GRAVITY,
        joints={"arm": {"type": "rod", "ends": [[0, 0], "bead"]}},
    )
    ours, rod = (measured(build(scene), 600, *names) for scene in (on_hoop(1.5), pendulum))

    for name in names:
        assert worst(ours[name], rod[name]) <= 1e-10  # 1e-12
    distance = np.hypot(ours["bead.position.x"], ours["bead.position.y"])
    assert worst(distance, 1.0) <= 1e-14  # 7e-16


@pytest.mark.sweep
def test_a_closed_wire_has_no_seam() -> None:
    """Twenty times around, over the place where its description begins and ends."""
    found = measured(build(on_hoop(0, 480, 8)), 480 * 20, "bead.energy", "arm.tension")

    assert np.ptp(found["bead.energy"]) < 1e-2 * 64  # 5e-3
    assert found["arm.tension"].max() == pytest.approx(2 * (G + 64), rel=1e-3)


def test_the_wire_presses_inwards_at_the_bottom_and_at_the_top() -> None:
    """N = m (g cos θ + v²/r): its size, whichever way it points."""
    bottom, top = (abs(build(on_hoop(a)).snapshot.tension[0]) for a in (0, pi))

    assert bottom == pytest.approx(2 * G, rel=1e-9)
    assert top == pytest.approx(2 * G, rel=1e-9)


@pytest.mark.parametrize("angle", [0.1, 1.0, 2.0, 2.9])
def test_a_cycloid_takes_the_same_time_from_anywhere(angle: float) -> None:
    """Huygens's tautochrone: a quarter of its period is π √(R/g), to second order."""
    exact = pi * sqrt(R / G)

    assert quarter(angle, 240) == pytest.approx(exact, rel=2e-5)  # 4e-6 to 1.3e-5
    order = log2((quarter(angle, 240) / exact - 1) / (quarter(angle, 480) / exact - 1))
    assert order == pytest.approx(2, abs=0.05)


@pytest.mark.sweep
@settings(max_examples=8)
@given(
    st.floats(0.2, 2), st.floats(-2, 2), st.floats(-1, 1), st.floats(-1.5, 1.5), st.floats(-2, 2)
)
def test_a_bead_stays_on_its_wire_and_keeps_its_energy(
    a: float, b: float, c: float, start: float, speed: float
) -> None:
    """y = a x² + b x + c sin x, open upwards far out; no drift, second order."""

    def height(x: float | np.ndarray) -> float | np.ndarray:
        return a * x**2 + b * x + c * np.sin(x)

    slope = 2 * a * start + b + c * cos(start)
    swings: list[float] = []
    for rate in (500, 1000):
        scene = level(
            {"bead": disc((start, float(height(start))), velocity=[speed, speed * slope])},
            GRAVITY,
            joints={"wire": wire("s", f"{a}*s**2 + {b}*s + {c}*sin(s)", -30, 30)},
            stepping={"rate": rate},
        )
        found = measured(
            build(scene), 2 * rate, "bead.position.x", "bead.position.y", "bead.energy"
        )
        x, y, energy = found.values()
        assert np.abs(y - height(x)).max() <= 1e-11 * (1 + np.abs(y).max())  # 1e-13
        swings.append(float(np.ptp(energy)))
    assert swings[1] <= max(swings[0] / 3, 1e-9)  # a quarter


@pytest.mark.sweep
def test_a_stick_whose_end_slides_along_a_wire_keeps_its_energy_and_has_a_lever() -> None:
    """On a straight, level wire nothing acts along it: the centre's momentum stays."""
    scene = level(
        {"stick": disc((0, -0.5), radius=0.1, moment=0.2)},
        {**GRAVITY, "rotation": {}},
        joints={"wire": wire("s", "0.0*s", -5, 5, {"body": "stick", "at": [0, 0.5]})},
        stepping={"rate": 240},
    )
    world = build(scene)
    assert world.snapshot.tension[0] == pytest.approx(G, rel=1e-12)

    tilted = build(
        level(
            {"stick": disc((0.4, -0.3), radius=0.1, moment=0.2)},
            {**GRAVITY, "rotation": {}},
            joints={"wire": wire("s", "0.0*s", -5, 5, {"body": "stick", "at": [-0.4, 0.3]})},
            stepping={"rate": 240},
        )
    )
    found = measured(tilted, 960, "system.momentum.x", "system.energy", "stick.angular_velocity")
    assert np.abs(found["system.momentum.x"]).max() <= 1e-12
    assert np.ptp(found["system.energy"]) < 1e-2  # of 3 J
    assert np.abs(found["stick.angular_velocity"]).max() > 1


def test_a_bead_that_comes_to_the_end_of_its_wire_ends_the_run_by_name() -> None:
    scene = level({"bead": disc((0, 0))}, GRAVITY, joints={"wire": wire("s", "-s", 0, 2)})
    with pytest.raises(
        SimulationError, match=r"stopped at t = 0\.9.*the end of 'wire'; make"
    ) as told:
        build(scene).advance(120)
    assert told.value.subject == "wire"  # √(2 · 2 m / (g sin² 45°)) = 0.90 s


def looked_at_each_step(world: World, steps: int) -> None:
    for _ in range(steps):
        world.advance()


@pytest.mark.parametrize(
    ("rate", "scheme"),
    [
        (60, "leapfrog"),
        (100, "leapfrog"),
        (51, "leapfrog"),
        (102, "leapfrog"),
        (60, "fourth-order"),
    ],
)
def test_a_bend_that_is_too_sharp_for_the_step_is_told(rate: float, scheme: str) -> None:
    """At 8 m/s a step is 0.08 to 0.16 m, and the bend's radius 0.02 m.

    With the last three the step comes through, and who looks where the bead is notices.
    """
    bend = wire("s", "sqrt(s**2 + 0.0004)", -1, 1)
    scene = level(
        {"bead": disc((-0.9, sqrt(0.81 + 0.0004)), velocity=[5.66, -5.66])},
        {},
        joints={"wire": bend},
        stepping={"rate": rate, "scheme": scheme},
    )
    with pytest.raises(SimulationError, match=r"'wire' .*; a higher 'rate' may help"):
        looked_at_each_step(build(scene), round(rate * 0.25))


def test_a_bead_that_is_put_elsewhere_goes_on_beside_its_wire() -> None:
    world = build(on_hoop(1.0))
    world.advance(10)
    world.place({"bead": (-1.2, 0.0)})
    found = measured(world, 60, "bead.position.x", "bead.position.y")

    assert worst(np.hypot(*found.values()), 1.2) <= 1e-12
