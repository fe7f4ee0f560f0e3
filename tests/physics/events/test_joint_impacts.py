"""Joints that catch: what they hold from then on, and what the impact of that takes."""

from collections.abc import Mapping, Sequence
from math import pi, sqrt
from time import process_time
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sandbox.model.errors import LevelError
from sandbox.model.level import Level
from sandbox.physics.joints.exact.constraint_forces import ConstraintForces
from sandbox.physics.joints.exact.constraint_interface import Equation
from sandbox.physics.joints.exact.distance_equations import Row
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.stepping.run_continuation import branch
from tests.physics.scenes import GRAVITY, booked, box, disc, level

MEET = {"event": "crossing", "quantity": "hook.length", "value": 1.2, "direction": "down"}


def wagons(
    m1: float = 2,
    m2: float = 3,
    v: float = 4,
    rate: float = 60,
    kind: str = "weld",
    *,
    effects: Mapping[str, Any] | None = None,
    bodies: Mapping[str, Any] | None = None,
    joints: Mapping[str, Any] | None = None,
    **more: object,
) -> Level:
    """Return two wagons that are hooked to each other as they meet, and more beside them."""
    two = {"first": disc(mass=m1, velocity=[v, 0]), "second": disc((3.017, 0), mass=m2)}
    hook = {"type": kind, "ends": ["first", "second"], **more}
    return level(
        {**two, **(bodies or {})},
        effects or {},
        joints={"hook": hook, **(joints or {})},
        events={"click": {"at": MEET, "tie": ["hook"]}},
        stepping={"rate": rate},
    )


@pytest.mark.sweep
@given(
    st.floats(0.01, 100),
    st.floats(0.01, 100),
    st.floats(0.5, 50),
    st.sampled_from([30, 60, 240]),
    st.sampled_from(["weld", "rod", "pivot"]),
)
@settings(deadline=None, max_examples=12)
def test_a_coupling_takes_the_energy_of_the_motion_against_each_other_and_no_momentum(
    m1: float, m2: float, v: float, rate: float, kind: str
) -> None:
    world, books = booked(wagons(m1, m2, v, rate, kind), 1.817 / v + 0.2)
    balance = books.balance

    assert world.snapshot.velocity[:, 0] == pytest.approx(m1 * v / (m1 + m2), rel=1e-12)
    assert balance.loss["impacts"] == pytest.approx(m1 * m2 / (m1 + m2) * v**2 / 2, rel=1e-9)
    assert abs(balance.unexplained) < 1e-12 * m1 * v**2
    assert np.abs(balance.unexplained_impulse).max() < 1e-11 * m1 * v
    assert world.scene.event_times["click"] == pytest.approx(1.817 / v, rel=1e-12)


def test_it_holds_the_distance_at_which_it_was_tied_whatever_the_step() -> None:
    for rate in (30, 47, 240):
        world, _ = booked(wagons(rate=rate), 1)
        assert np.diff(world.snapshot.position[:, 0]) == pytest.approx(1.2, abs=1e-12)


def test_open_it_holds_nothing_and_pulls_at_nothing() -> None:
    world, _ = booked(wagons(), 0.3)

    assert world.snapshot.velocity[:, 0].tolist() == [4, 0]
    assert world.snapshot.tension[0] == 0


@pytest.mark.sweep
@pytest.mark.parametrize("kind", ["weld", "pivot", "rod", "rope"])
@pytest.mark.parametrize("effects", [{}, {"contact": {}}])
def test_what_is_caught_off_its_centre_turns_and_keeps_its_angular_momentum(
    kind: str, effects: dict[str, object]
) -> None:
    """Boxes that pass at some distance: the system has m1 v y of angular momentum, for good."""
    bodies = {"first": box((0, 1.1), mass=2, velocity=[4, 0]), "second": box((3.017, 0), mass=3)}
    ends = [{"body": "first", "at": [0, -0.2]}, {"body": "second", "at": [0.1, 0]}]
    event = {**MEET, "value": 1.3}
    this = level(
        bodies,
        {**effects, "rotation": {}},
        joints={"hook": {"type": kind, "ends": ends}},
        events={"click": {"at": event, "tie": ["hook"]}},
        stepping={"rate": 480},
    )
    world, books = booked(this, 1.5)
    now, moment = world.snapshot, world.scene.moment
    mass = np.array([2.0, 3.0])
    turning = now.position[:, 0] * now.velocity[:, 1] - now.position[:, 1] * now.velocity[:, 0]

    assert "click" in world.scene.event_times
    assert np.sum(mass * turning + moment * now.angular_velocity) == pytest.approx(-8.8, rel=1e-12)
    assert mass @ now.velocity == pytest.approx([8, 0], abs=1e-12)
    assert abs(books.balance.unexplained) < 1e-4
    assert np.abs(books.balance.unexplained_impulse).max() < 1e-6


def test_a_hook_at_the_wall_stops_what_it_catches_and_the_wall_takes_the_momentum() -> None:
    this = level(
        {"cart": disc(velocity=[3, 0])},
        {},
        joints={"hook": {"type": "rod", "ends": ["cart", [4, 0]]}},
        events={"caught": {"at": {**MEET, "value": 1}, "tie": ["hook"]}},
    )
    world, books = booked(this, 2)

    assert world.snapshot.position[0, 0] == pytest.approx(3, abs=1e-12)
    assert books.balance.loss["impacts"] == pytest.approx(4.5, rel=1e-12)
    assert books.balance.impulse["supports"][0] == pytest.approx(-3, rel=1e-12)


@pytest.mark.sweep
def test_a_spring_that_latches_is_slack_at_its_length_and_stores_from_there() -> None:
    """A cart that runs into an open spring is turned back with its speed, and pulled on by it."""
    spring = {"type": "spring", "ends": ["cart", [4, 0]], "stiffness": 40, "length": 1.5}
    this = level(
        {"cart": disc(velocity=[3, 0])},
        {},
        joints={"hook": spring},
        events={"caught": {"at": {**MEET, "value": 1.5}, "tie": ["hook"]}},
        stepping={"rate": 960},
    )
    world, books = booked(this, 2.5 / 3 + pi / sqrt(40) / 2)

    assert world.snapshot.position[0, 0] == pytest.approx(2.5 + 3 / sqrt(40), rel=1e-4)
    assert books.balance.potential["spring"] == pytest.approx(4.5, rel=1e-3)
    assert books.balance.work["events"] == pytest.approx(0, abs=1e-12)
    assert abs(books.balance.unexplained) < 1e-4


@pytest.mark.sweep
def test_a_spring_that_is_tied_stretched_brings_its_energy_and_that_is_told() -> None:
    spring = {"type": "spring", "ends": ["cart", [4, 0]], "stiffness": 40, "length": 1}
    this = level(
        {"cart": disc(velocity=[3, 0])},
        {},
        joints={"hook": spring},
        events={"caught": {"at": {**MEET, "value": 1.5}, "tie": ["hook"]}},
        stepping={"rate": 960},
    )
    _, books = booked(this, 1.2)

    assert books.balance.work["events"] == pytest.approx(40 * 0.5**2 / 2, rel=1e-9)
    assert abs(books.balance.unexplained) < 1e-4 * 5


def test_what_has_caught_can_be_cut_again() -> None:
    bodies = {"first": disc(velocity=[4, 0]), "second": disc((3, 0))}
    events = {
        "early": {"at": 0.1, "cut": ["hook"]},
        "click": {"at": MEET, "tie": ["hook"]},
        "open": {"at": 0.7, "cut": ["hook"]},
    }
    push = [{"name": "push", "body": "second", "force": [2, 0]}]
    joints = {"hook": {"type": "rod", "ends": ["first", "second"]}}
    world, _ = booked(level(bodies, {"force": push}, joints=joints, events=events), 1)

    apart = np.diff(world.snapshot.velocity[:, 0])
    latches = world.scene.joints.latches
    assert latches
    assert latches.tied["hook"] < 0.7
    assert apart == pytest.approx(2 * 0.3, rel=1e-9)
    assert world.snapshot.tension[0] == 0


def test_welded_wagons_and_all_that_hangs_on_them_take_part_at_once() -> None:
    """The momentum goes through a train of rods; a body on a slack rope is not in it."""
    bodies = {
        "first": disc(velocity=[6, 0]),
        **{f"w{i}": disc((3 + i, 0)) for i in range(3)},
        "trailer": disc((8, 0)),
    }
    joints = {
        "hook": {"type": "weld", "ends": ["first", "w0"]},
        "a": {"type": "rod", "ends": ["w0", "w1"]},
        "b": {"type": "rod", "ends": ["w1", "w2"]},
        "slack": {"type": "rope", "ends": ["w2", "trailer"], "length": 5},
    }
    events = {"click": {"at": MEET, "tie": ["hook"]}}
    world, books = booked(level(bodies, {}, joints=joints, events=events), 0.5)

    assert world.snapshot.velocity[:, 0] == pytest.approx([1.5, 1.5, 1.5, 1.5, 0], abs=1e-9)
    assert books.balance.loss["impacts"] == pytest.approx(18 - 4.5, rel=1e-9)


def test_a_branch_knows_what_has_caught() -> None:
    world, _ = booked(wagons(kind="rod"), 0.6)
    branched = branch(world, world.values)

    ahead, behind = world.advance(30), branched.advance(30)
    assert branched.scene.event_times == world.scene.event_times
    assert behind.position == pytest.approx(ahead.position, rel=1e-12)


def test_a_dog_that_is_leashed_beyond_its_leash_is_told() -> None:
    this = wagons(kind="rope", length=1)
    with pytest.raises(
        SimulationError, match=r"'hook' is tied when its ends are already 0\.2 beyond"
    ):
        booked(this, 1)


@given(
    st.floats(0.1, 10),
    st.floats(0.1, 10),
    st.floats(0.5, 20),
    st.sampled_from([30, 60, 240]),
    st.sampled_from(["weld", "rod", "pivot"]),
)
@settings(deadline=None, max_examples=6)
def test_a_coupling_breaks_before_it_gives_anything_if_it_bears_less_than_the_impact(
    m1: float, m2: float, v: float, rate: float, kind: str
) -> None:
    force = m1 * m2 / (m1 + m2) * v * rate  # which would give the impulse within a step
    together = m1 * v / (m1 + m2)
    for load, after in ((0.99 * force, [v, 0]), (1.01 * force, [together] * 2)):
        world, books = booked(wagons(m1, m2, v, rate, kind, breaks_at=load), 1.817 / v + 0.1)

        assert world.snapshot.velocity[:, 0] == pytest.approx(after, rel=1e-12)
        assert ("hook breaks" in world.scene.event_times) == (load < force)
        assert abs(books.balance.unexplained) < 1e-12 * m1 * v**2


@pytest.mark.parametrize(("share", "after"), [(0.99, [1.6, 1.6, 0]), (1.01, [0.8, 0.8, 0.8])])
def test_what_catches_breaks_a_weak_link_behind_it(share: float, after: list[float]) -> None:
    """The link would have to give the third its share of the momentum, 5 kg · 0.8 m/s."""
    link = {"type": "rod", "ends": ["second", "third"], "breaks_at": 4 * 60 * share}
    third = disc((5, 0), mass=5)
    this = wagons(kind="rod", bodies={"third": third}, joints={"link": link})

    world, books = booked(this, 1)

    assert world.snapshot.velocity[:, 0] == pytest.approx(after, abs=1e-12)
    assert abs(books.balance.unexplained) < 1e-12


@pytest.mark.parametrize(("share", "after"), [(0.99, [-1.5, 3]), (1.01, [-1.5, -1.5])])
def test_a_bounce_off_a_stop_breaks_a_weak_link(share: float, after: list[float]) -> None:
    """The link would have to turn 1 kg back: 3 m/s before, half of that after it."""
    bodies = {
        "first": disc(mass=2, velocity=[3, 0]),
        "second": disc((1.5, 0), mass=1, velocity=[3, 0]),
    }
    stop = {"type": "stop", "ends": ["first", [5, 0]], "direction": [1, 0]}
    joints = {
        "stop": {**stop, "range": [-9, -3], "restitution": 0.5},
        "link": {"type": "rod", "ends": ["first", "second"], "breaks_at": 4.5 * 120 * share},
    }

    world, books = booked(level(bodies, {}, joints=joints, stepping={"rate": 120}), 1.2)

    assert world.snapshot.velocity[:, 0] == pytest.approx(after, abs=1e-12)
    assert abs(books.balance.unexplained) < 1e-12


@pytest.mark.parametrize("effects", [{}, {"contact": {}, "rotation": {}}])
def test_what_has_caught_breaks_when_its_force_has_grown(effects: dict[str, object]) -> None:
    """The hook pulls 2 kg of 5: with 2/5 of 2000 (t - 0.6) N, which are 1200 N at 2.1 s."""
    pull = {"body": "second", "force": ["2000*max(t - 0.6, 0)", 0], "name": "pull"}
    this = wagons(effects={**effects, "force": [pull]}, breaks_at=1200)

    world, _ = booked(this, 3)

    assert world.scene.event_times["hook breaks"] == pytest.approx(2.1, abs=1e-9)
    assert world.snapshot.velocity[:, 0] == pytest.approx([451.6, 1621.6], rel=1e-9)


@pytest.mark.parametrize("scheme", ["symplectic-euler", "explicit-euler"])
def test_eulers_schemes_catch_at_a_step_and_keep_the_momentum(scheme: str) -> None:
    this = wagons()
    stepping = this.stepping.model_copy(update={"scheme": scheme})
    world, books = booked(this.model_copy(update={"stepping": stepping}), 1)

    assert world.snapshot.velocity[:, 0] == pytest.approx(1.6, rel=1e-9)
    assert books.balance.loss["impacts"] == pytest.approx(9.6, rel=1e-9)


@pytest.mark.parametrize(
    ("joint", "told"),
    [
        ({"type": "rod", "length": 2}, "takes the distance that it finds; leave out 'length'"),
        ({"type": "rod", "exact": False}, "must be exact; leave out 'exact'"),
        ({"type": "spring", "stiffness": 9}, "needs its natural 'length'"),
    ],
)
def test_what_does_not_fit_a_joint_that_is_tied_is_told(
    joint: dict[str, object], told: str
) -> None:
    hook = {"ends": ["first", "second"], **joint}
    bodies = {"first": disc(), "second": disc((2, 0))}
    events = {"click": {"at": 1, "tie": ["hook"]}}
    with pytest.raises(LevelError, match=told):
        level(bodies, GRAVITY, joints={"hook": hook}, events=events)


def test_contacts_that_take_turns_are_refused() -> None:
    with pytest.raises(LevelError, match="needs the 'direct' solver; leave this out"):
        level(
            {"first": disc(), "second": disc((2, 0))},
            {**GRAVITY, "contact": {"solver": "iterative"}},
            joints={"hook": {"type": "rod", "ends": ["first", "second"]}},
            events={"click": {"at": 1, "tie": ["hook"]}},
        )


def test_a_joint_that_repeats_another_is_refused_as_it_is_tied() -> None:
    joints = {
        "rod": {"type": "rod", "ends": [[0, 0], "bob"]},
        "hook": {"type": "rod", "ends": [[0, 0], "bob"]},
    }
    events = {"click": {"at": 0.3, "tie": ["hook"]}}
    with pytest.raises(SimulationError, match="hook"):
        booked(level({"bob": disc((0, -1))}, GRAVITY, joints=joints, events=events), 1)


def test_joints_that_are_tied_at_once_are_laid_out_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each laid out the equations of all others again: 200 welds took a second more."""
    added: list[int] = []
    add = ConstraintForces.add

    def counted(self: ConstraintForces, rows: Sequence[Row], others: Sequence[Equation]) -> None:
        added.append(len(rows) + len(others))
        add(self, rows, others)

    monkeypatch.setattr(ConstraintForces, "add", counted)
    bodies = {f"b{i}": disc((1.5 * i, 0), velocity=[0.1 * i, 0]) for i in range(8)}
    welds = {f"w{i}": {"type": "weld", "ends": [f"b{i}", f"b{i + 1}"]} for i in range(7)}
    events = {"tied": {"at": 0.1, "tie": list(welds)}}
    world = build(level(bodies, {}, joints=welds, events=events))
    world.advance(12)

    assert added == [7 * 2]  # nothing turns here
    velocities = world.snapshot.velocity
    assert velocities[:, 0] == pytest.approx(np.full(8, 0.35), rel=1e-9)  # that of the centre


@pytest.mark.sweep
@pytest.mark.parametrize("backwards", [False, True])
def test_many_crossings_in_a_step_are_located_one_by_one(*, backwards: bool) -> None:
    """All that were still to come were located after each: 100 took 4 s in one step."""
    heights = [5 - 1e-6 * (i + 1) for i in range(100)]
    names = [f"e{i}" for i in range(100)]
    at = {"event": "crossing", "quantity": "ball.position.y", "direction": "down"}
    events = {
        name: {"at": {**at, "value": y}, "on": [f"push{name}"]}
        for name, y in zip(names, heights[::-1] if backwards else heights, strict=True)
    }
    pushes = [{"name": f"push{name}", "body": "other", "force": [1, 0]} for name in names]
    bodies = {"ball": disc((0, 5)), "other": disc((9, 5))}
    world = build(level(bodies, {**GRAVITY, "force": pushes}, events=events))
    start = process_time()
    world.advance()

    assert process_time() - start < 2  # 0.5 s
    found = [world.scene.event_times[name] for name in names]
    fallen = 5 - np.array(heights[::-1] if backwards else heights)
    assert found == pytest.approx(np.sqrt(2 * fallen / 9.81), rel=1e-9)
