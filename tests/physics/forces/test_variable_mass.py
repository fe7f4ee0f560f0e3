"""Bodies whose mass changes."""

from math import log, log2, pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sandbox.model.expressions import Array
from sandbox.model.level import Level
from sandbox.physics.quantities.meter import Meter
from sandbox.physics.run import build
from tests.physics.scenes import GRAVITY, G, Spec, box, disc, floor, level, measured, worst

MASS, EXHAUST, RATE = 10.0, 30.0, 2.0


def rocket(rate: float = 60, propellant: float = 8, *, more: Spec | None = None) -> Level:
    """A rocket of 10 kg that burns 2 kg/s and flies to the right."""
    thrust = {"body": "rocket", "exhaust": [-EXHAUST, 0], "rate": RATE, "propellant": propellant}
    effects = {"thrust": [thrust], **(more or {})}
    return level({"rocket": disc(mass=MASS)}, effects, stepping={"rate": rate})


def tsiolkovsky(t: Array) -> Array:
    return np.asarray(EXHAUST * np.log(MASS / (MASS - RATE * t)))


def velocity_error(rate: float) -> float:
    found = measured(build(rocket(rate)), round(3.5 * rate), "rocket.velocity.x", "t")
    return worst(found["rocket.velocity.x"], tsiolkovsky(found["t"]))


def test_a_rocket_gains_what_tsiolkovsky_says_at_every_step() -> None:
    """Down to 3 of its 10 kg; the bound is (rate dt / m)² at the end."""
    assert velocity_error(60) <= (RATE / 60 / 3) ** 2  # 8e-6, of 1.2e-4
    assert log2(velocity_error(60) / velocity_error(120)) >= 1.9  # 2.00


@pytest.mark.parametrize("propellant", [3.0, 3.01, 3.02])
def test_what_burns_out_within_a_step_gives_its_share_of_it(propellant: float) -> None:
    """Known to a step only, the end would be off by up to rate dt u / m: 1e-2."""
    end = build(rocket(60, propellant)).advance(120)

    assert end.velocity[0, 0] == pytest.approx(EXHAUST * log(10 / (10 - propellant)), rel=2e-5)
    assert end.acceleration[0, 0] == 0


def test_the_exhaust_takes_what_momentum_the_rocket_gains() -> None:
    """What leaves has the velocity v − u; its momentum is summed over the run."""
    found = measured(build(rocket(240)), 940, "rocket.momentum.x", "rocket.velocity.x", "t")
    leaves = (found["rocket.velocity.x"] - EXHAUST) * RATE
    thrown = np.concatenate(([0], np.cumsum((leaves[1:] + leaves[:-1]) / 2 / 240)))

    assert np.abs(found["rocket.momentum.x"] + thrown).max() <= 1e-3  # 2e-4 of 99: second order


def test_all_that_is_measured_has_the_mass_of_its_instant() -> None:
    world = build(rocket(60, more=dict(GRAVITY)))
    names = ("kinetic_energy", "momentum.x", "potential_energy", "speed", "position.y")
    found = measured(world, 60, *(f"rocket.{name}" for name in names), "t", "system.momentum.x")
    mass = MASS - RATE * found["t"]

    assert worst(found["rocket.kinetic_energy"], mass * found["rocket.speed"] ** 2 / 2) <= 1e-14
    assert worst(found["rocket.potential_energy"], mass * G * found["rocket.position.y"]) <= 1e-14
    assert np.array_equal(found["rocket.momentum.x"], found["system.momentum.x"])
    assert world.scene.bodies["rocket"].mass == pytest.approx(MASS - RATE * 1.0)


def test_a_center_of_mass_moves_to_what_keeps_its_mass() -> None:
    thrust = {"body": "a", "exhaust": [0, 0], "rate": 1, "propellant": 0.5}
    scene = level({"a": disc((-1, 0)), "b": disc((1, 0))}, {"thrust": [thrust]})
    found = measured(build(scene), 60, "system.center.x")["system.center.x"]

    assert found[0] == 0
    assert found[-1] == pytest.approx((1 - 0.5) / 1.5, rel=1e-12)


def test_gravity_and_attraction_accelerate_a_light_rocket_as_a_heavy_one() -> None:
    """And a given force accelerates it by the mass that is left."""
    silent = {"body": "rocket", "exhaust": [0, 0], "rate": RATE, "propellant": 8}
    push = {"body": "rocket", "force": [0, 6]}
    effects = {
        "gravity": {"acceleration": [0, -G]},
        "attraction": [{"mu": 4, "center": [0, -2]}],
        "force": [push],
        "thrust": [silent],
    }
    world = build(level({"rocket": disc(mass=MASS)}, effects))

    assert world.snapshot.acceleration[0, 1] == pytest.approx(-G - 1 + 6 / MASS, rel=1e-12)
    end = world.advance(120)
    distance = end.position[0, 1] + 2
    expected = -G - 4 * np.sign(distance) / distance**2 + 6 / (MASS - 2 * RATE)
    assert end.acceleration[0, 1] == pytest.approx(expected, rel=1e-9)


def test_a_rocket_that_turns_thrusts_along_itself_and_turns_faster_as_it_lightens() -> None:
    """Its moment falls with its mass: a torque of 1 N m turns it as fast as its mass allows."""
    torque = {"body": "rocket", "force": [0, 2], "at": [0.5, 0]}
    against = {"body": "rocket", "force": [0, -2]}
    scene = level(
        {"rocket": disc(mass=MASS, angle=pi / 2)},
        {
            "thrust": [{"body": "rocket", "exhaust": [-3, 0], "rate": 1, "propellant": 9}],
            "rotation": {},
            "force": [torque, against],
        },
    )
    world = build(scene)

    assert world.snapshot.acceleration[0] == pytest.approx([0, 3 / MASS], abs=1e-12)
    end = world.advance(60)
    inertia = 9 * 0.5**2 / 2
    angle = float(end.angle[0])
    assert end.angular_acceleration[0] * inertia == pytest.approx(np.cos(angle), rel=1e-3, abs=1e-3)


@pytest.mark.sweep
@settings(max_examples=25, deadline=None)
@given(st.floats(0.1, 5), st.floats(-3, 3), st.floats(-3, 3), st.floats(-3, 3))
def test_what_gathers_matter_keeps_the_momentum_of_both(
    rate: float, vx: float, wx: float, wy: float
) -> None:
    """p = m0 v0 + w dm, in both directions."""
    accretion = {"body": "cart", "rate": rate, "velocity": [wx, wy]}
    scene = level(
        {"cart": disc(mass=2, velocity=[vx, 0])},
        {"accretion": [accretion]},
        stepping={"rate": 240},
    )
    world = build(scene)
    names = ("cart.momentum.x", "cart.momentum.y")
    found = measured(world, 240, *names, "t")
    expected = np.array([2 * vx + wx * rate * found["t"], wy * rate * found["t"]])

    scale = 2 * abs(vx) + rate * (abs(wx) + abs(wy)) + 1e-9
    assert np.abs([found[name] for name in names] - expected).max() <= 1e-4 * scale


def test_a_rocket_stands_until_its_thrust_carries_it() -> None:
    """60 N of thrust under 10 kg: it lifts off when 60 / G kg are left."""
    thrust = {"body": "rocket", "exhaust": [0, -EXHAUST], "rate": RATE, "propellant": 8}
    scene = level(
        {"rocket": box((0, 0.25), mass=MASS), "pad": floor()},
        {**GRAVITY, "contact": {}, "thrust": [thrust]},
        stepping={"rate": 240},
    )
    names = ("rocket.position.y", "rocket.contact.normal", "t")
    found = measured(build(scene), 720, *names)
    t, leaves = found["t"], (MASS - 60 / G) / RATE
    stands = t < leaves - 1 / 240

    assert np.abs(found["rocket.position.y"][stands] - 0.25).max() <= 1e-12
    weight = (MASS - RATE * t) * G - 60
    assert worst(found["rocket.contact.normal"][stands], weight[stands]) <= 1e-10
    assert found["rocket.position.y"][-1] > 0.3
    assert found["rocket.contact.normal"][-1] == 0


def test_what_changes_no_mass_has_no_hook() -> None:
    world = build(level({"ball": disc()}, dict(GRAVITY)))

    assert world.hooks == 0
    assert Meter(world, ["ball.momentum"])(world.snapshot)["ball.momentum"] == 0


@pytest.mark.parametrize("solver", ["direct", "iterative"])
def test_a_cart_under_a_hopper_bears_its_load_and_presses_with_its_mass(solver: str) -> None:
    """With the initial mass, the direct solver gave forces of 0.8 of these after half a second.

    What lies on the cart slows it by the ratio of their masses.
    """
    mu, mass, rate, falls, t = 0.2, 4.0, 2.0, 3.0, 0.5
    cart = box((0, 0.5), size=(4, 1), mass=mass, friction=1)
    load = box((0, 1.25), mass=1, velocity=[2, 0], friction=mu)
    effects = {
        **GRAVITY,
        "contact": {"solver": solver},
        "friction": {"pairs": [{"bodies": ["floor", "cart"], "coefficient": 0}]},
        "rotation": {},
        "accretion": [{"body": "cart", "rate": rate, "velocity": [0, -falls]}],
    }
    bodies = {"floor": floor(friction=1), "cart": cart, "load": load}
    world = build(level(bodies, effects, stepping={"rate": 240}))
    found = measured(world, 120, "cart.contact.normal", "cart.velocity.x")

    weight = (mass + rate * t + 2) * G + rate * falls  # with the load's, on its upper side
    assert found["cart.contact.normal"][-1] == pytest.approx(weight, rel=1e-6)
    speed = mu * G * t / (mass + rate * t)  # the momentum that friction gave so far
    assert found["cart.velocity.x"][-1] == pytest.approx(speed, rel=1e-4)
