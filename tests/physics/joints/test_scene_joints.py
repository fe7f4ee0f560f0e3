"""Joints: rods, ropes, pulleys, pivots and springs, as the textbooks say."""

from collections.abc import Callable, Sequence
from math import cos, log2, pi, sin, sqrt
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.special import ellipk

from sandbox.model.expressions import Array
from sandbox.model.level import Level
from sandbox.physics.advising.preflight_faults import refusal
from sandbox.physics.measuring.interpolation_between_steps import crossing
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import SimulationError
from tests.physics.scenes import (
    GRAVITY,
    G,
    Spec,
    box,
    disc,
    floor,
    level,
    measured,
    run,
    table,
    worst,
)


def rod(*ends: object, **rest: object) -> Spec:
    return {"type": "rod", "ends": list(ends), **rest}


def pendulum(angle: float, rate: float = 60, kind: str = "rod", scheme: str = "leapfrog") -> Level:
    """A bob on a metre of rod or rope, let go at an angle from the vertical."""
    return level(
        {"bob": disc((sin(angle), -cos(angle)), mass=2)},
        GRAVITY,
        joints={"arm": {"type": kind, "ends": [[0, 0], "bob"]}},
        stepping={"rate": rate, "scheme": scheme},
    )


def order(error: Callable[[float], float], rate: float) -> float:
    """Return by which power of the step an error falls."""
    return log2(error(rate) / error(2 * rate))


def quarter_error(rate: float, amplitude: float = 1.0) -> float:
    """T/4 = √(l/g) K(sin(θ/2)): an elliptic integral."""
    exact = sqrt(1 / G) * float(ellipk(sin(amplitude / 2) ** 2))
    found = measured(build(pendulum(amplitude, rate)), round(1.5 * rate), "bob.position.x", "t")
    passed = crossing(found["t"], found["bob.position.x"], 0.0, "down")
    assert passed is not None
    return abs(passed / exact - 1)


@pytest.mark.parametrize("amplitude", [0.1, 1.0, 2.0, 3.0])
def test_a_pendulum_swings_in_the_time_of_the_elliptic_integral(amplitude: float) -> None:
    """Second order: (ω dt)² / 24 for small swings, 1.1e-4; more where the rod turns fast."""
    found = measured(build(pendulum(amplitude)), 200, "bob.position.x", "t")
    passed = crossing(found["t"], found["bob.position.x"], 0.0, "down")
    exact = sqrt(1 / G) * float(ellipk(sin(amplitude / 2) ** 2))

    assert passed == pytest.approx(exact, rel=1e-3)  # 1e-4 to 5e-4


def test_a_pendulum_is_second_order() -> None:
    assert order(quarter_error, 60) >= 1.9


@pytest.mark.sweep
@pytest.mark.parametrize("rate", [60, 240])
def test_a_pendulum_keeps_its_length_and_its_energy(rate: float) -> None:
    """The energy swings by (ω dt)² of its scale, and does not drift."""
    found = measured(build(pendulum(1.5, rate)), round(50 * rate), "arm.length", "bob.energy")
    energy, half = found["bob.energy"] + 2 * G * cos(1.5), len(found["bob.energy"]) // 2

    assert worst(found["arm.length"], 1.0) <= 1e-12  # 4e-16
    assert np.abs(energy).max() < 2 * G * 1e-2 * (60 / rate) ** 2  # 9e-4, 6e-5
    assert np.abs(energy[half:]).max() == pytest.approx(np.abs(energy[:half]).max(), rel=0.05)


def test_a_pendulum_started_naively_is_worse() -> None:
    ours, naive = (
        measured(build(pendulum(1.5, scheme=scheme)), 300, "bob.energy")["bob.energy"]
        for scheme in ("leapfrog", "symplectic-euler")
    )
    assert np.ptp(naive[1:]) > 10 * np.ptp(ours)


def double_pendulum(rate: float) -> Level:
    return level(
        {
            "upper": disc((sin(2), -cos(2)), mass=1),
            "lower": disc((sin(2) + 0.7 * sin(1), -cos(2) - 0.7 * cos(1)), mass=0.5),
        },
        GRAVITY,
        joints={"first": rod([0, 0], "upper"), "second": rod("upper", "lower")},
        stepping={"rate": rate},
    )


def lagrange(_t: float, y: Array) -> Array:
    """The Euler-Lagrange equations of the double pendulum: M(θ) θ'' = f(θ, θ')."""
    (a, b, u, w), l1, l2, m1, m2 = y, 1.0, 0.7, 1.0, 0.5
    matrix = [
        [(m1 + m2) * l1**2, m2 * l1 * l2 * cos(a - b)],
        [m2 * l1 * l2 * cos(a - b), m2 * l2**2],
    ]
    twist = m2 * l1 * l2 * sin(a - b)
    force = [
        -twist * w**2 - (m1 + m2) * G * l1 * sin(a),
        twist * u**2 - m2 * G * l2 * sin(b),
    ]
    return np.array([u, w, *np.linalg.solve(matrix, force)])


def double_error(rate: float) -> float:
    start = np.array([2.0, 1.0, 0, 0])
    a, b = solve_ivp(lagrange, (0, 1.5), start, "DOP853", rtol=1e-12, atol=1e-12).y[:2, -1]
    end = build(double_pendulum(rate)).advance(round(1.5 * rate))
    lower = np.array([sin(a) + 0.7 * sin(b), -cos(a) - 0.7 * cos(b)])
    return float(np.abs(end.position[1] - lower).max())


@pytest.mark.sweep
def test_a_double_pendulum_follows_its_euler_lagrange_equations() -> None:
    assert double_error(1000) < 2e-4  # 2.5e-5
    assert order(double_error, 500) >= 1.9


@pytest.mark.parametrize(("count", "load"), [(5, 1.0), (20, 1.0), (20, 100.0)])
def test_a_chain_keeps_its_links_whatever_hangs_at_its_end(count: int, load: float) -> None:
    bodies = {f"b{i}": disc((0.1 * i, 0)) for i in range(1, count + 1)}
    bodies[f"b{count}"]["mass"] = load
    ends = [[0, 0], *bodies]
    joints = {f"r{i}": rod(*ends[i : i + 2]) for i in range(count)}
    world = build(level(bodies, GRAVITY, joints=joints, stepping={"rate": 1000}))
    names = [f"{joint}.length" for joint in joints]
    found = measured(world, 1000, *names, "system.energy")

    for name in names:
        assert worst(found[name], 0.1) <= 1e-12  # 1e-15
    scale = load * G * 0.1 * count
    assert np.abs(found["system.energy"]).max() < 1e-2 * scale  # 6e-4, 7e-6 under the load


def test_a_hanging_chain_carries_at_each_link_what_is_below() -> None:
    bodies = {f"b{i}": disc((0, -0.1 * i), mass=i) for i in range(1, 6)}
    ends = [[0, 0], *bodies]
    joints = {f"r{i}": rod(*ends[i : i + 2]) for i in range(5)}
    end = build(level(bodies, GRAVITY, joints=joints)).advance(60)

    assert end.tension == pytest.approx([G * below for below in (15, 14, 12, 9, 5)], rel=1e-10)
    assert worst(end.position[:, 1], np.array([-0.1, -0.2, -0.3, -0.4, -0.5])) <= 1e-14


def physical(rate: float, amplitude: float = 0.8) -> Level:
    """A thin rod of 1 m and 3 kg, pinned at its end."""
    turn = amplitude - pi / 2
    stick = {
        "shape": {"type": "segment", "start": [-0.5, 0], "end": [0.5, 0]},
        "mass": 3,
        "position": [0.5 * cos(turn), 0.5 * sin(turn)],
        "angle": turn,
    }
    pin = {"type": "pivot", "ends": [[0, 0], {"body": "stick", "at": [-0.5, 0]}]}
    return level(
        {"stick": stick}, {**GRAVITY, "rotation": {}}, joints={"pin": pin}, stepping={"rate": rate}
    )


def physical_error(rate: float) -> float:
    """ω² = m g d / I with d = l/2 and I = m l² / 3 about the pin."""
    exact = sqrt(2 / (3 * G)) * float(ellipk(sin(0.4) ** 2))
    found = measured(build(physical(rate)), round(rate), "stick.angle", "t")
    passed = crossing(found["t"], found["stick.angle"], -pi / 2, "down")
    assert passed is not None
    return abs(passed / exact - 1)


def test_a_stick_on_a_pin_is_a_physical_pendulum() -> None:
    assert physical_error(60) < 2e-3  # 2.7e-4
    assert order(physical_error, 60) >= 1.9


def spun_error(rate: float) -> float:
    """A couple of 1 N m that turns with a rod of 1 kg and 1 m, pinned at its end: I = 1/3 kg m²."""
    rod = {
        "shape": {"type": "segment", "start": [-0.5, 0], "end": [0.5, 0]},
        "mass": 1,
        "position": [0.5, 0],
    }
    forces = [
        {"body": "rod", "force": [0, pull], "at": [at, 0], "frame": "body"}
        for at, pull in ((0.5, 1), (-0.5, -1))
    ]
    pin = {"type": "pivot", "ends": [[0, 0], {"body": "rod", "at": [-0.5, 0]}]}
    scene = level(
        {"rod": rod},
        {"force": forces, "rotation": {}},
        joints={"pin": pin},
        stepping={"rate": rate},
    )
    found = measured(build(scene), round(1.5 * rate), "rod.angle", "t")
    return worst(found["rod.angle"], 1.5 * found["t"] ** 2)


def test_a_couple_turns_a_rod_about_its_end_by_the_parallel_axis_theorem() -> None:
    """The pin bends the centre's way: not exact, as without it, but second order."""
    assert spun_error(60) < 1e-3  # 3.5e-4
    assert order(spun_error, 60) >= 1.9  # 2.00


def test_a_pin_stays_where_it_is_and_carries_the_stick() -> None:
    found = measured(build(physical(60)), 600, "pin.length", "system.energy")
    energy = found["system.energy"] - found["system.energy"][0]
    still = build(physical(60, 0.0)).advance(60)

    assert found["pin.length"].max() <= 1e-14
    assert np.abs(energy).max() < 1e-2 * 3 * G * 0.5
    assert still.tension[0] == pytest.approx(3 * G, rel=1e-10)


def test_a_rope_lets_fall_and_then_holds() -> None:
    """A bob falls 0.5 m on a slack rope of 1 m, and hangs on it from then on."""
    scene = level(
        {"bob": disc((0, -0.5))},
        GRAVITY,
        joints={"rope": {"type": "rope", "ends": [[0, 0], "bob"], "length": 1}},
        stepping={"rate": 240},
    )
    found = measured(build(scene), 240, "bob.position.y", "rope.tension", "t")
    slack = found["rope.tension"] == 0
    first = int(np.argmin(slack))

    assert slack[0]
    assert found["t"][first] == pytest.approx(sqrt(1 / G), abs=2 / 240)
    free = -0.5 - G * found["t"] ** 2 / 2
    assert worst(found["bob.position.y"][: first - 1], free[: first - 1]) <= 1e-12
    assert worst(found["bob.position.y"][first + 2 :], -1.0) <= 1e-12
    assert worst(found["rope.tension"][first + 2 :], G) <= 1e-9


def test_a_rope_never_pushes() -> None:
    """A pendulum let go above the hook falls straight down before the rope is tight."""
    names = ("bob.position.x", "arm.tension", "arm.length", "t")
    found = measured(build(pendulum(2.5, 240, "rope")), 480, *names)

    assert (found["arm.tension"] >= 0).all()
    assert (found["arm.tension"] == 0).any()
    assert found["arm.length"].max() <= 1 + 1e-12


def test_a_rope_and_a_rod_that_pulls_are_the_same() -> None:
    rope, stiff = (build(pendulum(1.0, kind=kind)).advance(300) for kind in ("rope", "rod"))

    assert rope.position == pytest.approx(stiff.position, abs=1e-12)


def compound(light: float, heavy: float, **rest: object) -> Level:
    """A string from the ceiling around a moving pulley, over a peg, to a weight."""
    return level(
        {"wheel": disc((0, 0), mass=heavy), "weight": disc((1, 0), mass=light)},
        GRAVITY,
        joints={
            "string": {
                "type": "pulley",
                "ends": [[0, 4], "weight"],
                "over": ["wheel", [0, 4], [1, 4]],
            }
        },
        **rest,
    )


@pytest.mark.parametrize(("light", "heavy"), [(1, 1), (1, 5), (0.01, 10), (3, 6)])
def test_a_moving_pulley_rises_as_its_closed_form_says(light: float, heavy: float) -> None:
    """The weight goes twice as far: a = g (2 m − M) / (4 m + M) up, T = m (g − 2 a)."""
    found = measured(
        build(compound(light, heavy)), 30, "wheel.position.y", "weight.position.y",
        "string.tension", "t",
    )  # fmt: skip
    acceleration = G * (2 * light - heavy) / (4 * light + heavy)
    rise = acceleration * found["t"] ** 2 / 2

    assert worst(found["wheel.position.y"], rise) <= 1e-12  # 1e-15
    assert worst(found["weight.position.y"], -2 * rise) <= 1e-12
    assert found["string.tension"] == pytest.approx(light * (G - 2 * acceleration), rel=1e-10)


def skater() -> Level:
    """Two masses on rods that shrink, turning about a fixed middle."""
    reach = "1 - 0.2*t"
    return level(
        {
            "left": disc((-1, 0), velocity=[0, -2]),
            "right": disc((1, 0), velocity=[0, 2]),
        },
        {},
        joints={
            "one": rod([0, 0], "left", length=reach),
            "two": rod([0, 0], "right", length=reach),
        },
        duration=4,
    )


def test_a_skater_who_draws_in_his_arms_keeps_his_angular_momentum() -> None:
    names = ("system.angular_momentum", "one.length", "right.speed", "t")
    found = measured(build(skater()), 180, *names)
    length = 1 - 0.2 * found["t"]

    assert worst(found["system.angular_momentum"], 4.0) <= 1e-12  # 1e-15
    assert worst(found["one.length"], length) <= 1e-12
    across = found["right.speed"][2:] ** 2 - 0.04
    assert worst(np.asarray(np.sqrt(across)), 2 / length[2:]) < 1e-2  # ω r² is what is kept


def test_a_rope_holds_a_block_against_friction_from_the_first_step_on() -> None:
    """As the plain string does, which is solved alone."""
    plain = run(build(table(0.3)), 60)
    said = table(0.3).model_dump(mode="json", by_alias=True)
    said["joints"]["string"]["ends"] = ["block", {"body": "weight", "at": [0, 0]}]
    general = run(build(level(**_parts(said))), 60)

    assert general.position == pytest.approx(plain.position, abs=1e-10)
    assert general.tension == pytest.approx(plain.tension, rel=1e-8)


def _parts(said: Spec) -> dict[str, Any]:
    return {key: said[key] for key in ("bodies", "effects", "joints", "stepping")}


FREE = st.tuples(*[st.floats(-2, 2)] * 4)


@settings(max_examples=20, deadline=None)
@given(FREE, st.floats(0.1, 10), st.sampled_from(["rod", "rope", "spring"]))
def test_nothing_inside_changes_the_momentum_of_free_bodies(
    speeds: tuple[float, float, float, float], mass: float, kind: str
) -> None:
    more = {"stiffness": 40, "length": 0.8, "damping": 0.3} if kind == "spring" else {}
    at = {"body": "b", "at": [0.2, 0.1]}
    scene = level(
        {
            "a": disc((0, 0), velocity=speeds[:2]),
            "b": disc((1, 0.5), mass=mass, velocity=speeds[2:], angular_velocity=1),
        },
        {"rotation": {}},
        joints={"tie": {"type": kind, "ends": ["a", at], **more}},
    )
    names = ("system.momentum.x", "system.momentum.y", "system.angular_momentum")
    found = measured(build(scene), 60, *names)
    for name in names:
        assert np.ptp(found[name]) <= 1e-11 * (1 + mass) * 10, name


def twice() -> Level:
    return level(
        {"bob": disc((1, 0))},
        GRAVITY,
        joints={"one": rod([0, 0], "bob"), "same": rod([0, 0], "bob")},
    )


@pytest.mark.filterwarnings("error")
def test_two_joints_that_say_the_same_are_told_by_name() -> None:
    with pytest.raises(SimulationError, match="'same' is redundant") as caught:
        build(twice())

    assert caught.value.subject == "same"


def test_two_rails_in_one_direction_are_told_before_the_first_step() -> None:
    """Where bodies may touch they ran on, until the contact solver found no forces."""
    rails = {
        name: {
            "type": "rail",
            "ends": [{"body": "lift", "at": [x, 0]}, [x, 0]],
            "direction": [0, 1],
        }
        for name, x in (("left", -0.4), ("right", 0.4))
    }
    lift = level(
        {"ground": floor(), "lift": box((0, 1), size=(1, 0.1))},
        {**GRAVITY, "contact": {}, "rotation": {}},
        joints=rails,
    )
    error = refusal(lift)
    assert error
    assert error.subject == "right"
    with pytest.raises(SimulationError, match="'right' is redundant"):
        build(lift)


def test_a_joint_of_several_equations_may_hold_less() -> None:
    """A weld that latches a door holds the place of its hinge once more; a rod does not."""
    door = {"door": box((1, 0), size=(2, 0.1))}
    hinge = {"type": "pivot", "ends": [[0, 0], {"body": "door", "at": [-1, 0]}]}
    ends = [[2, -1], {"body": "door", "at": [1, 0]}]

    def latched(kind: str) -> Level:
        joints = {"hinge": hinge, "latch": {"type": kind, "ends": ends}}
        return level(door, {"rotation": {}}, joints=joints)

    build(latched("rod"))
    with pytest.raises(SimulationError, match="leave it out, or use a rod or a rail"):
        build(latched("weld"))


@pytest.mark.filterwarnings("error")
def test_a_chain_that_is_too_stiff_for_the_step_ends_the_run_by_name() -> None:
    bodies = {f"b{i}": disc((0.01 * i, 0), mass=1 if i < 20 else 1e6) for i in range(1, 21)}
    ends = [[0, 0], *bodies]
    joints = {f"r{i}": rod(*ends[i : i + 2]) for i in range(20)}
    scene = level(bodies, GRAVITY, joints=joints, stepping={"rate": 10})
    with pytest.raises(SimulationError, match="higher 'rate'") as caught:
        build(scene).advance(1000)

    assert caught.value.subject in joints


def test_bodies_put_elsewhere_by_hand_go_on_with_rods_that_fit() -> None:
    world = build(pendulum(0.5))
    world.advance(10)
    world.place({"bob": (2, 0)})
    found = measured(world, 100, "arm.length")

    assert worst(found["arm.length"], 2.0) <= 1e-12


def cart_error(rate: float) -> float:
    """A cart of 2 kg with a pendulum of 1 kg, against Lagrange's two equations: M(q) q'' = f."""

    def lagrangian(_t: float, y: Array) -> Array:
        _, a, u, w = y
        matrix = [[3.0, cos(a)], [cos(a), 1.0]]
        return np.array([u, w, *np.linalg.solve(matrix, [w**2 * sin(a), -G * sin(a)])])

    start = np.array([0.0, 2.0, 0, 0])
    x, a = solve_ivp(lagrangian, (0, 2), start, "DOP853", rtol=1e-12, atol=1e-12).y[:2, -1]
    bodies = {"cart": disc(mass=2), "bob": disc((sin(2), -cos(2)))}
    ties = {"rail": rail("cart", (0, 0), (1, 0)), "rod": rod("cart", "bob")}
    end = build(level(bodies, GRAVITY, joints=ties, stepping={"rate": rate})).advance(
        round(2 * rate)
    )
    places = np.array([[x, 0], [x + sin(a), -cos(a)]])
    return float(np.abs(end.position - places).max())


def rail(runs: object, through: Sequence[float], direction: Sequence[float]) -> Spec:
    return {"type": "rail", "ends": [runs, list(through)], "direction": list(direction)}


@pytest.mark.sweep
def test_a_cart_with_a_pendulum_follows_its_lagrange_equations() -> None:
    assert cart_error(1000) < 1e-4
    assert order(cart_error, 500) >= 1.9


@pytest.mark.sweep
@given(st.floats(-1.5, 1.5), st.floats(0.1, 10))
def test_a_rail_carries_across_and_not_along(slope: float, mass: float) -> None:
    """g sin θ along it, and it carries m g cos θ."""
    way = (cos(slope), sin(slope))
    ties = {"rail": rail("bead", (-way[0], -way[1]), way)}
    world = build(level({"bead": disc(mass=mass)}, GRAVITY, joints=ties))
    end = world.advance(60)
    slid = -G * sin(slope) / 2

    assert end.position[0] == pytest.approx([slid * way[0], slid * way[1]], abs=1e-12)
    assert end.tension[0] == pytest.approx(mass * G * cos(slope), abs=1e-10 * mass)


def test_a_rail_may_hold_a_point_of_a_body_that_turns() -> None:
    """Then it is a pendulum of 0.5 m on a cart without mass: nothing moves its centre along."""
    stick = disc((0, -0.5), radius=0.2, angle=1.0)
    ties = {"rail": rail({"body": "stick", "at": [0, 0.5]}, (0, 0), (1, 0))}
    stick["position"] = [0, -0.5 * cos(1)]
    world = build(level({"stick": stick}, {**GRAVITY, "rotation": {}}, joints=ties))
    found = measured(world, 120, "stick.position.x", "stick.position.y", "stick.angle")

    assert np.abs(found["stick.position.x"]).max() < 1e-12
    assert found["stick.position.y"] == pytest.approx(-0.5 * np.cos(found["stick.angle"]))
    assert np.ptp(found["stick.angle"]) > 1.9
