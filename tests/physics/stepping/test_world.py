"""Worlds: the same bits however they are run, a hand in them, and how they end."""

import hashlib
import os
from collections.abc import Callable

import numpy as np
import pymunk
import pytest

from sandbox.model.level import Level, Stepping
from sandbox.model.level_catalog import find
from sandbox.model.loading import load
from sandbox.physics.forces.attraction import Attraction
from sandbox.physics.measuring.recording import Recorder
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import BreakdownError, SimulationError
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping import kicks_without_drift
from sandbox.physics.stepping.make_world import make_world
from tests.elsewhere import python
from tests.physics.scenes import (
    GRAVITY,
    G,
    Spec,
    atwood,
    box,
    disc,
    fixed,
    floor,
    incline,
    level,
    orbit,
    path_length,
    run,
    table,
    worst,
)


def pile() -> Level:
    """Discs and boxes that sweeps pile up: contacts everywhere, impacts all the time."""
    makes: list[Callable[..., Spec]] = [disc, box]
    things: dict[str, Spec] = {
        f"thing{i}": makes[i % 2](
            (0.3 * ((7 * i) % 11) - 1.5, 1 + 0.6 * i), mass=1 + i % 3, friction=0.5, restitution=0.3
        )
        for i in range(16)
    }
    rest = {"friction": 0.8, "restitution": 1}
    wall = {"type": "segment", "start": [0, -1], "end": [0, 20]}
    walls = {"left": fixed(wall, (-2.5, 0), **rest), "right": fixed(wall, (2.5, 0), **rest)}
    swept = {"contact": {"solver": "iterative"}}
    effects = {**GRAVITY, **swept, "friction": {}, "restitution": {}, "rotation": {}}
    return level({**things, "floor": floor(**rest), **walls}, effects)


SCENES: dict[str, Callable[[], Level]] = {
    "pile": pile,
    "table": lambda: table(0.3),
    "atwood": lambda: atwood(1, 2),
    "orbit": orbit,
}
scenes = pytest.mark.parametrize("name", SCENES)


def digest(snapshot: Snapshot) -> str:
    """Every bit of a state."""
    arrays = (getattr(snapshot, name) for name in Snapshot.__slots__)
    return hashlib.sha256(b"".join(array.tobytes() for array in arrays)).hexdigest()


@scenes
def test_two_builds_run_alike_to_the_last_bit(name: str) -> None:
    one, other = (run(build(SCENES[name]()), 60) for _ in range(2))

    assert digest(one) == digest(other)


@scenes
def test_watching_does_not_change_a_run(name: str) -> None:
    """Stepped one by one and recorded, in one go, and unobserved: the same state."""
    watched, leaping, stepped = (build(SCENES[name]()) for _ in range(3))
    recorder = Recorder(watched, ["system.energy"])
    for _ in range(60):
        watched.advance()
        recorder.note()
    leaping.advance(60)
    for _ in range(59):
        stepped.step()
    stepped.advance()

    assert watched.t == leaping.t == stepped.t
    assert digest(watched.snapshot) == digest(leaping.snapshot) == digest(stepped.snapshot)


SCRIPT = """
from tests.physics.scenes import run
from tests.physics.stepping.test_world import build, digest, pile
print(digest(run(build(pile()), 90)))
"""


@pytest.mark.sweep
@pytest.mark.parametrize("seed", ["0", "1", "random"])
def test_another_process_runs_alike_to_the_last_bit(seed: str) -> None:
    """Contact forces too, which are sums in an order that pymunk takes from addresses."""
    done = python("-c", SCRIPT, environment={**os.environ, "PYTHONHASHSEED": seed})

    assert done.stdout.strip() == digest(run(build(pile()), 90)), done.stderr


ROD = {"type": "rod", "ends": [[0, 0], "bob"]}


@pytest.mark.parametrize(
    ("scene", "hooks", "callbacks"),
    [
        (level({"ball": disc()}, {}), 0, 0),
        (level({"ball": disc()}, GRAVITY), 0, 0),
        (incline(0.5, 0.3), 0, 0),
        (pile(), 0, 0),
        (orbit(), 1, 1),
        (orbit(scheme="explicit-euler"), 1, 0),
        (atwood(1, 2), 1, 0),
        (level({"bob": disc((1, 0))}, GRAVITY, joints={"rod": ROD}), 1, 0),
        (level({"ball": disc()}, {"drag": {"linear": 1}}), 1, 1),
        (level({"ball": disc(), "floor": floor(-1)}, {"contact": {"located": ["ball"]}}), 1, 0),
        (table(), 2, 1),
    ],
    ids=[
        "nothing",
        "gravity",
        "friction",
        "pile",
        "attraction",
        "early",
        "string",
        "rod",
        "drag",
        "located",
        "table",
    ],
)
def test_python_runs_only_for_laws_strings_and_located_impacts(
    scene: Level, hooks: int, callbacks: int
) -> None:
    """Some of it out of pymunk's step: early forces, cuts of a drift, and what joints do."""
    world = build(scene)

    assert world.hooks == hooks
    assert len(world.scene.space.constraints) == callbacks


def test_a_pair_with_a_coefficient_of_its_own_is_counted_as_a_callback() -> None:
    pair = {"pairs": [{"bodies": ["box", "floor"], "coefficient": 0.3}]}
    effects = {**GRAVITY, "contact": {}, "friction": pair}

    assert build(level({"box": box((0, 0.25)), "floor": floor()}, effects)).hooks == 1


def test_what_goes_wrong_inside_a_step_comes_out_of_it(
    capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """pymunk alone would print it and carry on."""

    def broken(*given: object) -> None:
        raise LookupError(given)

    world = build(orbit())
    monkeypatch.setattr(Attraction, "add", broken)
    with pytest.raises(BreakdownError) as caught:
        world.advance()
    assert isinstance(caught.value.__cause__, LookupError)
    with pytest.raises(BreakdownError):  # and nobody can go on with such a world
        world.step()
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("contact", [False, True])
def test_a_body_that_is_nowhere_any_more_stops_the_run(contact: bool) -> None:
    """A force that has a pole just after the duration. The last good state stays."""
    bodies = {"moon": disc((3, 0)), "planet": disc((1, 0))}
    effects: Spec = {"force": [{"body": "planet", "force": ["1/(60*t - 1)", 0]}]}
    if contact:
        effects["contact"] = {}
    world = build(level(bodies, effects, duration=0.01))
    with pytest.raises(
        SimulationError, match=r"t = 0\.0166667 s: the position of 'planet'"
    ) as caught:
        world.advance()

    assert caught.value.subject == "planet"
    assert caught.value.time == 1 / 60
    with pytest.raises(SimulationError, match=r"t = 0\.0166667 s"):  # and it stays there
        world.advance()
    assert world.snapshot.t == 0
    assert np.isfinite(world.snapshot.position).all()


def test_before_the_first_step_only_bodies_that_move_are_held(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """pymunk calls Python for each of them, at each of up to 500 repetitions of a kick."""
    held = set[pymunk.Body]()
    monkeypatch.setattr(kicks_without_drift, "_stay", lambda body, _: held.add(body))
    things = {"resting": disc((0, 1)), "flying": disc((2, 1), velocity=(3, 4)), "floor": floor()}

    world = build(level(things, {**GRAVITY, "contact": {"solver": "iterative"}}))

    assert held == {world.scene.bodies["flying"]}
    assert world.snapshot.position.tolist() == [[0, 1], [2, 1], [0, 0]]


def test_there_is_no_state_to_observe_without_a_step() -> None:
    with pytest.raises(ValueError, match="steps is 0"):
        build(orbit()).advance(0)


@pytest.mark.usefixtures("boundless")
def test_a_run_that_leaves_the_range_of_floats_says_so() -> None:
    effects = {"gravity": {"acceleration": [1e153, 0]}, "contact": {}}
    world = build(level({"a": floor(), "b": disc((9, 0.5))}, effects))
    with pytest.raises(SimulationError, match="'b'"):
        world.advance(600)


def test_nothing_but_static_bodies_is_a_world_too() -> None:
    world = build(level({"floor": floor()}, {}))

    assert world.advance(10).position.tolist() == [[0, 0]]


@pytest.mark.parametrize("rate", [1, 100_000])
def test_any_rate_of_the_format_will_do(rate: int) -> None:
    """Falling for ten steps; the acceleration is a difference of velocities over a step."""
    stepping = {"rate": rate}
    end = build(level({"ball": disc()}, GRAVITY, stepping=stepping)).advance(10)

    assert end.position[0, 1] == pytest.approx(-G * (10 / rate) ** 2 / 2, rel=1e-12)
    assert end.acceleration[0, 1] == pytest.approx(-G, rel=1e-10)


def test_a_body_that_is_held_follows_the_hand() -> None:
    world = build(atwood(1, 1))
    before = world.disturbed
    world.grab("left", (-0.5, 0))
    for _ in range(60):
        world.drag((-1, 0.5))
        world.advance()

    assert (before, world.disturbed) == (False, True)
    assert world.snapshot.position[0] == pytest.approx([-1, 0.5], abs=0.05)  # 1e-3


def test_a_body_let_go_is_free_again() -> None:
    world = build(level({"ball": disc()}, GRAVITY))
    world.grab("ball", (0, 0))
    world.advance(60)
    assert world.snapshot.position[0] == pytest.approx([0, 0], abs=0.05)
    world.release()
    fall = run(world, 30)

    assert worst(fall.acceleration[1:, 0], np.array([0, -G])) <= 1e-10
    world.release()  # nothing held: nothing happens
    world.drag((5, 5))
    world.advance()


def test_a_hand_holds_one_body_at_a_time() -> None:
    world = build(level({"a": disc(), "b": disc((5, 0))}, {}))
    world.grab("a", (0, 0))
    world.grab("b", (5, 0))

    assert len(world.scene.space.constraints) == 1


def test_a_body_that_is_placed_goes_on_with_its_velocity() -> None:
    """As if it had started there: again exact from the first step on."""
    world = build(level({"ball": disc(velocity=[3, 8])}, GRAVITY))
    before = world.advance(30)
    placed = world.place({"ball": (7, 7)})
    flight = run(world, 60)
    t = flight.t - placed.t

    assert world.disturbed
    assert placed.t == before.t
    assert placed.position[0].tolist() == [7, 7]
    assert np.array_equal(placed.velocity, before.velocity)
    vx, vy = placed.velocity[0]
    assert worst(flight.position[:, 0, 0], 7 + vx * t) <= 1e-12
    assert worst(flight.position[:, 0, 1], 7 + vy * t - G * t**2 / 2) <= 1e-12


def test_a_bead_that_is_placed_beyond_its_wire_ends_the_run_with_a_reason() -> None:
    world = build(load(find("energy/curved-ramp")))
    width, height = world.values["width"], world.values["height"]

    with pytest.raises(SimulationError, match="end of 'ramp'; make the wire longer"):
        world.place({"ball": (1.2 * width, 1.44 * height)})
    with pytest.raises(SimulationError, match="make the wire longer"):
        world.advance()


def test_strings_are_cut_to_fit_when_a_body_is_placed() -> None:
    world = build(atwood(1, 1))
    world.advance(10)
    world.place({"left": (-0.5, -2)})
    rest = run(world, 60)

    pegs = [(-0.5, 3), (0.5, 3)]
    assert worst(path_length(rest, pegs), 3 + 1 + 5) <= 1e-12
    assert worst(rest.tension, G) <= 1e-11


def test_a_body_placed_on_a_surface_is_held_from_the_first_step_on() -> None:
    bodies = {"block": box((0, 5), friction=0.5), "floor": floor(friction=1)}
    world = build(level(bodies, {**GRAVITY, "contact": {}, "friction": {}}))
    world.place({"block": (3, 0.25)})
    rest = run(world, 60)

    assert worst(rest.position[:, 0], np.array([3, 0.25])) <= 1e-12
    assert worst(rest.normal[:, 0], G) <= 1e-10


def test_worlds_are_independent_of_each_other() -> None:
    alone = run(build(pile()), 30)
    world, other = build(pile()), build(pile())
    interleaved = [world.snapshot]
    for _ in range(30):
        interleaved.append(world.advance())
        other.place({"thing0": (0, 9)})

    assert digest(Snapshot.stack(interleaved)) == digest(alone)


def test_a_world_has_a_rate_whatever_accuracy_its_level_asks_for() -> None:
    """Only `build` looks for a setting; nothing runs at 60 Hz because nobody chose."""
    scene = atwood(1, 2)

    with pytest.raises(ValueError, match="no rate is chosen"):
        make_world(scene, scene.defaults, Stepping(accuracy=1e-6))
