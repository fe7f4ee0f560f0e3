"""One-way surfaces let through what comes from one side, untouched, and hold it on the other."""

from itertools import product
from math import sqrt
from typing import Any

import numpy as np
import pytest

from sandbox.model.errors import LevelError
from sandbox.model.expressions import Array
from sandbox.model.level import Level
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import SimulationError
from tests.physics.scenes import GRAVITY, Spec, box, disc, fixed, floor, level

Said = dict[str, Any]

SOLVERS: dict[str, Said] = {
    "iterative": {},
    "direct": {"solver": "direct"},
    "located": {"located": ["ball"]},
}
LINES: dict[str, Spec] = {
    "segment": {"type": "segment", "start": [-3, 0], "end": [3, 0]},
    "thick segment": {"type": "segment", "start": [-3, 0], "end": [3, 0], "thickness": 0.1},
    "polyline": {"type": "polyline", "points": [[-3, 1], [-1, 0], [1, 0], [3, 1]]},
    "arc": {"type": "arc", "radius": 3, "start": "210*deg", "end": "330*deg"},
    "curve": {"type": "curve", "curve": ["s", "0.1*s**2"], "s": [-3, 3]},
}
"""Their left is above them. They are lowest where their body is, the arc 3 m below it."""

WAYS = [
    (line, solver, rate)
    for line, solver, rate in product(LINES, SOLVERS, (30, 240))
    if not (solver == "located" and line in ("arc", "curve"))
]
ROOM = 0.2
"""m, from the middle of what is thrown to its lower side."""

BODIES: dict[str, Spec] = {
    "disc": disc(radius=ROOM),
    "box": box(size=(0.5, 2 * ROOM)),
    "rod": {"shape": {"type": "segment", "start": [0, -ROOM], "end": [0, ROOM]}, "mass": 1},
}


def thrown(
    up: float,
    rate: float,
    solver: str = "iterative",
    line: str = "segment",
    body: str = "disc",
    hand: str | None = "left",
    **effects: Said,
) -> Level:
    """Return a body thrown up at so many m/s, from 1 m below a line that is at its lowest at 0."""
    bounces = {"restitution": 1} if "restitution" in effects else {}
    at = (0.0, 3.0 if line == "arc" else 0.0)
    through = {} if hand is None else {"one_way": hand}
    bodies = {
        "ball": {**BODIES[body], "position": [0, -1], "velocity": [0, up], **bounces},
        "line": fixed(LINES[line], at, **through, **bounces),
    }
    said = {**GRAVITY, "contact": SOLVERS[solver], **effects}
    return level(bodies, said, stepping={"rate": rate})


def heights(scene: Level, seconds: float) -> Array:
    """Return how high a body is at every step [m]."""
    world = build(scene)
    steps = round(seconds * scene.stepping.rate)
    return np.array([world.advance().position[0, 1] for _ in range(steps)])


def free(scene: Level, seconds: float) -> Array:
    """Return how high it is where nothing ever holds it."""
    alone = scene.model_copy(update={"bodies": {"ball": scene.bodies["ball"]}})
    contact = scene.effects.model_copy(update={"contact": None, "restitution": None})
    return heights(alone.model_copy(update={"effects": contact}), seconds)


@pytest.mark.parametrize(("line", "solver", "rate"), WAYS)
def test_a_ball_thrown_up_through_a_platform_lands_on_it(
    line: str, solver: str, rate: float
) -> None:
    """Up to its apex it is as high as one that flies free, to the last bit."""
    scene = thrown(6, rate, solver, line)
    seen, flight = heights(scene, 3), free(scene, 3)
    top = int(np.argmax(flight))

    half = 0.05 if line == "thick segment" else 0.0
    assert (seen[: top + 1] == flight[: top + 1]).all()
    assert seen[-1] == pytest.approx(ROOM + half, abs=2e-3)


@pytest.mark.parametrize("body", BODIES)
@pytest.mark.parametrize(("line", "solver", "rate"), WAYS[::2])
@pytest.mark.parametrize("above", [-0.02, 0.15])
def test_what_turns_round_half_way_falls_back_untouched(
    line: str, solver: str, rate: float, above: float, body: str
) -> None:
    """Its middle comes to below the line or above it, but its lower side does not."""
    scene = thrown(sqrt(2 * 9.81 * (1 + above)), rate, solver, line, body)

    assert (heights(scene, 1.5) == free(scene, 1.5)).all()


@pytest.mark.parametrize("rate", [60, 240])
@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("up", [7.9, 11.3, 17, 23.9, 40])
def test_however_fast_it_comes_it_is_not_taken_for_one_from_above(
    up: float, solver: str, rate: float
) -> None:
    """In a step it goes through half of itself, all of itself, or far beyond."""
    scene = thrown(up, rate, solver)
    rise = up / 9.81 * 0.9

    assert (heights(scene, rise) == free(scene, rise)).all()


@pytest.mark.sweep
@pytest.mark.parametrize("hand", ["left", "right", None])
def test_from_the_other_side_it_bounces_as_off_any_surface(hand: str | None) -> None:
    """Elastic and located, a ball bounces to where it came from, 1 m above the line."""
    said = {"ball": {**BODIES["disc"], "position": [0, 1 + ROOM], "restitution": 1}}
    line = fixed(LINES["segment"], restitution=1) | ({"one_way": hand} if hand else {})
    effects = {**GRAVITY, "contact": {"located": ["ball"]}, "restitution": {}}
    scene = level({**said, "line": line}, effects, stepping={"rate": 240})
    seen = heights(scene, 5)

    if hand == "right":
        assert (seen == free(scene, 5)).all()
    else:
        assert seen[600:].max() == pytest.approx(1 + ROOM, abs=1e-3)
        assert seen.min() >= ROOM - 1e-9


def test_impacts_in_sequence_come_from_one_side_only() -> None:
    """Of two equal balls that meet on their ways, only the upper bounces off the line."""
    bodies = {
        "upper": disc((0, 1.5), radius=0.1, velocity=[0, -2], restitution=1),
        "lower": disc((0, -0.5), radius=0.1, velocity=[0, 1], restitution=1),
        "line": fixed(LINES["segment"], one_way="left", restitution=1),
    }
    effects = {"contact": {}, "restitution": {"impacts": "sequence"}}
    world = build(level(bodies, effects, stepping={"rate": 240}))
    motions = [world.advance().velocity[:2, 1].round(9).tolist() for _ in range(960)]
    seen = list(dict.fromkeys(map(tuple, motions)))

    assert seen == [(-2, 1), (1, -2)] or seen == [(-2, 1), (2, 1), (1, 2)]


@pytest.mark.parametrize("solver", ["iterative", "direct", "located"])
def test_what_rests_on_it_at_the_start_is_held_and_what_is_in_it_falls(solver: str) -> None:
    contact = {"located": ["on", "in"]} if solver == "located" else SOLVERS[solver]
    bodies = {
        "on": box((-1, ROOM), size=(0.5, 2 * ROOM)),
        "in": box((1, 0.9 * ROOM), size=(0.5, 2 * ROOM)),
        "line": fixed(LINES["segment"], one_way="left"),
    }
    final = build(level(bodies, {**GRAVITY, "contact": contact}, stepping={"rate": 120})).advance(
        120
    )

    assert final.position[0, 1] == pytest.approx(ROOM, abs=1e-4)
    assert final.position[1, 1] == pytest.approx(0.9 * ROOM - 9.81 / 2, abs=1e-9)


@pytest.mark.sweep
@pytest.mark.parametrize("solver", ["iterative", "direct"])
def test_a_valve_that_moves_takes_along_what_it_holds(solver: str) -> None:
    """A line goes to the right: it goes past a ball on its open side, and pushes the other."""
    line = {"type": "segment", "start": [0, -1], "end": [0, 1]}
    bodies = {
        "kept": disc((0.5, 0.5), radius=0.1),
        "passed": disc((0.5, -0.5), radius=0.1),
        "for": {**fixed(line, one_way="right"), "type": "kinematic", "velocity": [1, 0]},
        "against": {
            **fixed({**line, "start": [0, -1], "end": [0, 0]}, (-3, 0), one_way="left"),
            "type": "kinematic",
            "velocity": [1, 0],
        },
    }
    contact = {"solver": solver, "apart": [["passed", "for"]]}
    world = build(level(bodies, {"contact": contact}, stepping={"rate": 240}))
    final = world.advance(5 * 240)

    assert final.position[0, 0] == pytest.approx(5.1, abs=2e-3)
    assert final.position[1, 0] == pytest.approx(0.5, abs=1e-12)


@pytest.mark.sweep
def test_a_closed_arc_lets_everything_in_and_nothing_out() -> None:
    """A gas around a cell comes to be within it, with the energy that it had."""
    cell = {"type": "arc", "radius": 1, "start": 0, "end": "2*pi"}
    wall = {"type": "polyline", "points": [[-2, -2], [2, -2], [2, 2], [-2, 2], [-2, -2]]}
    places = [(1.5 * np.cos(a), 1.5 * np.sin(a)) for a in np.arange(8) * np.pi / 4]
    bodies: dict[str, Spec] = {
        f"ball{i}": disc(place, radius=0.05, velocity=[1.3 - 0.3 * i, 0.7 * i - 1], restitution=1)
        for i, place in enumerate(places)
    }
    bodies |= {
        "cell": fixed(cell, one_way="left", restitution=1),
        "wall": fixed(wall, restitution=1),
    }
    world = build(level(bodies, {"contact": {}, "restitution": {}}, stepping={"rate": 960}))
    before = float((world.snapshot.velocity**2).sum())
    states = [world.advance(96) for _ in range(300)]
    far = np.array([np.hypot(*state.position[:8].T) for state in states])
    was_inside = np.logical_or.accumulate(far < 0.94)

    assert was_inside[-1].all()
    assert far[was_inside].max() < 0.95 + 8 / 960  # by which it may be too far after a step
    assert float((states[-1].velocity ** 2).sum()) == pytest.approx(before, rel=1e-6)


@pytest.mark.parametrize(
    ("said", "told"),
    [
        ({"shape": {"type": "disc", "radius": 1}}, "an arc or a curve can be one-way, not a disc"),
        ({"one_way": "up"}, "'left' or 'right'"),
    ],
)
def test_what_cannot_be_one_way_is_told(said: Said, told: str) -> None:
    line = {**fixed(LINES["segment"], one_way="left"), **said}
    with pytest.raises(LevelError, match=told):
        level({"ball": disc((0, 3)), "line": line}, {**GRAVITY, "contact": {}})


def test_a_surface_that_turns_without_end_is_told_by_name() -> None:
    """Its angle is not finite, and where bodies are was looked at before that was told."""
    line = {"shape": LINES["segment"], "mass": 1, "one_way": "left"}
    pushed: Said = {"contact": {}, "rotation": {}, "torque": [{"body": "line", "torque": "1/t"}]}
    world = build(level({"ball": disc((0, 3)), "line": line}, pushed))

    with pytest.raises(SimulationError, match="position of 'line' is no longer finite"):
        world.advance()


def test_a_surface_so_far_away_that_its_ends_are_one_point_moves_on() -> None:
    """Which of its points was nearest was asked of a line of no length."""
    line = {"shape": {"type": "polyline", "points": [[0, 1.45], [0.1, -1]]}, "mass": 1}
    plate = fixed({"type": "box", "width": 0.5, "height": 0.1})
    pushed: Said = {
        "contact": {"solver": "direct"},
        "rotation": {},
        "force": [{"body": "line", "force": [1e35, 2.42]}],
    }
    world = build(level({"line": line | {"one_way": "left"}, "plate": plate}, pushed))

    moved = world.advance(8).position[0, 0]

    assert moved == pytest.approx(1e35 * world.t**2 / 2, rel=1e-9)


def test_a_one_way_surface_needs_contact_and_nothing_sticks_to_it() -> None:
    bodies = {"ball": disc((0, 3)), "line": fixed(LINES["segment"], one_way="left")}
    with pytest.raises(LevelError, match="has no effect without 'contact'"):
        level(bodies, GRAVITY)
    sticking = {"pairs": [{"bodies": ["ball", "line"]}]}
    with pytest.raises(LevelError, match="nothing can stick to 'line'"):
        level(bodies, {**GRAVITY, "contact": {}, "sticking": sticking})


def test_where_no_surface_is_one_way_nothing_is_made_of_it() -> None:
    world = build(level({"ball": disc((0, 3)), "floor": floor()}, {**GRAVITY, "contact": {}}))

    assert world.scene.gates is None
    assert world.scene.pair_callbacks == 0
