"""The solver of exact joints: whatever tree they make, what must hold holds."""

from collections.abc import Sequence
from math import cos, pi, sin, sqrt
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sandbox.model.level import Level, Stepping
from sandbox.physics.joints.exact.constraint_interface import Coordinates, Rows
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.stepping.world import World
from tests.physics.scenes import GRAVITY, Spec, disc, level, measured, worst

LINK = st.tuples(
    st.integers(0, 4),  # which of the earlier bodies it hangs on
    st.floats(-pi, pi),  # in which direction
    st.floats(0.3, 1.5),  # how far away
    st.floats(0.2, 5),  # kg
    st.floats(-1, 1),  # rad/s about the first body
    st.sampled_from(["rod", "rope", "pivot"]),
)
TREES = st.lists(LINK, min_size=1, max_size=6)
Links = Sequence[tuple[int, float, float, float, float, str]]


def tree(links: Links, rate: float) -> Level:
    """Bodies on rods, ropes and pins; each hangs on an earlier one, and all spin about the first.

    A pin is where an arm of the body meets the centre of the other. The spin is a rigid one, which
    rods and ropes can begin with.
    """
    place = [0j]
    spin = links[0][4]
    bodies = {"b0": disc((0, 0), radius=0.2)}
    joints: dict[str, Spec] = {}
    for i, (parent, angle, far, mass, _, kind) in enumerate(_pinned(links), 1):
        on = min(parent, i - 1)
        place.append(place[on] + far * complex(cos(angle), sin(angle)))
        x, y = place[i].real, place[i].imag
        bodies[f"b{i}"] = disc(
            (x, y), radius=0.2, mass=mass, velocity=[-spin * y, spin * x], angular_velocity=spin
        )
        ends: list[Any] = [f"b{on}", f"b{i}"]
        if kind == "pivot":
            back = place[on] - place[i]
            ends[1] = {"body": f"b{i}", "at": [back.real, back.imag]}
        joints[f"j{i}"] = {"type": kind, "ends": ends}
    return level(bodies, {"rotation": {}}, joints=joints, stepping={"rate": rate})


@pytest.mark.sweep
@settings(max_examples=20, deadline=None)
@given(TREES)
def test_a_tree_of_joints_keeps_its_lengths_and_its_momenta(links: Links) -> None:
    """Nothing acts from outside; ropes may go slack, and be taken up with a jerk."""
    scene = tree(links, 240)
    lengths = [f"j{i}.length" for i in range(1, len(links) + 1)]
    momenta = ["system.momentum.x", "system.momentum.y", "system.angular_momentum"]
    found = measured(build(scene), 240, *lengths, *momenta)

    for name in momenta:
        assert np.ptp(found[name]) <= 1e-12 * (1 + np.abs(found[name]).max())  # 2e-15
    for name, link in zip(lengths, _pinned(links), strict=True):
        far, kind = link[2], link[5]
        if kind == "rope":
            assert found[name].max() <= far * (1 + 1e-10)
        else:
            assert worst(found[name], 0.0 if kind == "pivot" else far) <= 1e-10  # 1e-15


def _pinned(links: Links) -> Links:
    """Return the links with a pin in front: something must be able to turn."""
    first, *rest = links
    return [(*first[:5], "pivot"), *rest]


def hanging(links: Links, rate: float) -> Level:
    """Return a tree of rods and pins that hangs from a nail."""
    rigid = [(*link[:4], 0.0, "rod" if link[5] == "rope" else link[5]) for link in links]
    told = tree(rigid, rate).model_dump(mode="json", exclude_none=True)
    joints = {**told["joints"], "nail": {"type": "rod", "ends": [[0, 1], "b0"]}}
    return level(
        told["bodies"], {**GRAVITY, "rotation": {}}, joints=joints, stepping={"rate": rate}
    )


def energy_swing(links: Links, rate: float) -> float:
    found = measured(build(hanging(links, rate)), round(0.3 * rate), "system.energy")
    return float(np.abs(found["system.energy"] - found["system.energy"][0]).max())


@pytest.mark.sweep
@settings(max_examples=8, deadline=None)
@given(TREES)
def test_the_energy_of_a_hanging_tree_is_of_second_order(links: Links) -> None:
    coarse, fine = (energy_swing(links, rate) for rate in (1000, 2000))

    assert fine <= max(coarse / 3.5, 1e-9)  # coarse / 4.00


def turned_back(world: World, steps: int) -> None:
    """Let a world run, turn all velocities round, and run as far back."""
    world.advance(steps)
    batch = world.scene.batch
    drift = batch.velocity() * world.dt
    state = batch.state()
    for i, body in enumerate(world.scene.bodies.values()):
        body.position = tuple(state[i, :2] + drift[i, :2])
        body.angle = float(state[i, 2] + drift[i, 2])
    batch.set_velocity(-batch.velocity())


@pytest.mark.sweep
@settings(max_examples=8, deadline=None)
@given(TREES)
def test_a_tree_runs_back_to_where_it_came_from(links: Links) -> None:
    """Leapfrog with constraints is symmetric: after one more drift, -v is its own inverse."""
    world = build(hanging(links, 480))
    start = world.scene.batch.state()[:, :3].copy()
    turned_back(world, 240)
    world.advance(241)
    back = world.scene.batch.state()[:, :3]

    assert np.abs(back - start).max() <= 1e-9  # 1e-15


@pytest.mark.parametrize("rate", [60, 240, 1000])
@pytest.mark.parametrize("links", [2, 3])
def test_a_chain_that_a_hand_pulls_straight_is_told_from_one_that_is_too_stiff(
    links: int, rate: float
) -> None:
    """The links are a metre each, and the hand moves away from the nail by a metre a second."""
    places = [(0, -1), (1, -1)] if links == 3 else [(0.5, -sqrt(0.75))]
    hand = {"type": "kinematic", "shape": {"type": "disc", "radius": 0.1}, "velocity": [1, 0]}
    bodies = {f"b{i}": disc(place) for i, place in enumerate(places)}
    ends = [[0, 0], *bodies, "hand"]
    joints = {f"r{i}": {"type": "rod", "ends": ends[i : i + 2]} for i in range(links)}
    scene = level(
        {**bodies, "hand": {**hand, "position": [1, 0]}},
        GRAVITY,
        joints=joints,
        stepping={"rate": rate},
    )
    with pytest.raises(SimulationError, match=r"and the joints beside it are stretched") as told:
        build(scene).advance(round(3 * rate))
    assert told.value.time == pytest.approx(links - 1, abs=0.1)


@pytest.mark.parametrize(
    ("link", "load", "says", "had"),
    [
        (0.1, 1e3, "a higher 'rate' may help: ", True),
        (0.01, 1e8, "no 'rate' that is allowed is enough", False),
    ],
)
def test_a_chain_that_is_too_stiff_for_the_step_asks_for_a_higher_rate(
    link: float, load: float, says: str, *, had: bool
) -> None:
    bodies = {f"b{i}": disc((link * i, 0)) for i in range(1, 21)}
    bodies["b20"]["mass"] = load
    ends = [[0, 0], *bodies]
    joints = {f"r{i}": {"type": "rod", "ends": ends[i : i + 2]} for i in range(20)}
    with pytest.raises(SimulationError, match=says) as told:
        build(level(bodies, GRAVITY, joints=joints)).advance(60)
    assert (told.value.rate is not None) == had


def linkage(rate: float) -> Level:
    """Two cranks, a coupler as long as it must be, and a heavy bob that hangs from one of them."""
    size = {"type": "box", "width": 0.05, "height": 0.6028}
    cranks = {
        "a": ((0.236113464706, -0.187329634027), 0.152, 0.9001),
        "b": ((1.521760473439, -0.204118231474), 0.2, 0.8268),
    }
    bodies: dict[str, Spec] = {
        name: {"shape": size, "position": list(place), "mass": mass, "angle": angle}
        for name, (place, mass, angle) in cranks.items()
    }
    bodies["bob"] = disc((1.743520946878, -0.908236462948), radius=0.1, mass=9.63)
    top, low = ([{"body": name, "at": [0, y]} for name in cranks] for y in (0.3014, -0.3014))
    joints = {
        "pin_a": {"type": "pivot", "ends": [[0, 0], top[0]]},
        "pin_b": {"type": "pivot", "ends": [[1.3, 0], top[1]]},
        "coupler": {"type": "rod", "ends": low},
        "hanger": {"type": "rod", "ends": [low[1], "bob"]},
    }
    effects = {**GRAVITY, "rotation": {}}
    return level(bodies, effects, joints=joints, stepping={"rate": rate})


@pytest.mark.sweep
def test_a_linkage_that_whips_asks_for_a_rate_at_which_it_holds() -> None:
    """At 480 Hz Newton's method came to a motion with 7e7 J; no rate was said to be enough."""
    with pytest.raises(SimulationError) as told:
        build(linkage(480)).advance(480)
    rate = told.value.rate
    assert rate is not None
    assert 480 < rate <= 4 * 480  # 1,620

    energy = measured(build(linkage(rate)), rate, "system.energy")["system.energy"]
    assert np.ptp(energy) <= 0.2  # J: 0.055, of 17.7 that are in motion


def test_a_rod_whose_length_ends_after_the_run_says_so() -> None:
    """Checked up to the duration; who runs on is told what ended."""
    rod = {"type": "rod", "ends": [[0, 3], "ball"], "length": "sqrt(9 - 19.8*t)"}
    world = build(level({"ball": disc()}, GRAVITY, joints={"reel": rod}, duration=0.4))
    with pytest.raises(
        SimulationError, match=r"the constraint of 'reel' has no finite value at t = 0.467"
    ):
        world.advance(60)


@pytest.mark.parametrize(
    ("joints", "named"),
    [
        ({"a": ["rod", [0, 1], "p"], "b": ["rod", [0, 1], "p"]}, "b"),
        ({"a": ["pivot", [0, 0], "p"], "b": ["rod", [0, 1], "p"]}, "b"),
        ({"a": ["rod", [-1, 0], "p"], "b": ["rod", "p", [1, 0]]}, "b"),
        (
            {
                "a": ["rod", [0, 1], "p"],
                "b": ["rod", "p", "q"],
                "c": ["rod", [3, 0], "q"],
                "d": ["rod", [3, 1], "q"],
                "e": ["rod", [3, 2], "q"],
            },
            "e",
        ),
    ],
)
def test_joints_that_repeat_each_other_are_named_at_the_start(
    joints: dict[str, list[Any]], named: str
) -> None:
    made = {name: {"type": kind, "ends": ends} for name, (kind, *ends) in joints.items()}
    scene = level({"p": disc((0, 0)), "q": disc((2, 0))}, GRAVITY, joints=made)
    with pytest.raises(SimulationError, match=f"'{named}' is redundant"):
        build(scene)


@pytest.mark.sweep
@pytest.mark.parametrize("scheme", ["leapfrog", "fourth-order"])
@pytest.mark.parametrize("ends", [[[0, 0], "bob"], ["bob", [0, 0]], ["car", "bob"]])
def test_rods_that_do_not_meet_move_as_beside_two_that_do(ends: list[Any], scheme: str) -> None:
    """They are solved in floats, and beside two that meet all in arrays: to rounding."""
    bodies = {
        "car": disc((0, 0), mass=3, velocity=[0.5, 2]),
        "bob": disc((0.6, 0.8), mass=2, velocity=[-0.3, 2.6]),
        "far": disc((10, 0)),
    }
    if "car" not in ends:
        bodies["bob"]["velocity"] = [-0.8, 0.6]
    rods = {
        "rod": {"type": "rod", "ends": ends},
        "swing": {"type": "rod", "ends": [[9, 0], "far"], "length": "1 + 0.1*sin(t)**2"},
    }
    stepping = {"rate": 240, "scheme": scheme}
    if scheme == "fourth-order":
        del rods["swing"]["length"]
    apart = build(level(bodies, GRAVITY, joints=rods, stepping=stepping))
    bodies |= {"upper": disc((20, 0)), "lower": disc((21, 0))}
    rods["one"] = {"type": "rod", "ends": [[19, 0], "upper"]}
    rods["two"] = {"type": "rod", "ends": ["upper", "lower"]}
    together = build(level(bodies, GRAVITY, joints=rods, stepping=stepping))
    one, two = apart.advance(1200), together.advance(1200)

    assert np.abs(one.position - two.position[:3]).max() <= 1e-10
    assert np.abs(one.velocity - two.velocity[:3]).max() <= 1e-10
    assert one.tension == pytest.approx(two.tension[:2], rel=1e-9)


@pytest.mark.parametrize("kind", ["rod", "rope", "pivot", "wire"])
def test_joints_hold_as_well_far_from_the_origin(kind: str) -> None:
    """At 1e10 m a float knows a place to 2e-6 m: energies of 10 J are off by 1e-4 to 8e-4 J.

    Counted from the origin, no joint holds beyond 1e8 m.
    """
    far = 1e10
    bob, ends = disc((far + 1, 0), radius=0.1), [[far, 0], "bob"]
    joints: dict[str, Spec] = {
        "rod": {"type": "rod", "ends": ends},
        "rope": {"type": "rope", "ends": ends},
        "pivot": {"type": "pivot", "ends": [[far, 0], {"body": "bob", "at": [-1, 0]}]},
        "wire": {
            "type": "wire", "bead": "bob",
            "curve": [f"{far} + cos(s)", "sin(s)"], "s": [0, "2*pi"],
        },
    }  # fmt: skip
    effects = {**GRAVITY, "rotation": {}} if kind == "pivot" else GRAVITY
    world = build(
        level({"bob": bob}, effects, joints={kind: joints[kind]}), stepping=Stepping(rate=480)
    )
    energy = measured(world, 480, "system.energy")["system.energy"]

    assert np.ptp(energy) <= 2e-3


def test_forces_where_joints_were_looked_at_last_need_no_other_look(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Unless other joints hold since: then their Jacobian is another."""
    bodies = {"a": disc((1, 0)), "b": disc((2, 0))}
    ends = {"one": [[0, 0], "a"], "two": ["a", "b"]}
    rods = {name: {"type": "rod", "ends": both} for name, both in ends.items()}
    joints = build(level(bodies, GRAVITY, joints=rods)).scene.joints.together
    assert joints
    pulls, place, looks = np.array([2.0, 3.0]), joints.pose(), [0]
    first, look = joints.wrenches(pulls, place), joints.evaluate

    def counted(at: Coordinates) -> Rows:
        looks[0] += 1
        return look(at)

    monkeypatch.setattr(joints, "evaluate", counted)

    assert np.array_equal(joints.wrenches(pulls, Coordinates(place.values.copy())), first)
    assert looks[0] == 0
    assert first[:, 0].tolist() == [1.0, -3.0]

    joints.drop("two")

    assert joints.wrenches(pulls[:1], place)[:, 0].tolist() == [-2.0, 0.0]
    assert looks[0] == 1
