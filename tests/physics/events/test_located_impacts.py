"""Impacts located in time: bullets, bounces at their own time, and what they keep."""

from math import cos, pi, sin, sqrt
from time import process_time

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from sandbox.model.errors import LevelError
from sandbox.model.expressions import Array
from sandbox.model.level import Level
from sandbox.physics.energy.ledger import Ledger
from sandbox.physics.run import build, simulate
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.world import World
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


def located(*names: str, **rest: object) -> Spec:
    return {"contact": {"located": names}, "restitution": {}, **rest}


def kinetic(world: World, flight: Snapshot) -> Array:
    scene = world.scene
    linear = np.sum(scene.mass * np.sum(flight.velocity**2, axis=-1), axis=-1)
    return np.asarray((linear + np.sum(scene.moment * flight.angular_velocity**2, axis=-1)) / 2)


def bouncing(e: float, rate: float, effects: Spec) -> Level:
    """A ball that falls 3 m."""
    return level(
        {"ball": disc((0, 3.2), radius=0.2, restitution=e), "floor": floor(restitution=1)},
        {**GRAVITY, **effects},
        stepping={"rate": rate},
    )


def height(t: float, e: float) -> float:
    """Return how high a ball is that fell 3 m, and bounced as often as it could [m]."""
    speed, fall = sqrt(2 * G * 3), sqrt(2 * 3 / G)
    if t < fall:
        return 3 - G * t * t / 2
    t -= fall
    while (speed := e * speed) > 1e-9:
        if t < 2 * speed / G:
            return speed * t - G * t * t / 2
        t -= 2 * speed / G
    return 0.0


@pytest.mark.parametrize("rate", [60, 240])
@pytest.mark.parametrize("e", [0, 0.3, 0.8, 1])
def test_a_bouncing_ball_is_where_the_textbook_has_it(rate: int, e: float) -> None:
    flight = run(build(bouncing(e, rate, located("ball"))), 3 * rate)
    expected = np.array([height(t, e) for t in flight.t])

    last = (G / rate / 2) ** 2 / 2 / G  # m, a bounce that a step does not see is none
    bound = last if e < 0.5 else 1e-12
    assert np.abs(flight.position[:, 0, 1] - 0.2 - expected).max() <= bound  # 2e-14 of 3 m


def test_without_locating_its_bounce_is_late() -> None:
    """The check above can fail."""
    flight = run(build(bouncing(0.8, 240, {"contact": {}, "restitution": {}})), 720)
    expected = np.array([height(t, 0.8) for t in flight.t])

    assert np.abs(flight.position[:, 0, 1] - 0.2 - expected).max() > 1e-2


@pytest.mark.sweep
def test_a_ball_that_hardly_bounces_any_more_rests() -> None:
    flight = run(build(bouncing(0.8, 240, located("ball"))), 10 * 240)

    assert np.abs(flight.position[-240:, 0, 1] - 0.2).max() <= 1e-8
    assert np.abs(flight.velocity[-240:, 0]).max() <= 1e-12
    assert worst(flight.normal[-240:, 0], G) <= 1e-9


@pytest.mark.sweep
def test_forty_nine_elastic_balls_keep_their_energy() -> None:
    """SimBenchmark's "bouncing": the mean of (E − E0)² is 1.9e-2 J² with the best published."""
    balls = {f"ball{i}": disc((0.5 * i, 5), radius=0.1, mass=10, restitution=1) for i in range(49)}
    scene = level(
        {**balls, "floor": floor(restitution=1)},
        {**GRAVITY, **located(*balls)},
        stepping={"rate": 1000},
    )
    energy = measured(build(scene), 2500, "system.energy")["system.energy"]

    assert np.mean((energy - 49 * 10 * G * 5) ** 2) <= 1e-15  # 1e-20


@pytest.mark.parametrize("shape", ["disc", "box"])
@pytest.mark.parametrize("speed", [10.0, 1e3, 1e6])
def test_no_bullet_passes_a_thin_wall(shape: str, speed: float) -> None:
    """At the most it goes 1.7 million times its own size in a step."""
    rest: Spec = {"velocity": [speed, 0.3 * speed], "angular_velocity": 3, "restitution": 0.5}
    bullet = disc((-1.04, 0), radius=0.005, **rest)
    if shape == "box":
        bullet = box((-1.04, 0), size=(0.01, 0.01), **rest)
    wall = fixed({"type": "box", "width": 0.001, "height": 1e8}, restitution=1)
    scene = {"bullet": bullet, "wall": wall}
    flight = run(build(level(scene, {**located("bullet"), "rotation": {}})), 60)

    assert flight.position[:, 0, 0].max() < 0
    assert flight.velocity[-1, 0, 0] < -0.3 * speed
    naive = run(build(level(scene, {**located("bullet"), "rotation": {}, "contact": {}})), 60)
    assert naive.position[-1, 0, 0] > 1, "pymunk alone does not see the wall"


def room() -> Spec:
    """Walls around 4 m x 3 m."""
    corners = [[0, 0], [4, 0], [4, 3], [0, 3]]
    return {
        f"wall{i}": fixed({"type": "segment", "start": corners[i - 1], "end": a}, restitution=1)
        for i, a in enumerate(corners)
    }


@st.composite
def crowds(draw: st.DrawFn) -> Spec:
    """Discs and boxes thrown about in a room, up to half of it a step."""
    bodies: Spec = {}
    for i in range(draw(st.integers(1, 8))):
        place = (0.5 + i % 4, 0.5 + i // 4)
        speed = 10 ** draw(st.floats(-1, 2))
        direction = draw(st.floats(0, 6.3))
        rest: Spec = {
            "mass": 10 ** draw(st.floats(-1, 1)),
            "velocity": [speed * np.cos(direction), speed * np.sin(direction)],
            "angular_velocity": draw(st.floats(-20, 20)),
            "restitution": 1,
        }
        made = disc(place, radius=0.15, **rest)
        bodies[f"body{i}"] = made if draw(st.booleans()) else box(place, size=(0.2, 0.3), **rest)
    return bodies


def block(place: tuple[float, float], velocity: tuple[float, float]) -> Spec:
    """A box that others meet face to face."""
    return box(place, size=(0.2, 0.3), velocity=list(velocity), restitution=1)


SQUARELY: Spec = {
    "body0": block((0.5, 0.5), (1, 0)),
    "body1": block((1.5, 0.5), (31.622776601683793, 0)),
    "body2": block((2.5, 0.5), (1, 0)),
}
"""One corner hits, and within the same step the other: a side that turns is near to both."""

SIDEWAYS: Spec = {
    "body0": block((0.5, 0.5), (0.5403023058681398, 0.8414709848078965)),
    "body1": block((1.5, 0.5), (31.622776601683793, 0)),
}
"""Two points that touch are 2 cm apart: what each gets depends on the other's 250 times as much."""


@pytest.mark.sweep
@settings(max_examples=25, deadline=None)
@given(crowds())
@example(SQUARELY)
@example(SIDEWAYS)
def test_elastic_bodies_keep_their_energy_and_stay_in_their_room(bodies: Spec) -> None:
    scene = level({**bodies, **room()}, {**located(*bodies), "rotation": {}})
    world = build(scene)
    flight = run(world, 30)
    energy, inside = kinetic(world, flight), flight.position[:, : len(bodies)]

    assert worst(energy, energy[0]) <= 1e-10  # 3e-14
    assert inside.min() > 0
    assert (inside < [4, 3]).all()


def test_an_impact_keeps_momentum_and_angular_momentum() -> None:
    """A bullet hits a board at its rim, and friction and e < 1 take what they may."""
    rest: Spec = {"restitution": 0.5, "friction": 0.5}
    bodies = {
        "bullet": disc((-2, 0.4), radius=0.01, mass=0.1, velocity=[200, -13], **rest),
        "board": box(size=(0.05, 1), mass=2, angle=0.3, **rest),
    }
    scene = level(bodies, {**located("bullet"), "rotation": {}, "friction": {}})
    found = measured(
        build(scene),
        60,
        "system.momentum.x",
        "system.momentum.y",
        "system.angular_momentum",
        "board.angular_velocity",
        "system.energy",
    )

    assert worst(found["system.momentum.x"], 20) <= 1e-14
    assert worst(found["system.momentum.y"], -1.3) <= 1e-13
    assert worst(found["system.angular_momentum"], found["system.angular_momentum"][0]) <= 1e-12
    assert np.abs(found["board.angular_velocity"][-1]) > 1
    assert found["system.energy"][-1] < found["system.energy"][0]


@pytest.mark.parametrize(("mu", "slows", "turns"), [(1.0, 2 / 3, -2 / 3), (0.05, None, None)])
def test_a_disc_that_rubs_as_it_bounces_is_turned(
    mu: float, slows: float | None, turns: float | None
) -> None:
    """It rolls off where friction holds it; else friction takes mu times what the floor gave."""
    rest: Spec = {"restitution": 0.9, "friction": mu}
    bodies = {
        "ball": disc((0, 1.1), radius=0.1, velocity=[2, 0], **rest),
        "floor": floor(restitution=1, friction=1),
    }
    scene = level(bodies, {**GRAVITY, **located("ball"), "rotation": {}, "friction": {}})
    end = build(scene).advance(40)
    push = 1.9 * sqrt(2 * G * 1.0)
    velocity = 2 * slows if slows else 2 - mu * push
    spin = 2 * turns / 0.1 if turns else -mu * push * 0.1 / (0.01 / 2)

    assert end.velocity[0, 0] == pytest.approx(velocity, rel=1e-12)
    assert end.angular_velocity[0] == pytest.approx(spin, rel=1e-12)


def test_a_box_that_lands_flat_does_not_turn() -> None:
    bodies = {"box": box((0, 2), size=(1, 0.5), restitution=0.8), "floor": floor(restitution=1)}
    flight = run(build(level(bodies, {**GRAVITY, **located("box"), "rotation": {}})), 60)

    assert np.abs(flight.angular_velocity).max() <= 1e-12
    assert flight.velocity[:, 0, 1].max() > 1


def test_a_ball_that_rolls_does_not_trip_where_lines_join() -> None:
    points = [[0.1 * i, 0] for i in range(90)]
    rest: Spec = {"restitution": 0.5, "friction": 1}
    bodies = {
        "ball": disc((0.33, 0.1), radius=0.1, velocity=[3, 0], angular_velocity=-30, **rest),
        "floor": fixed({"type": "polyline", "points": points}, **rest),
    }
    effects = {**GRAVITY, **located("ball"), "rotation": {}, "friction": {}}
    roll = run(build(level(bodies, effects)), 120)

    assert worst(roll.velocity[:, 0, 0], 3) <= 1e-12
    assert np.abs(roll.velocity[:, 0, 1]).max() <= 1e-12


def test_a_ball_on_a_spring_bounces_to_second_order() -> None:
    def end(rate: float) -> float:
        spring = {"type": "spring", "ends": [[0, 3], "ball"], "stiffness": 30, "length": 2.9}
        scene = level(
            {
                "ball": disc((0, 0.3), radius=0.1, velocity=[0, -3], restitution=0.7),
                "floor": floor(-0.1, restitution=1),
            },
            located("ball"),
            joints={"spring": spring},
            stepping={"rate": rate},
        )
        return float(build(scene).advance(round(rate / 4)).position[0, 1])

    right = end(7680)
    errors = [abs(end(rate) - right) for rate in (240, 960)]
    assert errors[1] <= 1e-5  # 4e-6
    assert errors[0] / errors[1] > 12, "16 for second order"


@pytest.mark.parametrize("names", [["ball0"], [f"ball{i}" for i in range(5)]])
def test_a_row_that_touches_passes_the_shot_on(names: list[str]) -> None:
    """Whether the row's own impacts are located, or left to the sequence at the next step."""
    balls = {
        f"ball{i}": disc(
            (0.2 * i - 0.35 * (i == 0), 0),
            radius=0.1,
            velocity=[2.0 * (i == 0), 0],
            restitution=1,
        )
        for i in range(5)
    }
    effects = {**located(*names), "restitution": {"impacts": "sequence"}}
    end = build(level(balls, effects)).advance(60)

    assert np.abs(end.velocity[:, 0] - [0, 0, 0, 0, 2]).max() <= 1e-12


@pytest.mark.parametrize("impacts", ["together", "sequence"])
@pytest.mark.parametrize(("rows", "e"), [(2, 1), (3, 0.5), (4, 0.9), (5, 0.5)])
def test_mirror_images_stay_so_where_a_break_is_located(rows: int, e: float, impacts: str) -> None:
    """Taken one after the other, impacts at the same time end up to 1.3 m/s apart."""
    places = [(i, 2 * j - i) for i in range(rows) for j in range(i + 1)]
    balls = {
        f"ball{k}": disc((0.05 * sqrt(3) * i, 0.05 * j), radius=0.05, restitution=sqrt(e))
        for k, (i, j) in enumerate(places)
    }
    cue = disc((-0.5, 0), radius=0.05, velocity=[3, 0], restitution=sqrt(e))
    effects = {**located(*balls, "cue"), "restitution": {"impacts": impacts}}
    end = build(level({**balls, "cue": cue}, effects)).advance(24)
    mirrored = [*(places.index((i, -j)) for i, j in places), len(places)]

    assert np.abs(end.velocity - end.velocity[mirrored] * [1, -1]).max() <= 1e-12  # 2e-15 m/s
    assert (np.abs(end.velocity[:, 1]) > 1e-3).any(), "they have met"


def test_a_ball_that_falls_straight_into_a_wedge_stays_in_the_middle() -> None:
    """It hits both sides at once, again and again; one after the other it went 5 cm aside."""
    sides = {
        side: fixed({"type": "segment", "start": [0, 0], "end": [x, 20]}, restitution=1)
        for side, x in (("left", -2), ("right", 2))
    }
    ball = disc((0, 3), radius=0.1, restitution=1)
    flight = run(build(level({"ball": ball, **sides}, {**GRAVITY, **located("ball")})), 120)

    assert flight.velocity[:, 0, 1].max() > 1
    assert np.abs(flight.position[:, 0, 0]).max() <= 1e-10


def between(play: float, speed: float, e: float = 1) -> Level:
    """A ball of 0.1 m between two walls, with some play."""
    wall = {"type": "box", "width": 0.2, "height": 4}
    walls = {
        side: fixed(wall, (way * (0.2 + play / 2), 0), restitution=1)
        for side, way in (("left", -1), ("right", 1))
    }
    ball = disc((0, 0), radius=0.1, velocity=[speed, 0], restitution=e)
    effects = located("ball")
    effects["contact"] = {"located": ["ball"], "overlaps": True}
    return level({"ball": ball, **walls}, effects)


@pytest.mark.sweep
@pytest.mark.parametrize(
    ("play", "speed", "said"),
    [
        (
            1e-3,
            100,
            "'ball' would have more than 500 impacts in one step: it is too fast for its room",
        ),
        (0, 1, "collide too often to be followed: .* or they are wedged in"),
        (-1e-3, 1, "collide too often to be followed: .* or they are wedged in"),
    ],
)
def test_a_ball_without_room_is_told_soon(play: float, speed: float, said: str) -> None:
    """They took 4 s a step."""
    start = process_time()
    with pytest.raises(SimulationError, match=said) as told:
        build(between(play, speed)).advance(5)

    assert process_time() - start < 1  # 0.25 s
    assert told.value.subject == "ball"


@pytest.mark.sweep
def test_a_long_row_that_cannot_be_followed_is_told_soon() -> None:
    """Each impact looked at all pairs of the row again: it took 10 s to be told."""
    balls = {
        f"ball{i}": disc((2 * i, 1), radius=1, restitution=0.5, velocity=[3 if i == 0 else 0, 0])
        for i in range(300)
    }
    scene = level(balls, located(*balls))
    start = process_time()
    with pytest.raises(SimulationError, match="more than 500 impacts in one step"):
        build(scene).advance()

    assert process_time() - start < 4  # 1.2 s


@pytest.mark.sweep
def test_a_crowd_that_cannot_be_followed_is_told_soon() -> None:
    """A hundred balls on each other had 3,100 impacts before it was told, 400 in a box 4,000."""
    balls = {f"ball{i}": disc((0, 0.2 * i), radius=0.1, restitution=0.9) for i in range(100)}
    floor = fixed({"type": "box", "width": 3, "height": 1}, (0, -0.6), restitution=1)
    scene = level({**balls, "floor": floor}, {**GRAVITY, **located(*balls)})

    with pytest.raises(SimulationError, match="more than 2,000 impacts in one step, 'ball"):
        build(scene).advance()


def test_a_ball_with_little_room_bounces_as_often_as_it_should() -> None:
    """1 mm of play, 20 m/s: 333 impacts in a 60th of a second."""
    world = build(between(1e-3, 20))
    world.advance()

    assert abs(len(world.impacts) - 20 / 60 / 1e-3) <= 1
    assert abs(world.snapshot.velocity[0, 0]) == 20


def test_what_loses_its_bounces_between_two_walls_comes_to_rest() -> None:
    """The first check above is for what does not: this has 70 impacts, and no more speed."""
    world = build(between(1e-6, 1, e=0.5))
    world.advance(60)

    assert np.abs(world.snapshot.velocity[0]).max() <= 1e-5


def test_a_cart_that_a_heavy_one_presses_on_a_dead_wall_stops_it() -> None:
    """0.1 kg is struck by 8.4 kg again and again, and loses its rebound at the wall each time.

    All that comes of it is that both stand; 10,000 impacts were not enough to see it.
    """
    bodies = {
        "light": box((-0.6, 0), mass=0.1, restitution=sqrt(0.066)),
        "heavy": box((0, 0), mass=8.4, velocity=[-1, 0], restitution=sqrt(0.066)),
        "wall": fixed({"type": "box", "width": 0.5, "height": 3}, (-1.1, 0), restitution=0),
    }
    end = build(level(bodies, located("light", "heavy"))).advance(60)

    assert np.abs(end.velocity).max() <= 1e-12
    assert np.abs(end.position[:2, 0] - [-0.6, -0.1]).max() <= 1e-8


@pytest.mark.parametrize("e", [0, 0.5])
def test_balls_that_a_plate_presses_on_the_ground_are_told_to_be_wedged_in(e: float) -> None:
    plate = fixed({"type": "box", "width": 1, "height": 0.2}, (0, 0.51), restitution=sqrt(e))
    balls = {
        name: disc((0, y), radius=0.1, restitution=sqrt(e))
        for name, y in (("low", 0.1), ("high", 0.3))
    }
    bodies = {
        **balls,
        "floor": floor(restitution=sqrt(e)),
        "plate": {**plate, "type": "kinematic", "velocity": [0, -1]},
    }
    scene = level(bodies, {**located(*balls), "restitution": {"impacts": "sequence"}})

    with pytest.raises(
        SimulationError, match=r"'(low|high)' is wedged in, since what presses on it"
    ):
        build(scene).advance(6)


@pytest.mark.parametrize(("speed", "gaps"), [(0.05, (0.01, 0.01)), (1, (0.3, 0.1))])
def test_three_alike_with_little_bounce_go_on_together(
    speed: float, gaps: tuple[float, float]
) -> None:
    """With e below 7 − 4 √3 = 0.0718 they collide for ever, within a moment."""
    places = (0, 0.5 + gaps[0], 1 + sum(gaps))
    carts = {
        f"cart{i}": box((x, 0.25), velocity=[speed * (i == 0), 0], restitution=sqrt(0.066))
        for i, x in enumerate(places)
    }
    scene = {**carts, "track": floor(restitution=0)}
    effects = {**GRAVITY, **located(*carts), "restitution": {"impacts": "sequence"}}
    end = build(level(scene, effects, stepping={"rate": 120})).advance(240)

    assert worst(end.velocity[:3, 0], speed / 3) <= 1e-11  # 2e-13
    assert np.abs(np.diff(end.position[:3, 0]) - 0.5).max() <= 1e-8  # the skin


@pytest.mark.parametrize("rate", [240, 960])
def test_a_bullet_swings_the_block_that_it_hits(rate: int) -> None:
    """m v = (m + M) u, though the block hangs on a rod."""
    bodies = {
        "bullet": disc((-1, 0), radius=0.01, mass=0.01, velocity=[300, 0]),
        "block": box(size=(0.3, 0.3), mass=2, restitution=0),
    }
    bodies["bullet"]["restitution"] = 0
    rod = {"type": "rod", "ends": [[0, 2], "block"]}
    scene = level(
        bodies, {**GRAVITY, **located("bullet")}, joints={"rod": rod}, stepping={"rate": rate}
    )
    found = measured(build(scene), rate // 50, "block.velocity.x", "rod.length")

    assert found["block.velocity.x"][-1] == pytest.approx(3 / 2.01, rel=3e-3)
    assert worst(found["rod.length"], 2) <= 1e-9 * (240 / rate) ** 4  # 6e-11, 2e-13


@pytest.mark.parametrize("x", [0, 1e6])
def test_impacts_on_rods_leave_the_energy_as_it_was(x: float) -> None:
    """A rod pulls otherwise as soon as its ball is struck, wherever in a step that is.

    What is left is third order. While a rod pulled on as before, each impact changed 1e-4.
    """
    balls = {
        "one": disc((x - sin(0.5), 1 - cos(0.5)), radius=0.05, restitution=1),
        "other": disc((x + 0.1, 0), radius=0.05, restitution=1),
    }
    rods = {
        "left": {"type": "rod", "ends": ["one", [x, 1]], "length": 1},
        "right": {"type": "rod", "ends": ["other", [x + 0.1, 1]], "length": 1},
    }
    effects = {**GRAVITY, **located("one", "other")}
    world = build(level(balls, effects, joints=rods, stepping={"rate": 240}))
    flight = run(world, 1000)
    moving = kinetic(world, flight)
    energy = moving + G * flight.position[..., 1].sum(axis=1)
    swing, height = 4.6e-5, G * (1 - cos(0.5))

    assert worst(energy, height) <= swing * height, "leapfrog's own, which does not add up"
    assert worst(energy[moving < 0.01], height) <= 5e-7 * height  # 2.7e-7 after four impacts


def cradle(drawn: int, angle: float, radius: float, rate: float) -> World:
    """Five balls that touch, on rods of 1 m; some of them are drawn aside."""
    places = [(2 * radius * i, 0.0) for i in range(5)]
    places[:drawn] = [(x - sin(angle), 1 - cos(angle)) for x, _ in places[:drawn]]
    balls = {f"ball{i}": disc(at, radius=radius, restitution=1) for i, at in enumerate(places)}
    rods = {
        f"rod{i}": {"type": "rod", "ends": [name, [2 * radius * i, 1]], "length": 1}
        for i, name in enumerate(balls)
    }
    effects = {**GRAVITY, **located(*balls), "restitution": {"impacts": "sequence"}}
    return build(level(balls, effects, joints=rods, stepping={"rate": rate}))


@pytest.mark.sweep
def test_balls_that_hang_still_do_not_tremble_against_each_other() -> None:
    """Of five in a row, the last swings out, and the others hang still to 1e-10 m/s.

    What a step rounds of their weight, 1e-16 m/s, is no approach: 487 impacts if it were.
    """
    world = cradle(drawn=1, angle=0.5, radius=0.05, rate=240)
    world.advance(140)
    assert world.t > 0.505, "the first has hit the row"

    count = 0
    for _ in range(100):
        world.step()
        count += len(world.impacts)

    assert count <= 10  # 0


@pytest.mark.sweep
@pytest.mark.parametrize("drawn", [1, 2, 3, 4])
def test_each_ball_of_a_cradle_hits_each_that_hangs_once(drawn: int) -> None:
    """Then those that hang, and those that swing out, lean on each other and rest.

    They do so with 1e-8 N, for they stand proud by 1e-9 m. If every approach by that were an
    impact, one swing had up to 58 of them, of 1e-13 N s; and if the pull of a ball that an impact
    has reached were compared with that of its neighbour at the kick before, four balls would part
    at 1e-5 m/s.
    """
    world = cradle(drawn, angle=pi / 6, radius=0.1, rate=600)
    count = 0
    for _ in range(400):
        world.step()
        count += len(world.impacts)
    speeds = world.advance().velocity[:, 0]

    assert count == drawn * (5 - drawn)
    assert np.ptp(speeds[: 5 - drawn]) <= 1e-10  # 1e-14 m/s
    assert np.ptp(speeds[5 - drawn :]) <= 1e-10


@pytest.mark.sweep
def test_a_run_is_the_same_every_time() -> None:
    random = np.random.default_rng(3)
    balls = {
        f"ball{i}": disc(
            (0.5 + 0.4 * (i % 7), 0.5 + 0.4 * (i // 7)),
            radius=0.1,
            velocity=random.normal(size=2).tolist(),
            restitution=0.9,
        )
        for i in range(20)
    }
    scene = level({**balls, **room()}, {**GRAVITY, **located(*balls)})
    first, second = (run(build(scene), 120) for _ in range(2))

    assert (first.position == second.position).all()
    assert (first.velocity == second.velocity).all()


def test_the_contact_is_known_though_no_step_sees_it() -> None:
    world = build(bouncing(1, 60, located("ball")))
    steps = int(sqrt(2 * 3 / G) * 60) + 1
    flight = run(world, steps)

    assert world.contacts.bodies.tolist() == [[0, 1]]
    assert flight.normal[-1, 0] == pytest.approx(2 * sqrt(2 * G * 3) * 60, rel=1e-12)
    assert worst(flight.acceleration[:, 0, 1], -G) <= 1e-10, "an impact is no acceleration"
    ((pair, time),) = world.impacts
    assert pair == {"ball", "floor"}
    assert time == pytest.approx(sqrt(2 * 3 / G), rel=1e-9)


def test_a_run_knows_when_bodies_first_met() -> None:
    trace = simulate(bouncing(0.5, 60, located("ball")), duration=1, record=["t"])

    assert list(trace.meetings) == [pair := frozenset(("ball", "floor"))]
    assert trace.meetings[pair][0].time == pytest.approx(sqrt(2 * 3 / G), rel=1e-9)
    assert trace.until(0.5).meetings == {}


@pytest.mark.parametrize(
    ("names", "said"),
    [(["bal"], "unknown body 'bal'"), (["floor"], "is static"), (["ball", "ball"], "named twice")],
)
def test_what_cannot_be_located_is_refused(names: list[str], said: str) -> None:
    with pytest.raises(LevelError, match=said):
        bouncing(1, 60, located(*names))


def test_what_is_welded_does_not_hit_itself() -> None:
    bodies = {"left": disc((-0.4, 0), restitution=1), "right": disc((0.4, 0), restitution=1)}
    weld = {"type": "weld", "ends": ["left", "right"]}
    effects = {**GRAVITY, **located("left", "right"), "rotation": {}}
    fall = run(build(level(bodies, effects, joints={"weld": weld})), 60)

    assert worst(fall.velocity[:, 0, 1], -G * fall.t) <= 1e-12
    assert (fall.normal == 0).all()


def test_what_waits_to_stick_does_not_keep_others_from_bouncing() -> None:
    """Until it does there are no joints that an impact could go through."""
    bodies = {
        "ball": disc((0, 1)),
        "clay": disc((5, 9)),
        "floor": floor(),
    }
    sticking = {"pairs": [{"bodies": ["clay", "floor"]}]}
    contact = {"located": ["ball"], "solver": "iterative"}
    world = build(level(bodies, {**GRAVITY, "contact": contact, "sticking": sticking}))
    world.advance(60)

    assert worst(world.snapshot.position[0, 1], 0.5) <= 1e-8


@pytest.mark.parametrize(
    ("effects", "told"),
    [
        ({"contact": {"located": ["ball"]}}, "located impacts need constant masses"),
        (
            {"contact": {}, "restitution": {"impacts": "sequence"}},
            "impacts in .sequence. need constant masses",
        ),
    ],
)
def test_what_changes_its_mass_has_no_impacts_of_ours(effects: Spec, told: str) -> None:
    rubs = {"restitution": 1} if "restitution" in effects else {}
    bodies = {"ball": disc((0, 2), **rubs), "floor": floor(**rubs)}
    gathers = {"accretion": [{"body": "ball", "rate": 2}]}

    with pytest.raises(LevelError, match=f"the mass of 'ball' changes; {told}"):
        level(bodies, {**GRAVITY, **gathers, **effects})


def test_what_sticks_is_not_located() -> None:
    bodies = {"ball": disc((0, 2), restitution=1), "floor": floor(restitution=1)}
    sticking = {"pairs": [{"bodies": ["ball", "floor"]}]}
    with pytest.raises(LevelError, match="'ball' sticks when it first touches"):
        level(bodies, {**located("ball"), "sticking": sticking})


@pytest.mark.parametrize("e", [0.3, 0.8, 1])
def test_the_books_close_over_impacts_within_a_drift(e: float) -> None:
    """What was there at first is there, or was lost in impacts."""
    world = build(bouncing(e, 60, located("ball")))
    ledger = Ledger(world)
    for _ in range(180):
        world.advance()
        ledger.note()
    balance = ledger.balance

    assert abs(balance.unexplained) <= 1e-12 * 3 * G  # 8e-14
    assert np.abs(balance.unexplained_impulse).max() <= 1e-11
    assert (balance.loss["impacts"] > 10) == (e < 1)


def test_the_books_know_what_rubs_and_what_is_moved_as_told() -> None:
    lift = {
        "type": "kinematic",
        "shape": {"type": "box", "width": 9, "height": 0.2},
        "velocity": [1, 0.5],
        "restitution": 1,
        "friction": 1,
    }
    ball = disc((0, 1), radius=0.1, restitution=0.8, friction=0.05)
    effects = {**GRAVITY, **located("ball"), "rotation": {}, "friction": {}}
    world = build(level({"lift": lift, "ball": ball}, effects))
    ledger = Ledger(world)
    for _ in range(60):
        world.advance()
        ledger.note()
    balance = ledger.balance

    assert abs(balance.unexplained) <= 1e-13 * G
    assert balance.loss["friction"] > 0.1
    assert balance.work["bodies"] > 1


@pytest.mark.parametrize("mu", [0.1, 1.0])
def test_what_falls_on_a_belt_gets_mu_times_its_fall_or_the_belts_speed(mu: float) -> None:
    """Friction's impulse is μ m v; what it takes off the slip is lost, the rest the belt's work."""
    block = box((0, 1.25), mass=2, friction=1)
    scene = level(
        {"block": block, "belt": floor(friction=mu)},
        {
            **GRAVITY,
            "contact": {"located": ["block"]},
            "friction": {},
            "belt": [{"body": "belt", "velocity": [1.5, 0]}],
        },
    )
    world, fall = build(scene), sqrt(2 * G * 1)
    ledger = Ledger(world)
    speed = min(mu * fall, 1.5)
    while not world.impacts:
        assert world.t < 1
        world.advance()
        ledger.note()
        balance = ledger.balance

    # it falls 2e-9 m less
    assert world.last.pre_kick_velocity[0, 0] == pytest.approx(speed, rel=1e-8)
    assert balance.loss["impacts"] == pytest.approx(2 * G * 1, rel=1e-8)
    slid = balance.loss["friction"] - 2 * (1.5 * speed - speed * speed / 2)  # in the next kick
    assert -1e-7 <= slid <= mu * 2 * G / 60 * 1.5
    assert balance.work["belt"] == pytest.approx(balance.loss["friction"] + balance.kinetic)
    assert abs(balance.unexplained) <= 1e-13 * 2 * G
    assert np.abs(balance.unexplained_impulse).max() <= 1e-12
