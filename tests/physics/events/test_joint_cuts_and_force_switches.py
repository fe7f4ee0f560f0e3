"""Events that act: what is cut or switched is so at its own time, and the books know it."""

from math import cos, exp, pi, sin, sqrt
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sandbox.model.errors import LevelError
from sandbox.model.level import Level
from sandbox.physics.energy.ledger import Ledger
from sandbox.physics.run import build
from sandbox.physics.stepping.run_continuation import branch
from sandbox.physics.stepping.world import World
from tests.physics.scenes import GRAVITY, G, booked, box, disc, floor, level

ROD = {"rod": {"type": "rod", "ends": [[0, 0], "bob"]}}
HELD = {"hold": {"type": "weld", "ends": ["ball", [0, 0]]}}
CROSSING = {"event": "crossing", "quantity": "bob.position.x", "value": -0.3}
SPRING = {"spring": {"type": "spring", "ends": [[0, 0], "ball"], "stiffness": 20, "length": 1}}


def dropped(t: float, rate: float) -> Level:
    events = {"go": {"at": t, "cut": ["hold"]}}
    bodies = {"ball": disc()}
    return level(bodies, GRAVITY, joints=HELD, events=events, stepping={"rate": rate})


def swung(rate: float) -> Level:
    """A bob that swings from the right, and is let go beyond the lowest point."""
    events = {"go": {"at": CROSSING, "cut": ["rod"]}}
    bodies = {"bob": disc((1, 0))}
    return level(bodies, GRAVITY, joints=ROD, events=events, stepping={"rate": rate})


def run(this: Level, seconds: float) -> World:
    world = build(this)
    world.advance(round(seconds * this.stepping.rate))
    return world


@settings(deadline=None, max_examples=25)
@given(t=st.floats(0, 1), rate=st.sampled_from([30, 47, 60, 240]))
def test_what_is_let_go_falls_from_that_instant_on_to_rounding(t: float, rate: float) -> None:
    seconds = 2.0
    ball = run(dropped(t, rate), seconds).snapshot

    assert ball.position[0, 1] == pytest.approx(-G * (seconds - t) ** 2 / 2, rel=2e-5)
    assert ball.velocity[0, 1] == pytest.approx(-G * (seconds - t), rel=2e-5)


def test_the_instant_is_not_that_of_a_step() -> None:
    ball = run(dropped(0.5037, 50), 1.5).snapshot

    assert ball.position[0, 1] == pytest.approx(-G * (1.5 - 0.5037) ** 2 / 2, rel=1e-13)


def test_a_crossing_is_located_to_second_order_and_what_follows_as_well() -> None:
    """Without gravity a bob goes round at one speed, and off along the tangent."""

    def off(rate: float) -> float:
        bodies = {"bob": disc((1, 0), velocity=[0, -2])}
        events = {"go": {"at": CROSSING, "cut": ["rod"]}}
        this = level(bodies, {}, joints=ROD, events=events, stepping={"rate": rate})
        x, y = run(this, 2.0).snapshot.position[0]
        angle = pi / 2 + np.arcsin(0.3)
        beyond = 2 * 2.0 - angle
        ways = x - cos(angle) + sin(angle) * beyond, y + sin(angle) + cos(angle) * beyond
        return float(np.hypot(*ways))

    coarse, fine = off(60), off(960)  # where in its step it is let go matters, too

    assert fine < 3e-6
    assert coarse / fine > 16**2 / 2


@pytest.mark.sweep
def test_the_energy_of_a_spring_that_is_cut_leaves_and_is_told() -> None:
    events = {"go": {"at": 0.2517, "cut": ["spring"]}}
    bodies = {"ball": disc((2, 0))}
    this = level(bodies, {}, joints=SPRING, events=events, stepping={"rate": 960})
    world = build(this)
    books = Ledger(world)
    for _ in range(600):
        world.advance()
        books.note()
    balance = books.balance

    left = 20 * cos(sqrt(20) * 0.2517) ** 2 / 2
    assert balance.work["events"] == pytest.approx(-left, rel=1e-4)
    assert balance.potential["spring"] == 0
    assert abs(balance.unexplained) < 1e-4 * 10
    assert np.abs(balance.unexplained_impulse).max() < 1e-12
    assert world.snapshot.tension[0] == 0


def test_a_steady_force_that_sets_in_and_ends_leaves_nothing_unexplained() -> None:
    push = [{"name": "push", "body": "ball", "force": [3, 0]}]
    events = {"on": {"at": 0.5037, "on": ["push"]}, "off": {"at": 0.9037, "off": ["push"]}}
    world = build(level({"ball": disc()}, {**GRAVITY, "force": push}, events=events))
    books = Ledger(world)
    for _ in range(90):
        world.advance()
        books.note()

    assert world.snapshot.velocity[0, 0] == pytest.approx(1.2, rel=1e-12)
    assert abs(books.balance.unexplained) < 1e-11
    assert np.abs(books.balance.unexplained_impulse).max() < 1e-11


def test_drag_that_is_switched_on_slows_down_from_then_on() -> None:
    events = {"wind": {"at": 0.5, "on": ["drag"]}}
    bodies = {"ball": disc(velocity=[2, 0])}
    this = level(bodies, {"drag": {"linear": 1}}, events=events, stepping={"rate": 240})

    assert run(this, 1.5).snapshot.velocity[0, 0] == pytest.approx(2 * exp(-1), rel=1e-5)


def test_a_rope_that_pulls_too_hard_takes_the_others_with_it() -> None:
    """Of two ropes that share a load the one that goes leaves all of it to the other."""
    ropes = {n: {"type": "rod", "ends": [[x, 1], "ball"]} for n, x in (("one", -1), ("two", 1))}
    events = {
        "first": {"at": 0.31, "cut": ["one"]},
        "second": {
            "at": {"event": "crossing", "quantity": "two.tension", "value": 8, "direction": "up"},
            "cut": ["two"],
        },
    }
    world = run(level({"ball": disc()}, GRAVITY, joints=ropes, events=events), 2)

    assert world.scene.event_times["first"] == pytest.approx(0.31, rel=1e-12)
    assert world.scene.event_times["second"] > 0.31
    assert world.snapshot.tension.tolist() == [0, 0]
    assert world.snapshot.acceleration[0, 1] == pytest.approx(-G, rel=1e-9)


@pytest.mark.parametrize("share", [0.1, 0.5, 0.9, 1.1, 1.7])
@pytest.mark.parametrize("effects", [{}, {"contact": {}}])
def test_an_event_while_a_rope_is_caught_is_nothing_to_what_hangs_on_it(
    share: float, effects: dict[str, object]
) -> None:
    """The rope is caught within a step from 0.4667 s on: it stops the bob at both ends of that."""
    rope = {"rope": {"type": "rope", "ends": [[0, 0], "bob"], "length": 1}}
    hold = {"hold": {"type": "weld", "ends": ["ball", [5, 0]]}}
    bodies = {"bob": disc((0.3, 0.1)), "ball": disc((5, 0)), "floor": floor(-9)}
    found = []
    for events in ({}, {"go": {"at": 0.4625 + share / 240, "cut": ["hold"]}}):
        this = level(
            bodies,
            {**GRAVITY, **effects},
            joints={**rope, **hold},
            events=events,
            stepping={"rate": 240},
        )
        world = build(this)
        books = Ledger(world)
        for _ in range(180):
            world.advance()
            books.note()
        found.append(world.snapshot.velocity[0])
        assert abs(books.balance.unexplained) < 1e-4
        assert books.balance.loss["impacts"] > 9

    assert found[1] == pytest.approx(found[0], abs=1e-12)


@pytest.mark.parametrize("solver", ["iterative", "direct"])
def test_a_box_that_is_let_go_comes_to_rest_on_the_floor(solver: str) -> None:
    bodies = {"ball": box((0, 0)), "floor": floor(-1)}
    effects = {**GRAVITY, "contact": {"solver": solver}}
    events = {"go": {"at": 0.5037, "cut": ["hold"]}}
    before = run(level(bodies, effects, joints=HELD, events=events), 0.5)
    assert before.snapshot.position[0, 1] == pytest.approx(0, abs=1e-12)

    world = run(level(bodies, effects, joints=HELD, events=events), 2)
    assert world.snapshot.position[0, 1] == pytest.approx(-0.75, abs=1e-5)
    assert world.snapshot.normal[0] == pytest.approx(G, rel=1e-6)


@pytest.mark.parametrize("solver", ["iterative", "direct"])
def test_a_push_that_ends_leaves_a_box_on_the_floor_alone(solver: str) -> None:
    push = [{"name": "push", "body": "box", "force": [3, 0]}]
    bodies = {"box": box((0, 0.25)), "floor": floor()}
    effects = {**GRAVITY, "contact": {"solver": solver}, "force": push}
    world = run(level(bodies, effects, events={"off": {"at": 0.5037, "off": ["push"]}}), 1)

    assert world.snapshot.velocity[0, 0] == pytest.approx(3 * 0.5037, rel=1e-9)
    assert world.snapshot.position[0, 1] == pytest.approx(0.25, abs=1e-5)
    assert world.snapshot.normal[0] == pytest.approx(G, rel=1e-6)


def test_looking_at_steps_changes_no_bit() -> None:
    one, other = build(swung(60)), build(swung(60))
    one.advance(90)
    for _ in range(90):
        other.advance()

    assert one.scene.event_times == other.scene.event_times
    assert (one.scene.batch.state() == other.scene.batch.state()).all()


def test_a_branch_knows_what_has_happened() -> None:
    world = build(swung(60))
    world.advance(60)
    branched = branch(world, world.values)

    assert branched.scene.event_times == world.scene.event_times
    ahead, behind = world.advance(30), branched.advance(30)
    assert behind.position == pytest.approx(ahead.position, rel=1e-12)


def test_welded_bodies_that_are_cut_apart_can_meet() -> None:
    bodies = {"ball": box((0, 0.25)), "top": box((0, 0.75)), "floor": floor()}
    joints = {"glue": {"type": "weld", "ends": ["ball", "top"]}}
    effects = {**GRAVITY, "contact": {}, "rotation": {}}
    events = {"go": {"at": 0.1, "cut": ["glue"]}}
    world = run(level(bodies, effects, joints=joints, events=events), 1)

    assert len(world.scene.joints.joined) == 0
    assert world.snapshot.position[1, 1] == pytest.approx(0.75, abs=1e-5)


@pytest.mark.parametrize(
    ("said", "told"),
    [
        (
            {"at": 1},
            "does nothing; give it something to 'cut', 'tie', switch 'on' or 'off', or 'reverse'",
        ),
        ({"at": 1, "cut": ["rood"]}, "unknown joint 'rood'; did you mean 'rod'?"),
        ({"at": 1, "on": ["pull"]}, "'pull' is not a force that can be switched"),
        (
            {"at": {"event": "crossing", "quantity": "bob.action"}, "cut": ["rod"]},
            "'bob.action' is not known between two steps",
        ),
    ],
)
def test_what_an_event_cannot_do_is_told(said: dict[str, Any], told: str) -> None:
    with pytest.raises(LevelError, match=told.replace("?", r"\?")):
        level({"bob": disc((1, 0))}, GRAVITY, joints=ROD, events={"go": said})


def test_fourth_order_is_refused() -> None:
    with pytest.raises(LevelError, match="the event 'go', at which forces jump"):
        level(
            {"bob": disc((1, 0))},
            GRAVITY,
            joints=ROD,
            events={"go": {"at": 1, "cut": ["rod"]}},
            stepping={"scheme": "fourth-order"},
        )


@pytest.mark.parametrize("rate", [60, 240])
def test_drag_that_sets_in_takes_what_it_takes(rate: float) -> None:
    """A parachute opens at 25 m/s; at 60 Hz 59 J were left, and 6.3 J at 240 Hz."""
    opens = {"event": "crossing", "quantity": "jumper.speed", "value": 25, "direction": "up"}
    scene = level(
        {"jumper": disc((0, 1000), radius=0.3, mass=80)},
        {**GRAVITY, "drag": {"quadratic": 15}},
        events={"opens": {"at": opens, "on": ["drag"]}},
        stepping={"rate": rate},
    )
    _, books = booked(scene, 4)

    assert books.balance.loss["drag"] > 10_000
    assert abs(books.balance.unexplained) < 1e-8
    assert np.abs(books.balance.unexplained_impulse).max() < 1e-9


def test_a_damper_takes_its_share_of_a_drift_in_which_bodies_are_welded() -> None:
    """What is left falls by second order; booked for the halves of the drift, 0.11, 0.13 J."""
    meet = {"event": "crossing", "quantity": "a.relative.c.distance", "value": 0.8}
    bodies = {
        "a": box((-1, 0), size=(0.6, 0.3), mass=2, velocity=[3, 0.5], angular_velocity=1),
        "c": box((1, 0.2), size=(0.6, 0.3), mass=5, angular_velocity=-2),
    }
    joints = {
        "weld": {"type": "weld", "ends": [{"body": "a", "at": [0.5, 0]}, "c"]},
        "spring": {
            "type": "spring",
            "ends": ["a", "c"],
            "stiffness": 200,
            "length": 1,
            "damping": 2,
        },
    }
    left = []
    for rate in (240, 480, 960):
        scene = level(
            bodies,
            {"rotation": {}},
            joints=joints,
            events={"dock": {"at": {**meet, "direction": "down"}, "tie": ["weld"]}},
            stepping={"rate": rate},
        )
        _, books = booked(scene, 0.3)
        left.append(abs(books.balance.unexplained))

    assert books.balance.loss["damping"] > 1
    assert left[2] < left[1] / 3.5 < left[0] / 3.5**2
