"""Hoops are hollow, and arcs are touched from inside, from outside and at their ends."""

from math import asin, cos, hypot, pi, sin, sqrt
from typing import Any

import numpy as np
import pytest
from scipy.special import ellipk

from sandbox.model.errors import LevelError
from sandbox.model.level import Level
from sandbox.physics.contacts.shapes.arc_contact_correction import Hollows
from sandbox.physics.engine.space_arrays import Contacts
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.stepping.world import World
from tests.physics.scenes import GRAVITY, G, Spec, box, disc, fixed, floor, level, run

ROUGH: dict[str, Any] = {**GRAVITY, "contact": {}, "friction": {}, "rotation": {}}
SMOOTH: dict[str, Any] = {**GRAVITY, "contact": {}}
R, r = 1.0, 0.1


def arc(start: float = 180, end: float = 360, radius: float = R, thickness: float = 0) -> Spec:
    angles = {"start": f"{start}*deg", "end": f"{end}*deg"}
    return {"type": "arc", "radius": radius, "thickness": thickness, **angles}


HOOP: Spec = {"type": "hoop", "radius": R}
HOLLOWS = pytest.mark.parametrize("shape", [HOOP, arc(), arc(-190, 170)], ids=["hoop", "arc", "C"])


def bowl(shape: Spec, rate: float, angle: float, *, rough: bool) -> Level:
    """A disc that is let go in a hollow, at an angle from its lowest point."""
    place = (R - r) * sin(angle), -(R - r) * cos(angle)
    rub: Spec = {"friction": 1} if rough else {}
    bodies = {"disc": disc(place, radius=r, **rub), "bowl": fixed(shape, **rub)}
    return level(bodies, ROUGH if rough else SMOOTH, stepping={"rate": rate})


def quarter(world: World) -> float:
    """Return when a disc first passes the lowest point of a bowl [s]."""
    before = after = float(world.snapshot.position[0, 0])
    while after > 0:
        before, after = after, float(world.advance().position[0, 0])
    return (world.steps - after / (after - before)) * world.dt


@HOLLOWS
def test_a_disc_rests_in_a_hollow_from_the_first_step_on(shape: Spec) -> None:
    world = build(bowl(shape, 60, 0.0, rough=True))
    rest = run(world, 60)

    assert np.abs(rest.velocity).max() <= 1e-15
    assert rest.normal[:, 0] == pytest.approx(G, rel=1e-12)
    assert rest.position[-1, 0, 1] == pytest.approx(-(R - r), abs=3e-9)


@HOLLOWS
@pytest.mark.parametrize(("rough", "share"), [(False, 0.0), (True, 0.5)])
def test_a_disc_swings_in_a_hollow_as_a_pendulum_does(
    shape: Spec, rough: bool, share: float
) -> None:
    """T = 4 √((1 + I / m r²) (R − r) / g) K, of second order."""
    coarse, fine = (late(shape, rate, rough=rough, share=share) for rate in (240, 960))

    assert coarse <= 3e-5  # 1.0e-5 smooth, 6.7e-6 rough
    assert fine <= coarse / 12  # 3.4e-7, 1.3e-7


def late(shape: Spec, rate: float, *, rough: bool, share: float) -> float:
    """Return by how much of it the quarter of a period is wrong."""
    angle = 0.5
    exact = sqrt((1 + share) * (R - r) / G) * ellipk(sin(angle / 2) ** 2)
    return abs(quarter(build(bowl(shape, rate, angle, rough=rough))) / exact - 1)


def test_left_to_pymunk_it_would_lose_speed_in_each_step(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of first order: pymunk knows velocities alone, and the way along an arc is bent."""
    monkeypatch.setattr(Hollows, "follow", lambda *_: None)
    coarse, fine = (late(HOOP, rate, rough=False, share=0.0) for rate in (120, 240))

    assert coarse > 5e-4  # 6.3e-4
    assert coarse / fine == pytest.approx(2, rel=0.1)


def test_a_disc_that_slides_round_a_hoop_keeps_its_energy() -> None:
    """Without gravity, too, and for hundreds of rounds: what bends its way does no work."""
    ball = disc((0, -(R - r)), radius=r, velocity=[3, 0])
    scene = level({"ball": ball, "hoop": fixed(HOOP)}, {"contact": {}}, stepping={"rate": 120})
    world = build(scene)
    speeds = [float(np.hypot(*world.advance(6).velocity[0])) for _ in range(200)]

    assert speeds == pytest.approx([speeds[0]] * 200, rel=1e-6)
    assert speeds[0] == pytest.approx(3, rel=1e-3)


def test_boxes_rest_on_their_corners_in_a_hollow() -> None:
    """On two of them, at the height at which both are on the circle."""
    half = asin(0.3)
    block = box((0, -R * cos(half) + 0.1), size=(0.6, 0.2), friction=1)
    world = build(level({"block": block, "bowl": fixed(arc(), friction=1)}, ROUGH))
    rest = run(world, 120)

    assert np.abs(rest.velocity).max() <= 1e-12
    assert len(world.contacts.bodies) == 2
    assert rest.position[-1, 0, 1] == pytest.approx(-R * cos(half) + 0.1, abs=3e-9)
    assert support(world.contacts, 0) == pytest.approx([0, G * world.dt], abs=1e-12)


def support(contacts: Contacts, body: int) -> list[float]:
    """Return the impulse that contacts gave a body [N s]."""
    sign = np.where(contacts.bodies[:, 1] == body, 1.0, -1.0)
    return (contacts.impulse * sign[:, None]).sum(axis=0).tolist()


@pytest.mark.sweep
def test_a_rod_slides_within_a_hoop_until_it_is_level() -> None:
    """Its middle is R cos below the hoop's, half its length R sin; it swings, and drag stops it."""
    half = asin(0.6)
    rod = {"type": "segment", "start": [-0.6, 0], "end": [0.6, 0]}
    place = [R * cos(half) * sin(0.3), -R * cos(half) * cos(0.3)]
    body = {"shape": rod, "mass": 1, "position": place, "angle": 0.3}
    effects = {**SMOOTH, "rotation": {}, "drag": {"linear": 3}}
    world = build(level({"rod": body, "hoop": fixed(HOOP)}, effects, stepping={"rate": 240}))
    world.advance(2400)

    assert world.snapshot.position[0] == pytest.approx([0, -R * cos(half)], abs=1e-4)


def test_an_end_of_an_arc_is_round() -> None:
    """A disc lies in the gap at the top of an arc, on both of its ends."""
    thickness, radius = 0.2, 0.5
    half = 20 * pi / 180
    high = R * cos(half) + sqrt((radius + thickness / 2) ** 2 - (R * sin(half)) ** 2)
    ring = fixed(arc(110, 430, thickness=thickness), friction=1)
    lying = disc((0, high), radius=radius, friction=1)
    world = build(level({"disc": lying, "ring": ring}, ROUGH))
    rest = run(world, 60)

    assert np.abs(rest.velocity).max() <= 1e-9
    assert rest.position[-1, 0] == pytest.approx([0, high], abs=1e-6)
    assert len(world.contacts.bodies) == 2


@pytest.mark.parametrize("thickness", [0, 0.1])
def test_an_arc_is_touched_from_outside(thickness: float) -> None:
    """A disc and a box lie on the top of a dome, and what is beside its ends falls past it."""
    top = R + thickness / 2
    bodies = {
        "disc": disc((0, top + r), radius=r),
        "past": disc((-top - 2 * r, 0.5), radius=r),
        "dome": fixed(arc(0, 180, thickness=thickness)),
    }
    fall = run(build(level(bodies, SMOOTH)), 60)

    assert np.abs(fall.position[:, 0] - [0, top + r]).max() <= 1e-6
    assert fall.position[-1, 1, 1] == pytest.approx(0.5 - G / 2, rel=1e-12)


def test_a_box_lies_across_the_ends_of_a_dish() -> None:
    """What covers a hollow does not fall in, nor is it pushed out at the back."""
    dish = fixed(arc(240, 300, thickness=0.02), friction=1)
    high = -R * cos(pi / 6) + 0.01 + 0.05
    lying = box((0.05, high), size=(1.6, 0.1), friction=1)
    rest = run(build(level({"box": lying, "dish": dish}, ROUGH)), 60)

    assert np.abs(rest.velocity).max() <= 1e-9
    assert rest.position[-1, 0] == pytest.approx([0.05, high], abs=1e-6)


@pytest.mark.parametrize("rough", [False, True])
def test_no_ball_trips_where_a_line_goes_on_into_an_arc(rough: bool) -> None:
    """It comes level, with the speed that it had, and loses no more than in any step."""
    rub: Spec = {"friction": 1} if rough else {}
    line = fixed({"type": "segment", "start": [-3, 0], "end": [0, 0]}, **rub)
    curve = fixed(arc(270, 360), (0, 1), **rub)
    ball = disc((-1, r), radius=r, velocity=[3, 0], angular_velocity=-3 / r * rough, **rub)
    world = build(
        level(
            {"ball": ball, "line": line, "curve": curve},
            ROUGH if rough else SMOOTH,
            stepping={"rate": 480},
        )
    )
    comes = run(world, 200)
    flat = comes.position[:, 0, 0] < 0
    speed = np.hypot(*comes.velocity[:, 0].T)
    square = speed**2 * (1.5 if rough else 1) + 2 * G * comes.position[:, 0, 1]
    lost = -np.diff(square)

    assert flat.sum() > 100
    assert not flat.all()
    assert np.abs(comes.velocity[flat, 0, 1]).max() <= 1e-12  # 1e-14
    assert lost.max() <= 5 * (3 * world.dt / (R - r)) ** 2 * 9  # (v dt / ρ)² of v² a step


def test_a_half_ring_rocks_as_its_moment_says() -> None:
    """ω² = g / (R (π − 2)), with I = m (R² − c²) and c = 2 R / π, rolling."""
    c, tilt = 2 * R / pi, 0.05
    place = [c * sin(tilt), R - c * cos(tilt)]
    ring = {"shape": arc(), "mass": 2, "position": place, "angle": tilt, "friction": 1}
    scene = level({"ring": ring, "floor": floor(friction=1)}, ROUGH, stepping={"rate": 480})
    world = build(scene)
    period = 2 * pi * sqrt(R * (pi - 2) / G)
    rocks = run(world, round(period * 480))
    passes = rocks.t[:-1][np.diff(np.sign(rocks.angle[:, 0])) < 0]

    assert world.scene.moment[0] == pytest.approx(2 * (R * R - c * c), rel=1e-14)
    assert passes[0] == pytest.approx(period / 4, abs=2 * world.dt)


def test_a_hoop_swings_on_a_peg() -> None:
    """Rolling on it: T = 2 π √(2 (R − r) / g)."""
    tilt = 0.05
    place = [(R - r) * sin(tilt), -(R - r) * cos(tilt)]
    hoop = {"shape": HOOP, "mass": 1, "position": place, "friction": 1}
    peg = fixed({"type": "disc", "radius": r}, friction=1)
    world = build(level({"hoop": hoop, "peg": peg}, ROUGH, stepping={"rate": 480}))

    assert quarter(world) == pytest.approx(pi / 2 * sqrt(2 * (R - r) / G), rel=1e-3)


@pytest.mark.sweep
def test_what_is_in_a_free_hoop_stays_there_and_keeps_their_momentum() -> None:
    """Discs and a box bounce about in a hoop that nothing holds."""
    bodies = {
        "hoop": {"shape": HOOP, "mass": 3, "friction": 0.5, "restitution": 1},
        "a": disc((0.3, 0.2), radius=0.15, velocity=[2, 1], friction=0.5, restitution=1),
        "b": disc((-0.3, 0.3), radius=0.1, velocity=[-1, 3], friction=0.5, restitution=1),
        "c": box((0, -0.4), size=(0.3, 0.2), velocity=[0, -2], friction=0.5, restitution=1),
    }
    effects: Spec = {"contact": {}, "friction": {}, "restitution": {}, "rotation": {}}
    world = build(level(bodies, effects, stepping={"rate": 480}))
    flies = run(world, 1500)
    mass = world.scene.mass
    momentum = np.einsum("tnc,n->tc", flies.velocity, mass)
    apart = flies.position[:, 1:] - flies.position[:, :1]

    assert np.abs(momentum - [1, 2]).max() <= 1e-12
    assert np.abs(flies.angular_velocity[:, 0]).max() > 0  # they did rub on it
    assert np.hypot(apart[..., 0], apart[..., 1]).max() < R


@pytest.mark.sweep
def test_a_hoop_in_a_hoop_with_a_disc_in_it_comes_to_rest_below() -> None:
    bodies = {
        "outer": fixed({"type": "hoop", "radius": 2}),
        "hoop": {"shape": HOOP, "mass": 1, "position": [sin(0.1), -cos(0.1)]},
        "disc": disc((sin(0.1), -cos(0.1) - 0.5), radius=0.2),
    }
    effects = {**SMOOTH, "drag": {"linear": 5}}
    world = build(level(bodies, effects, stepping={"rate": 240}))
    world.advance(3000)

    assert world.snapshot.position[1] == pytest.approx([0, -1], abs=1e-3)
    assert world.snapshot.position[2] == pytest.approx([0, -1.8], abs=1e-3)


def test_a_hoop_that_is_touched_from_outside_rolls_as_it_did_to_the_last_bit() -> None:
    """Whether or not something else in the scene would have room in it."""
    rolls: dict[str, Spec] = {
        "hoop": {"shape": HOOP, "mass": 1, "position": [0, 1], "velocity": [2, 0], "friction": 0.3},
        "floor": floor(friction=1),
    }
    swept = {**ROUGH, "contact": {"solver": "iterative"}}
    alone = build(level(rolls, swept))
    asked = build(level({**rolls, "far": disc((50, 9), radius=r, friction=1)}, swept))
    alone.advance(90)
    asked.advance(90)

    assert alone.scene.hollows is None
    assert asked.scene.hollows
    assert alone.snapshot.position[0].tolist() == asked.snapshot.position[0].tolist()
    assert alone.snapshot.angle[0] == asked.snapshot.angle[0]


def test_who_touches_an_arc_from_inside_is_known() -> None:
    """With what a solver needs to follow the arc: its centre, the two radii, and the depth."""
    world = build(bowl(HOOP, 240, 0.5, rough=True))
    world.advance(100)
    assert world.scene.hollows
    (found,) = world.scene.hollows.inside(world.scene.batch.state())
    x, y = world.snapshot.position[0].tolist()

    assert (found.body, found.arc.body, found.point) == (0, 1, 0)
    assert (found.arc.inner, found.radius) == pytest.approx((R, r), abs=2e-9)
    assert found.depth == pytest.approx(hypot(x, y) + r - R, abs=2e-9)
    assert found.depth == pytest.approx(world.contacts.depth[0], abs=1e-12)
    assert found.normal == pytest.approx(-complex(x, y) / hypot(x, y), abs=1e-12)


@pytest.mark.parametrize(
    ("shape", "rule"),
    [
        (arc(180, 180), "'end' must be larger than 'start'"),
        (arc(0, 361), "an arc spans at most a full circle"),
        (arc(thickness=2), "fills the whole inside of an arc"),
    ],
)
def test_what_is_no_arc_is_refused(shape: Spec, rule: str) -> None:
    with pytest.raises(LevelError, match=rule):
        level({"arc": fixed(shape), "disc": disc()}, {"contact": {"overlaps": True}})


@pytest.mark.parametrize(
    "effects",
    [
        {"contact": {"located": ["disc"]}},
        {"contact": {}, "sticking": {"pairs": [{"bodies": ["disc", "bowl"]}]}},
    ],
    ids=["located", "sticking"],
)
def test_a_first_touch_from_inside_is_not_found_beforehand(effects: Spec) -> None:
    """An arc says so at once, a hoop only if something starts in it."""
    with pytest.raises(LevelError, match="'bowl' is an arc"):
        level({"disc": disc(radius=r), "bowl": fixed(arc())}, effects)
    within = level({"disc": disc(radius=r), "bowl": fixed(HOOP)}, effects)
    with pytest.raises(SimulationError, match="'disc' starts in the hoop 'bowl'"):
        build(within)
    assert build(level({"disc": disc((3, 0), radius=r), "bowl": fixed(HOOP)}, effects))
