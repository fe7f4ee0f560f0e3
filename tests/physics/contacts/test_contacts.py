"""Contact: slopes, collisions, bounces, stacks."""

from collections.abc import Callable
from contextlib import suppress
from math import atan, cos, radians, sin

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sandbox.model.level import Level
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.state.snapshot import Snapshot
from tests.physics.scenes import (
    GRAVITY,
    G,
    Spec,
    box,
    disc,
    fixed,
    floor,
    incline,
    level,
    measured,
    run,
    worst,
)
from tests.sample import thinned


def along(scene: Level, angle: float, steps: int) -> tuple[np.ndarray, np.ndarray]:
    """Return how far a block slid down a slope, and the times."""
    slide = run(build(scene), steps)
    return -slide.position[:, 0] @ [cos(angle), sin(angle)], slide.t


@pytest.mark.parametrize("degrees", [5, 30, 60])
@pytest.mark.parametrize("friction", [None, 0.05, 0.08])
def test_a_block_slides_down_a_slope(degrees: int, friction: float | None) -> None:
    """s = g (sin − mu cos) t² / 2, from rest."""
    angle = radians(degrees)
    way, t = along(incline(angle, friction), angle, 120)
    acceleration = G * (sin(angle) - (friction or 0) * cos(angle))

    assert worst(way, acceleration * t**2 / 2) <= 1e-10  # 3e-13


def test_a_block_on_a_slope_started_naively_is_late_by_half_a_step() -> None:
    scene = incline(radians(30), stepping={"rate": 60, "scheme": "symplectic-euler"})
    way, t = along(scene, radians(30), 60)

    assert worst(way, G * 0.5 * t**2 / 2) > 1e-3  # 2e-2: the check can fail


@pytest.mark.parametrize("friction", [0.3, 0.5, 1.2])
def test_slope_and_friction_press_as_the_textbook_says(friction: float) -> None:
    """N = m g cos; friction is mu N where the block slides and m g sin where it is held."""
    angle = radians(30)
    names = ("block.contact.normal", "block.contact.friction")
    found = measured(build(incline(angle, friction)), 60, *names)
    weight = 2 * G
    normal = weight * cos(angle)

    assert worst(found["block.contact.normal"], normal) <= 1e-10  # 1e-12
    rub = min(friction * normal, weight * sin(angle))
    assert worst(found["block.contact.friction"], rub) <= 1e-10  # 1e-12


@pytest.mark.parametrize("excess", [1e-6, 1e-3, 0.3])
def test_a_block_that_friction_holds_does_not_creep(excess: float) -> None:
    """mu only just above tan 30° holds as well as more."""
    angle = radians(30)
    scene = incline(angle, float(np.tan(angle)) * (1 + excess))

    assert np.hypot(*build(scene).advance(600).position[0]) <= 1e-9  # 2e-13


@pytest.mark.parametrize("order", [("block", "slope"), ("slope", "block")])
@pytest.mark.parametrize("rate", [60, 61, 240, 1000])
def test_a_block_that_can_turn_rests_on_its_whole_side(rate: int, order: tuple[str, str]) -> None:
    """pymunk could not tell a side's two ends apart between the first two shapes of a space."""
    bodies = {"block": box((0, 0.25), friction=0.7), "slope": floor(friction=1)}
    scene = level(
        {name: bodies[name] for name in order},
        {**GRAVITY, "contact": {}, "friction": {}, "rotation": {}},
        stepping={"rate": rate},
    )
    end, block = build(scene).advance(10 * rate), order.index("block")

    assert np.hypot(*(end.position[block] - [0, 0.25])) <= 1e-12  # 7e-17; it was up to 5e-3
    assert abs(end.angle[block]) <= 1e-12


@pytest.mark.parametrize("rate", thinned([60, 100, 240, 1000], 4))
def test_a_stack_of_equal_boxes_stands_still(rate: int) -> None:
    """Not settled before its first step, or with sides in line, it is thrown apart within 10 s."""
    bodies = {f"box{i}": box((0, 0.5 + i), size=(1, 1), friction=0.7) for i in range(5)}
    scene = level(
        {**bodies, "floor": floor(friction=1)},
        {**GRAVITY, "contact": {}, "friction": {}, "rotation": {}},
        stepping={"rate": rate},
    )
    world = build(scene)
    start = world.snapshot
    end = world.advance(10 * rate)

    assert np.abs(end.position - start.position).max() <= 1e-9  # 8e-12; naively 0.1
    assert worst(end.normal[4], G) <= 1e-9


def collide(
    m1: float, m2: float, e: float, v1: float, v2: float, scheme: str = "leapfrog"
) -> Level:
    """Two discs on a line that meet after about half a second."""
    rest = {"restitution": e}
    return level(
        {
            "a": disc((-0.5 - v1 / 2, 0), mass=m1, velocity=[v1, 0], **rest),
            "b": disc((0.5 - v2 / 2, 0), mass=m2, velocity=[v2, 0], restitution=1),
        },
        {"contact": {}, "restitution": {}},
        stepping={"rate": 60, "scheme": scheme},
    )


MASSES = st.floats(-3, 3).map(lambda power: 10.0**power)


@pytest.mark.sweep
@settings(max_examples=60, deadline=None)
@given(MASSES, MASSES, st.floats(0, 1), st.floats(0.1, 10), st.floats(-10, -0.1))
def test_a_collision_on_a_line_ends_with_the_velocities_of_the_textbook(
    m1: float, m2: float, e: float, v1: float, v2: float
) -> None:
    """Momentum stays, and the speed of separation is e times that of approach."""
    end = build(collide(m1, m2, e, v1, v2)).advance(60)
    center, approach = (m1 * v1 + m2 * v2) / (m1 + m2), v1 - v2
    expected = center + e * approach * np.array([-m2, m1]) / (m1 + m2)

    assert np.abs(end.velocity[:, 0] - expected).max() <= 1e-12 * approach  # 2e-16
    assert worst(end.velocity[:, 1], 0.0) == 0


def test_an_impact_that_is_looked_at_changes_the_speed_at_once() -> None:
    """At every step the velocity is one of before or one of after, and momentum never changes."""
    flight = run(build(collide(1, 3, 0.5, 2, -1)), 60)
    before, after = flight.velocity[:, 0, 0] == 2, np.isclose(flight.velocity[:, 0, 0], -1.375)

    assert (before ^ after).all()
    assert worst(flight.velocity[:, :, 0] @ [1, 3], -1) <= 1e-15
    assert (flight.acceleration == 0).all()


@pytest.mark.sweep
@pytest.mark.parametrize("gravity", [0, G])
def test_the_energy_of_a_spinning_box_is_right_at_every_impact(gravity: float) -> None:
    """Corners hit, not centres; and with one still on the wall the next one may.

    The mean of the velocities before and after an impact misses 10 % and 34 % of the energy.
    """
    sides = [([-3, 0], [3, 0]), ([-3, 4], [3, 4]), ([-3, 0], [-3, 4]), ([3, 0], [3, 4])]
    walls = {
        f"wall{i}": fixed({"type": "segment", "start": a, "end": b}, restitution=1)
        for i, (a, b) in enumerate(sides)
    }
    thrown = box((0, 2), velocity=[1, 0.7], angular_velocity=5, restitution=1)
    effects: Spec = {"contact": {}, "restitution": {}, "rotation": {}}
    if gravity:
        effects |= GRAVITY
    scene = level({"box": thrown, **walls}, effects, stepping={"rate": 240})
    energy = measured(build(scene), 1800, "system.energy")["system.energy"]

    assert worst(energy, energy[0]) <= 1e-13  # 4e-16, 3e-15


MAKES: list[Callable[..., Spec]] = [disc, box]


@st.composite
def crowds(draw: st.DrawFn) -> dict[str, Spec]:
    """Discs and boxes in a ring, thrown at each other."""
    bodies = {}
    for i in range(draw(st.integers(2, 6))):
        angle, speed = 2.1 * i, draw(st.floats(0.5, 5))
        bodies[f"body{i}"] = draw(st.sampled_from(MAKES))(
            ((1.5 + 0.4 * i) * cos(angle), (1.5 + 0.4 * i) * sin(angle)),
            mass=draw(MASSES),
            velocity=[-speed * cos(angle), -speed * sin(angle)],
            angular_velocity=draw(st.floats(-5, 5)),
            restitution=draw(st.floats(0, 1)),
            friction=draw(st.floats(0, 1)),
        )
    return bodies


@pytest.mark.sweep
@settings(max_examples=40, deadline=None)
@given(crowds())
def test_nothing_inside_changes_the_momentum_of_an_isolated_system(bodies: dict[str, Spec]) -> None:
    effects: Spec = {"contact": {}, "restitution": {}, "friction": {}, "rotation": {}}
    world = build(level(bodies, effects))
    mass = world.scene.mass
    states = [world.snapshot]
    with suppress(SimulationError):  # light ones may be crushed between heavy ones
        states.extend(world.advance() for _ in range(120))
    momentum = np.einsum("i,tik->tk", mass, Snapshot.stack(states).velocity)
    velocity = np.array([spec["velocity"] for spec in bodies.values()])
    start, scale = mass @ velocity, float(mass @ np.hypot(*velocity.T))

    assert np.abs(momentum - start).max() <= 1e-12 * scale  # 2e-15


@pytest.mark.sweep
@pytest.mark.parametrize("rate", [60, 240])
def test_a_perfectly_elastic_ball_keeps_its_energy_at_every_step(rate: int) -> None:
    """The impact turns the velocity half a step before it round, and leapfrog adds what it took."""
    scene = level(
        {"ball": disc((0, 5), radius=0.1, restitution=1), "floor": floor(restitution=1)},
        {**GRAVITY, "contact": {}, "restitution": {}},
        stepping={"rate": rate},
    )
    world = build(scene)
    found = measured(world, 20 * rate, "ball.energy", "ball.velocity.y", "ball.acceleration.y")

    assert worst(found["ball.energy"], 5 * G) <= 1e-10  # 1e-14
    assert np.sum(np.diff(np.sign(found["ball.velocity.y"])) > 0) == 10  # 2 s a bounce
    assert worst(found["ball.acceleration.y"], -G) <= 1e-10  # an impact is no acceleration


def test_a_naive_ball_gains_energy() -> None:
    scene = level(
        {"ball": disc((0, 5), radius=0.1, restitution=1), "floor": floor(restitution=1)},
        {**GRAVITY, "contact": {}, "restitution": {}},
        stepping={"scheme": "symplectic-euler"},
    )
    energy = measured(build(scene), 1200, "ball.energy")["ball.energy"]

    assert worst(energy, 5 * G) > 1e-3  # 6e-2: the check can fail


def test_a_ball_started_in_contact_does_not_bounce_by_itself() -> None:
    scene = level(
        {"ball": disc((0, 0.5), restitution=1), "floor": floor(restitution=1)},
        {**GRAVITY, "contact": {}, "restitution": {}},
    )
    rest = run(build(scene), 600)

    assert worst(rest.position[:, 0, 1], 0.5) <= 1e-12  # 0
    assert np.abs(rest.velocity).max() <= 1e-12


@pytest.mark.parametrize(("shape", "share"), [("disc", 1 / 2), ("hoop", 1)])
def test_a_hoop_rolls_slower_than_a_disc(shape: str, share: float) -> None:
    """a = g sin / (1 + I / m r²), without slip: v = −omega r."""
    angle, radius = radians(20), 0.4
    slope = {"type": "segment", "start": [-200, 0], "end": [200, 0]}
    foot = (radius * sin(angle), -radius * cos(angle))
    scene = level(
        {
            "wheel": {"shape": {"type": shape, "radius": radius}, "mass": 3, "friction": 1},
            "slope": fixed(slope, foot, angle=angle, friction=1),
        },
        {**GRAVITY, "contact": {}, "friction": {}, "rotation": {}},
    )
    roll = run(build(scene), 120)
    down = -np.array([cos(angle), sin(angle)])
    speed = roll.velocity[:, 0] @ down

    acceleration = G * sin(angle) / (1 + share)
    assert worst(roll.position[:, 0] @ down, acceleration * roll.t**2 / 2) <= 1e-10  # 1e-14
    assert worst(roll.angular_velocity[:, 0] * radius, speed) <= 1e-10  # 2e-15


@pytest.mark.parametrize("angle", [0, 20])
def test_no_ball_trips_where_the_segments_of_a_floor_join(angle: int) -> None:
    """At a join a ball meets its next segment. That is no impact: its velocity shows nothing."""
    tilt = radians(angle)
    points = [[0.7 * x * cos(tilt), 0.7 * x * sin(tilt)] for x in range(-20, 21)]
    foot = (0.5 * sin(tilt), -0.5 * cos(tilt))
    scene = level(
        {"ball": disc(), "floor": fixed({"type": "polyline", "points": points}, foot)},
        {**GRAVITY, "contact": {}, "rotation": {}},
    )
    downhill = np.array([-cos(tilt), -sin(tilt)])
    slide = run(build(scene), 120)

    assert worst(slide.velocity[:, 0] @ downhill, G * sin(tilt) * slide.t) <= 1e-10
    assert np.abs(slide.velocity[:, 0] @ [-sin(tilt), cos(tilt)]).max() <= 1e-10
    assert np.abs(slide.position[:, 0] @ [-sin(tilt), cos(tilt)]).max() <= 1e-10
    assert np.abs(slide.angle[:, 0]).max() <= 1e-12


def carts(e: float) -> Level:
    return level(
        {
            "a": box((-2, 0.25), velocity=[2, 0], restitution=0),
            "b": box((1, 0.25), mass=3, restitution=0),
            "track": floor(restitution=0),
        },
        {
            **GRAVITY,
            "contact": {},
            "restitution": {"pairs": [{"bodies": ["a", "b"], "coefficient": e}]},
        },
    )


@pytest.mark.parametrize("e", [0, 0.5, 1])
def test_carts_that_collide_on_a_track_stay_on_it(e: float) -> None:
    """The track holds them up during the impact too, so that nothing vertical is ever measured."""
    flight = run(build(carts(e)), 180)
    expected = 0.5 + e * 2 * np.array([-0.75, 0.25])

    assert np.abs(flight.velocity[:, :, 1]).max() <= 1e-12  # 0; it was g dt / 2
    assert np.abs(flight.acceleration[..., 1]).max() <= 1e-10
    assert worst(flight.velocity[-1, :2, 0], expected) <= 1e-12


def test_a_dropped_block_lies_still_from_its_landing_on() -> None:
    scene = level({"block": box((0, 2)), "floor": floor()}, {**GRAVITY, "contact": {}})
    fall = run(build(scene), 120)
    landed = int(np.argmax(fall.normal[:, 0] > 0))

    assert fall.t[landed] == pytest.approx((2 * 1.75 / G) ** 0.5, abs=1 / 60)
    assert worst(fall.velocity[:landed, 0, 1], -G * fall.t[:landed]) <= 1e-12
    assert np.abs(fall.velocity[landed:, 0]).max() <= 1e-12


def test_a_block_dropped_on_a_block_lies_still_from_its_landing_on() -> None:
    """The ground holds the upper block up through the lower one."""
    bodies = {"upper": box((0, 2)), "lower": box((0, 0.25)), "floor": floor()}
    fall = run(build(level(bodies, {**GRAVITY, "contact": {}})), 120)
    landed = int(np.argmax(fall.normal[:, 0] > 0))

    assert np.abs(fall.velocity[landed]).max() <= 0.1 * G / 60  # 0.03: the solver's; it was half
    assert np.abs(fall.velocity[landed + 10 :]).max() <= 1e-6  # 1e-9


def test_an_impact_passes_through_a_row_of_blocks_at_once() -> None:
    """It sticks to all the others: a quarter of the speed, as far as 10 sweeps of the solver go."""
    row = {f"block{i}": box((0.5 * i, 0)) for i in range(3)}
    scene = level({"shot": box((-1.2, 0), velocity=[4, 0]), **row}, {"contact": {}})
    flight = run(build(scene), 60)

    assert worst(flight.velocity[..., 0].sum(axis=1), 4) <= 1e-12
    assert worst(flight.velocity[-1, :, 0], 1) <= 0.01  # 2e-3


def test_bodies_that_start_deep_inside_each_other_part_gently() -> None:
    """Position correction moves without speed: nothing leaves with more energy than it came."""
    bodies = {f"box{i}": box((0.1 * i, 0.4 + 0.75 * i), size=(1, 1)) for i in range(4)}
    scene = level({**bodies, "floor": floor()}, {**GRAVITY, "contact": {"overlaps": True}})
    settle = run(build(scene), 600)
    energy = settle.position[..., :4, 1].sum(axis=1)

    assert np.abs(settle.velocity).max() < 1  # they never fall further than they were lifted
    assert np.ptp(energy[300:]) < 0.05


def test_discs_in_one_place_come_to_rest_somewhere_finite() -> None:
    """Boxes in one place are refused: pymunk finds no direction in which they part."""
    bodies = {name: disc((0, 1)) for name in "abc"}
    effects = {**GRAVITY, "contact": {"overlaps": True}, "rotation": {}}
    end = build(level({**bodies, "floor": floor()}, effects)).advance(600)

    assert np.isfinite(end.position).all()
    assert np.abs(end.position).max() < 10
    assert end.normal[3] == pytest.approx(3 * G, rel=1e-3)


def test_a_pairs_own_coefficient_wins_over_the_product() -> None:
    """Friction and restitution of 1 by the bodies, but none between these two."""
    angle = atan(0.5)
    bodies: dict[str, Spec] = {
        "block": box(angle=angle, friction=1, restitution=1),
        "slope": fixed(
            {"type": "segment", "start": [-99, 0], "end": [99, 0]},
            (0.25 * sin(angle), -0.25 * cos(angle)),
            angle=angle,
            friction=1,
            restitution=1,
        ),
    }
    pair = {"bodies": ["slope", "block"], "coefficient": 0}
    effects = {
        **GRAVITY,
        "contact": {},
        "friction": {"pairs": [pair]},
        "restitution": {"pairs": [pair]},
    }
    world = build(level(bodies, effects))
    end = world.advance(60)

    assert np.hypot(*end.velocity[0]) == pytest.approx(G * sin(angle), rel=1e-10)
    # with the friction of 1 that the bodies have themselves it would have been held


def test_a_kinematic_platform_lifts_at_its_own_speed() -> None:
    platform = {
        "type": "kinematic",
        "shape": {"type": "box", "width": 2, "height": 0.2},
        "position": [0, -0.1],
        "velocity": [0, 0.5],
    }
    scene = level(
        {"platform": platform, "load": box((0, 0.25), velocity=[0, 0.5])},
        {**GRAVITY, "contact": {}},
    )
    lift = run(build(scene), 120)

    assert worst(lift.position[:, 1, 1] - 0.25, 0.5 * lift.t) <= 1e-12
    assert worst(lift.normal[:, 1], G) <= 1e-10
