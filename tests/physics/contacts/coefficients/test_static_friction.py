"""Static friction that is stronger than kinetic friction."""

from math import atan, cos, log2, radians, sin

import numpy as np
import pytest

from sandbox.model.expressions import Array
from sandbox.model.level import Level
from sandbox.physics.run import build
from tests.physics.scenes import (
    GRAVITY,
    G,
    Spec,
    box,
    disc,
    fixed,
    floor,
    level,
    measured,
    run,
    worst,
)

STATIC, KINETIC, GROWTH = 0.6, 0.3, 6.77


def pulled(rate: float, growth: float | str = GROWTH, **kinetic: float) -> Level:
    """A block of 1 kg on a floor, pulled by a force that grows with time [N/s]."""
    pair = {"bodies": ["block", "floor"], "coefficient": KINETIC, "static": STATIC, **kinetic}
    effects = {
        **GRAVITY,
        "contact": {},
        "friction": {"pairs": [pair]},
        "force": [{"body": "block", "force": [f"{growth}*t", 0]}],
    }
    bodies = {"block": box((0, 0.25)), "floor": floor()}
    return level(bodies, effects, stepping={"rate": rate})


def loose(t: Array) -> Array:
    """Return for how long the block has been loose at a time [s]."""
    return np.maximum(t - STATIC * G / GROWTH, 0)


def test_a_growing_pull_is_held_until_the_static_limit_and_then_only_the_kinetic_rubs() -> None:
    rate = 240
    names = ("block.position.x", "block.contact.friction", "t")
    found = measured(build(pulled(rate)), 2 * rate, *names)
    t, friction = found["t"], found["block.contact.friction"]
    breaks = STATIC * G / GROWTH
    held, slips = t < breaks - 1 / rate, t > breaks + 2 / rate

    assert np.abs(found["block.position.x"][held]).max() <= 1e-9  # 0: no creep
    assert worst(friction[held], GROWTH * t[held]) <= 1e-12
    assert worst(friction[slips], KINETIC * G) <= 1e-12
    assert friction.max() == pytest.approx(STATIC * G, rel=GROWTH / rate / (STATIC * G))


def velocity_error(rate: float) -> float:
    found = measured(build(pulled(rate)), round(2 * rate), "block.velocity.x", "t")
    tau = loose(found["t"])[-1]
    expected = GROWTH * tau**2 / 2 + (STATIC - KINETIC) * G * tau
    return abs(float(found["block.velocity.x"][-1]) - expected) / expected


@pytest.mark.sweep
def test_the_moment_of_breaking_loose_is_found_between_the_steps() -> None:
    """Known to a step only, the velocity would be late by (mu_s − mu_k) g dt: 9e-3 at 60 Hz."""
    assert velocity_error(60) <= 1e-4  # 1.7e-5
    assert velocity_error(60 * 2**4) <= velocity_error(60) / 50  # second order: 1/256 on average


def test_a_pull_that_stays_just_below_the_limit_never_breaks_it() -> None:
    scene = pulled(60, f"{STATIC * G * (1 - 1e-6)}*min(1, t)/max(t, 0.001)")
    end = build(scene).advance(600)

    assert abs(end.position[0, 0]) <= 1e-9
    assert end.friction[0] == pytest.approx(STATIC * G, rel=1e-5)


def test_equal_coefficients_are_one() -> None:
    """No callback is paid beyond that of a pair with a coefficient of its own."""
    two, one = build(pulled(60)), build(pulled(60, static=KINETIC))

    assert one.hooks == 2
    assert two.hooks == 3


def slope(angle: float, velocity: float = 0) -> Level:
    """A block on a slope; its way down is to the left. The coefficients are products."""
    downhill = [-velocity * cos(angle), -velocity * sin(angle)]
    ground = fixed(
        {"type": "segment", "start": [-200, 0], "end": [200, 0]},
        (0.25 * sin(angle), -0.25 * cos(angle)),
        angle=angle,
        friction=0.5,
    )
    block = box(angle=angle, velocity=downhill, friction=0.8, static_friction=1.2)
    effects = {**GRAVITY, "contact": {}, "friction": {}}
    return level({"block": block, "slope": ground}, effects)


@pytest.mark.parametrize("share", [0.9, 1 - 1e-6, 1 + 1e-6, 1.2])
def test_a_block_sticks_below_the_static_angle_and_slides_by_the_kinetic_above(
    share: float,
) -> None:
    angle = atan(0.6 * share)
    slide = run(build(slope(angle)), 120)
    way = -slide.position[:, 0] @ [cos(angle), sin(angle)]
    a = G * (sin(angle) - 0.4 * cos(angle)) if share > 1 else 0

    assert np.abs(way - a * slide.t**2 / 2).max() <= 1e-10  # 3e-15


def test_what_slides_at_the_start_feels_the_kinetic_friction_until_it_stops_and_then_sticks() -> (
    None
):
    """On 28°, between the two angles: it slows down, stops, and stays."""
    angle, v = radians(28), 1.0
    slide = run(build(slope(angle, v)), 600)
    way = -slide.position[:, 0] @ [cos(angle), sin(angle)]
    a = G * (0.4 * cos(angle) - sin(angle))

    assert a < 0  # friction alone would not stop it
    assert worst(way, v * slide.t - a * slide.t**2 / 2) <= 1e-10


def test_it_stops_and_sticks_where_the_kinetic_friction_is_enough() -> None:
    angle, v = radians(20), 1.0
    slide = run(build(slope(angle, v)), 600)
    way = -slide.position[:, 0] @ [cos(angle), sin(angle)]
    a = G * (0.4 * cos(angle) - sin(angle))

    assert way[-1] == pytest.approx(v**2 / (2 * a), abs=a / 60**2)  # it stops within a step
    assert np.ptp(way[400:]) <= 1e-12


@pytest.mark.sweep
def test_a_block_broken_loose_at_first_sticks_again_when_it_has_stopped() -> None:
    """Pulled beyond the limit for a while and then at half of it, it stops and is held."""
    scene = pulled(240, "where(t < 1, 7, 2)/max(t, 0.001)")
    world = build(scene)
    flight = run(world, 240 * 8)

    assert flight.position[300, 0, 0] > 0.5
    assert np.ptp(flight.position[-240:, 0, 0]) <= 1e-12
    assert flight.friction[-1, 0] == pytest.approx(2, rel=1e-9)


def wheel(rate: float, static: float) -> float:
    """Return by how much a disc slips that a force of 3 N draws at its centre [m/s]."""
    pair = {"bodies": ["wheel", "floor"], "coefficient": 0.05, "static": static}
    effects: Spec = {
        **GRAVITY,
        "contact": {},
        "rotation": {},
        "friction": {"pairs": [pair]},
        "force": [{"body": "wheel", "force": ["3*t", 0]}],
    }
    scene = level({"wheel": disc((0, 0.5)), "floor": floor()}, effects, stepping={"rate": rate})
    end = build(scene).advance(round(2 * rate))
    return float(end.velocity[0, 0] + 0.5 * end.angular_velocity[0])


def test_a_wheel_rolls_while_it_sticks_and_spins_too_slowly_once_it_slips() -> None:
    """Rolling takes F/3 of friction: loose at 3 t/3 = mu_s g; then I dω/dt = mu_k m g r."""
    limit = 0.1 * G
    late = 2 - limit
    slip = 3 * (2**2 - limit**2) / 2 - 0.05 * G * late - 2 * 0.05 * G * late

    assert abs(wheel(240, 0.3)) <= 1e-12
    assert wheel(240, 0.1) == pytest.approx(slip, rel=2e-5)  # 2.1e-6
    error = [abs(wheel(rate, 0.1) - slip) for rate in (60, 960)]
    assert log2(error[0] / error[1]) / 4 >= 1.3  # it is second order but for where the step falls
