"""Free flight and orbits: exact where accelerations are constant, second order elsewhere."""

from itertools import pairwise
from math import log2, pi, sqrt

import numpy as np
import pytest

from sandbox.physics.measuring.grading import grade
from sandbox.physics.run import build, simulate
from tests.physics.scenes import GRAVITY, G, disc, level, measured, orbit, run, worst

EPS = float(np.finfo(float).eps)


def stepping(scheme: str = "leapfrog", rate: float = 60) -> dict[str, object]:
    return {"stepping": {"rate": rate, "scheme": scheme}}


@pytest.mark.parametrize("rate", [1, 60, 240, 333.3])
def test_a_projectile_is_on_its_parabola_at_every_step(rate: float) -> None:
    """Every step is a sum of a rounded position and a rounded displacement: error <= 2 n eps."""
    world = build(level({"ball": disc(velocity=[3, 8])}, GRAVITY, **stepping(rate=rate)))
    flight = run(world, int(2 * rate))
    t = flight.t

    assert worst(flight.position[:, 0, 0], 3 * t) <= 1e-12  # 4e-15 at 60 Hz
    assert worst(flight.position[:, 0, 1], 8 * t - G * t**2 / 2) <= 1e-12  # 5e-15 at 60 Hz
    assert worst(flight.velocity[:, 0, 1], 8 - G * t) <= 1e-12  # 4e-15 at 60 Hz
    assert worst(flight.acceleration[:, 0, 1], -G) <= 4 * EPS * 8 * rate / G + 1e-12


@pytest.mark.parametrize("rate", [60, 120, 240])
def test_started_naively_free_fall_is_late_by_half_a_step(rate: int) -> None:
    """x += v dt before v += g dt: the error is g t dt / 2, and only that."""
    scene = level({"ball": disc()}, GRAVITY, **stepping("symplectic-euler", rate))
    height = build(scene).advance(2 * rate).position[0, 1]

    assert height + G * 2.0**2 / 2 == pytest.approx(G * 2.0 / rate / 2, rel=1e-10)


@pytest.mark.parametrize("scheme", ["leapfrog", "symplectic-euler"])
def test_apex_and_range_follow_from_the_speed_of_the_throw(scheme: str) -> None:
    formulas = {"apex": "vy**2/(2*g)", "range": "2*vx*vy/g"}
    scene = level(
        {"ball": disc(velocity=["vx", "vy"])},
        {"gravity": {"acceleration": [0, "-g"]}},
        parameters={
            "vx": {"value": 3, "min": 1, "max": 5},
            "vy": {"value": 8, "min": 1, "max": 9},
            "g": {"value": G, "min": 1, "max": 25},
        },
        checks=[
            {
                "quantity": "ball.position.y",
                "formula": formulas["apex"],
                "tolerance": 1e-12,
                "at": {"event": "apex", "body": "ball"},
            },
            {
                "quantity": "ball.position.x",
                "formula": formulas["range"],
                "tolerance": 1e-12,
                "at": {"event": "landing", "body": "ball"},
            },
        ],
        duration=2,
        **stepping(scheme),
    )
    errors = [result.error for result in grade(simulate(scene))]

    for error in errors:
        assert error is not None
        if scheme == "leapfrog":
            assert error <= 1e-12  # 3e-15
        else:
            assert error > 1e-3  # 2e-2: the check can fail


@pytest.mark.sweep
@pytest.mark.parametrize("rate", [60, 240])
def test_a_circular_orbit_comes_back_to_its_radius_for_ten_turns(rate: int) -> None:
    """To leapfrog the start is the near end of an ellipse: r = 1 + dt² (1 − cos t) / 4 + O(dt⁴)."""
    flight = run(build(orbit(rate=rate)), int(20 * pi * rate))
    radius = np.hypot(*flight.position[:, 0].T)
    ellipse = 1 + (1 - np.cos(flight.t)) / (4 * rate**2)

    assert worst(radius, 1) == pytest.approx(1 / (2 * rate**2), rel=1e-3)
    assert worst(radius, ellipse) < 5 / rate**4  # 1.3 dt⁴: 1e-7 at 60 Hz, 4e-10 at 240 Hz


@pytest.mark.sweep
@pytest.mark.parametrize(("scheme", "order"), [("leapfrog", 2), ("explicit-euler", 1)])
def test_an_eccentric_orbit_closes_with_the_order_of_its_scheme(scheme: str, order: int) -> None:
    """A period of 1 s (mu = 4 pi² a³), from the nearest point, e = 0.5: back where it was."""
    axis = 2.0  # m
    mu = 4 * pi**2 * axis**3
    errors = []
    for rate in (2000, 4000, 8000):
        world = build(orbit(sqrt(mu * 1.5), rate, scheme, mu))
        errors.append(float(np.hypot(*(world.advance(rate).position[0] - [1, 0]))))

    for coarse, fine in pairwise(errors):
        assert log2(coarse / fine) == pytest.approx(order, abs=0.2)  # 2.00 and 0.9


@pytest.mark.sweep
def test_explicit_euler_spirals_outwards_where_symplectic_euler_does_not() -> None:
    radius = {
        scheme: np.hypot(*build(orbit(scheme=scheme)).advance(int(20 * pi * 60)).position[0])
        for scheme in ("explicit-euler", "symplectic-euler", "leapfrog")
    }
    errors = {scheme: abs(r - 1) for scheme, r in radius.items()}

    assert errors["explicit-euler"] > 0.5  # 0.90
    assert errors["symplectic-euler"] < 1e-3  # 2e-4
    assert errors["leapfrog"] < 1e-7  # 1e-8


@pytest.mark.parametrize(("scheme", "order"), [("leapfrog", 2), ("symplectic-euler", 1)])
def test_velocities_are_those_at_the_step(scheme: str, order: int) -> None:
    """On the circle v is at right angles to r; half a step off that is wrong by v dt / 2."""
    errors = []
    for rate in (60, 120):
        flight = run(build(orbit(scheme=scheme, rate=rate)), 3 * rate)
        x, y = flight.position[:, 0].T
        vx, vy = flight.velocity[:, 0].T
        errors.append(float(np.abs(x * vx + y * vy).max()))

    assert log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.1)  # 7e-5 and 1.7e-2 at 60 Hz


@pytest.mark.sweep
def test_leapfrog_bounds_the_energy_of_an_orbit_at_every_step() -> None:
    mu = 4 * pi**2
    world = build(orbit(sqrt(mu) * 1.1, 1000, mu=mu))
    energy = measured(world, 5000, "system.energy")["system.energy"]

    assert np.ptp(energy) < 2e-5 * abs(energy[0])  # 5e-6
    assert np.ptp(energy[2500:]) == pytest.approx(np.ptp(energy[:2500]), rel=1e-3)  # no drift
