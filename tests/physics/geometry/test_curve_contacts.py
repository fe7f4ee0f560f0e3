"""Curves are touched where they run, from both sides, by what is round and by what has corners."""

import gc
import json
from math import asin, cos, hypot, pi, sin, sqrt
from typing import Any
from weakref import ref

import numpy as np
import pytest
from scipy.special import ellipk

from sandbox.model.errors import LevelError
from sandbox.model.shapes import Curve
from sandbox.physics.contacts.direct.prediction.approaching_hollow_shapes import HollowPairs
from sandbox.physics.contacts.direct.rows import gap_functions
from sandbox.physics.contacts.direct.solver import DirectSolver
from sandbox.physics.contacts.shapes.arc_contact_correction import Hollows
from sandbox.physics.geometry import curve_contacts
from sandbox.physics.geometry.arc_contacts import Piece
from sandbox.physics.geometry.plane_curve import KNOT, MiddleLine, Side
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.stepping.world import World
from tests.physics.scenes import GRAVITY, G, Spec, box, disc, fixed, level, run

R, r = 1.0, 0.1
SOLVERS = pytest.mark.parametrize("solver", ["iterative", "direct"])
ROUGH = pytest.mark.parametrize(("rough", "share"), [(False, 0.0), (True, 0.5)])


def curve(x: str, y: str, first: object, last: object, thickness: float = 0) -> Spec:
    return {"type": "curve", "curve": [x, y], "s": [first, last], "thickness": thickness}


CIRCLE = curve(f"{R}*cos(s)", f"{R}*sin(s)", "pi", "2*pi")
HILL = curve("s", "0.5*cos(s)", -3, 3)
VALLEY = curve("s", "s**2", -2, 2)
PARALLEL = curve(f"s + sin(s) + {r}*sin(s/2)", f"1 - cos(s) - {r}*cos(s/2)", "-pi", "pi")
"""Of a cycloid that a circle of 1 m rolls out: a disc on it has its centre on the cycloid."""


def effects(solver: str, *, rough: bool, **rest: object) -> dict[str, Any]:
    rubs: Spec = {"friction": {}, "rotation": {}} if rough else {}
    return {**GRAVITY, "contact": {"solver": solver}, **rubs, **rest}


def on(
    shape: Spec,
    body: Spec,
    solver: str = "iterative",
    rate: float = 240,
    *,
    rough: bool = True,
    **rest: object,
) -> World:
    """A body on a curve that does not move."""
    rub: Spec = {"friction": 2} if rough else {}
    bodies = {"body": {**body, **rub}, "curve": fixed(shape, **rub)}
    return build(level(bodies, effects(solver, rough=rough, **rest), stepping={"rate": rate}))


def quarter(world: World) -> float:
    """Return when a body first passes x = 0 from the right [s]."""
    before = after = float(world.snapshot.position[0, 0])
    while after > 0:
        before, after = after, float(world.advance().position[0, 0])
    return (world.steps - after / (after - before)) * world.dt


def test_the_first_kick_on_a_curve_settles_to_what_places_are_known_to(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The least digits of a foot go in circles for ever: 500 kicks, were they to stand still."""
    kicks: list[float] = []
    solve = DirectSolver.solve

    def counted(direct: DirectSolver, until: float) -> None:
        kicks.append(until)
        solve(direct, until)

    monkeypatch.setattr(DirectSolver, "solve", counted)
    on(CIRCLE, disc(((R - r) * sin(0.5), -(R - r) * cos(0.5)), radius=r), "direct", 500)

    assert len(kicks) <= 50  # 20


@pytest.mark.sweep
@pytest.mark.steps(4000)
@SOLVERS
@ROUGH
def test_a_curve_in_the_shape_of_an_arc_is_one(solver: str, rough: bool, share: float) -> None:
    """At 1 kHz the quarter periods agree to 1e-9, and with the elliptic integral to 1e-6."""
    place = disc(((R - r) * sin(0.5), -(R - r) * cos(0.5)), radius=r)
    arc = {"type": "arc", "radius": R, "start": "180*deg", "end": "360*deg"}
    times = [quarter(on(shape, place, solver, 1000, rough=rough)) for shape in (arc, CIRCLE)]
    exact = sqrt((1 + share) * (R - r) / G) * ellipk(sin(0.25) ** 2)

    assert times[1] == pytest.approx(times[0], rel=1e-9)  # 5e-10 and 3e-10; direct 2e-14
    assert times[1] == pytest.approx(exact, rel=1e-6)  # 2.8e-7, 9.6e-8; direct 6.1e-7, 3.7e-7


def late(start: float, rate: float, solver: str, *, rough: bool, share: float) -> float:
    """Return by how much of it the time down a cycloid is wrong."""
    place = disc((start + sin(start), 1 - cos(start)), radius=r)
    exact = pi * sqrt((1 + share) / G)
    return abs(quarter(on(PARALLEL, place, solver, rate, rough=rough)) / exact - 1)


@pytest.mark.sweep
@pytest.mark.steps(6000)
@pytest.mark.parametrize(
    ("start", "solver"),
    [(0.5, "iterative"), (1.5, "iterative"), (0.5, "direct"), (1.5, "direct"), (2.5, "direct")],
)
@ROUGH
def test_a_bowl_beside_a_cycloid_takes_as_long_from_anywhere(
    start: float, solver: str, rough: bool, share: float
) -> None:
    """T/4 = π √((1 + I/m r²) R / g), of second order, smooth and rolling."""
    coarse, fine = (late(start, rate, solver, rough=rough, share=share) for rate in (240, 960))

    assert coarse <= 1e-5
    assert fine <= coarse / 12


def test_left_to_pymunk_it_would_lose_speed_in_each_step(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Hollows, "follow", lambda *_: None)

    assert late(1.5, 240, "iterative", rough=False, share=0.0) > 1e-4


@pytest.mark.sweep
def test_a_circle_that_is_close_to_a_curve_does_not_do_for_a_step(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The curve leaves it by κ' (v dt)³ / 6 in each, and what slides on it loses touch.

    Unless it lands again within the step.
    """
    monkeypatch.setattr(gap_functions, "follow_curves", lambda *_: None)
    monkeypatch.setattr(HollowPairs, "meet", lambda *_: [])
    monkeypatch.setattr(HollowPairs, "corners", lambda *_: ())

    assert late(2.5, 480, "direct", rough=False, share=0.0) > 3e-5  # 1e-6 on the curve itself


@pytest.mark.sweep
@pytest.mark.steps(7000)
@SOLVERS
@pytest.mark.parametrize("rough", [False, True])
def test_what_goes_over_hills_keeps_its_energy(solver: str, rough: bool) -> None:
    """Through valleys and over crests, which it follows with an error of second order."""
    coarse, fine = (energy_over_hills(rate, solver, rough=rough) for rate in (240, 960))

    assert coarse <= 2e-3  # of some 3 J: 1.3e-3, 1.2e-3; direct 3.3e-5, 2.7e-5
    assert fine <= coarse / 15


def energy_over_hills(rate: int, solver: str, *, rough: bool) -> float:
    """Return by how much the energy of a disc is ever wrong [J]."""
    spin = {"angular_velocity": -1.2 / r} if rough else {}
    ball = disc((0, 0.2 + r), radius=r, velocity=[1.2, 0], **spin)
    goes = run(on(curve("s", "0.2*cos(s)", -1, 12), ball, solver, rate, rough=rough), 3 * rate)
    square = (goes.velocity[:, 0] ** 2).sum(axis=1) * (1.5 if rough else 1)
    energy = square / 2 + G * goes.position[:, 0, 1]

    assert goes.position[-1, 0, 0] > 5
    return float(np.abs(energy - energy[0]).max())


HALF = asin(0.3)
LINE = {"type": "segment", "start": [-0.6, 0], "end": [0.6, 0]}
TRIANGLE = {"type": "polygon", "vertices": [[-0.3, 0], [0.3, 0], [0, 0.4]]}
RESTING = {
    "box in a bowl": (CIRCLE, box((0, 0.1 - cos(HALF)), size=(0.6, 0.2)), 2),
    "rod in a bowl": (CIRCLE, {"shape": LINE, "mass": 1, "position": [0, -0.8]}, 2),
    "disc on a crest": (HILL, disc((0, 0.5 + r), radius=r), 1),
    "hoop on a crest": (
        HILL,
        {"shape": {"type": "hoop", "radius": r}, "mass": 1, "position": [0, 0.5 + r]},
        1,
    ),
    "box on a crest": (HILL, box((0, 0.6), size=(0.6, 0.2)), 1),
    "triangle on a crest": (
        HILL,
        {"shape": TRIANGLE, "mass": 1, "position": [0, 0.5 + 0.4 / 3]},
        1,
    ),
    "box on a thick crest": ({**HILL, "thickness": 0.1}, box((0, 0.65), size=(0.6, 0.2)), 1),
    "box on a straight": (curve("s", "0*s", -3, 3), box((0.3, 0.1), size=(0.6, 0.2)), 2),
    "disc that is wider than a valley": (VALLEY, disc((0, 0.81 + 0.25), radius=0.9), 2),
    "disc on a round end": (
        curve("s", "0.5*s**2 - 0.5", -1, 1, 0.1),
        disc((1, 0.05 + r), radius=r),
        1,
    ),
    "disc in an ellipse": (
        curve("2*cos(s)", "sin(s)", 0, "2*pi"),
        disc((0, r - 1), radius=r),
        1,
    ),
}


@SOLVERS
@pytest.mark.parametrize(("shape", "body", "touches"), RESTING.values(), ids=list(RESTING))
def test_what_rests_on_a_curve_stays(shape: Spec, body: Spec, touches: int, solver: str) -> None:
    world = on(shape, body, solver)
    rest = run(world, 120)

    assert np.abs(rest.velocity).max() <= 1e-9
    assert rest.position[-1, 0] == pytest.approx(body["position"], abs=3e-8)
    assert len(world.contacts.bodies) == touches
    sign = np.where(world.contacts.bodies[:, 1] == 0, 1.0, -1.0)
    held = (world.contacts.impulse * sign[:, None]).sum(axis=0)
    assert held == pytest.approx([0, G * world.dt], abs=1e-11)


@pytest.mark.sweep
@SOLVERS
def test_a_box_rocks_on_a_crest(solver: str) -> None:
    """Rolling: ω² = (ρ − h) m g / (I + m h²), h half its height, ρ the radius of the crest."""
    h, rho, width, tilt = 0.1, 1.25, 0.6, 0.02
    at = (rho + h) * sin(tilt) - rho * tilt * cos(tilt)
    high = (rho + h) * cos(tilt) - rho + rho * tilt * sin(tilt)
    body = box((at, high), size=(width, 2 * h), angle=-tilt)
    world = on(curve("1.25*sin(s)", "1.25*cos(s) - 1.25", -1, 1), body, solver, 960)
    omega = sqrt((rho - h) * G / ((width**2 + 4 * h * h) / 12 + h * h))
    rocks = run(world, round(960 * pi / omega))

    assert rocks.angle[-1, 0] == pytest.approx(tilt, rel=2e-2)
    assert np.abs(rocks.angle).max() <= tilt * 1.01


@pytest.mark.sweep
@SOLVERS
def test_a_curve_that_moves_takes_along_what_lies_in_it(solver: str) -> None:
    rub: Spec = {"friction": 1}
    bowl = {"type": "kinematic", "shape": VALLEY, "velocity": [1, 0], **rub}
    bodies = {"disc": disc((0, r), radius=r, velocity=[1, 0], **rub), "bowl": bowl}
    world = build(level(bodies, effects(solver, rough=True), stepping={"rate": 240}))
    world.advance(240)

    assert world.snapshot.position[0] == pytest.approx([1, r], abs=1e-8)
    assert world.snapshot.velocity[0] == pytest.approx([1, 0], abs=1e-9)


@pytest.mark.sweep
@SOLVERS
def test_a_drum_that_turns_spins_what_lies_in_it(solver: str) -> None:
    """A curve in the shape of one drags a disc as an arc that turns does."""
    turning = []
    for shape in (
        {"type": "arc", "radius": R, "start": 0, "end": "360*deg"},
        curve("cos(s)", "sin(s)", 0, "2*pi"),
    ):
        drum = {"type": "kinematic", "shape": shape, "angular_velocity": 0.5, "friction": 1}
        bodies = {"disc": disc((0, r - R), radius=r, friction=1), "drum": drum}
        world = build(level(bodies, effects(solver, rough=True), stepping={"rate": 240}))
        turning.append(world.advance(240))

    assert turning[1].position[0] == pytest.approx(turning[0].position[0], abs=1e-7)
    assert turning[1].angular_velocity[0] == pytest.approx(turning[0].angular_velocity[0], rel=1e-6)


@pytest.mark.sweep
@SOLVERS
@pytest.mark.parametrize("thickness", [0, 0.1])
def test_no_ball_trips_where_a_line_goes_on_into_a_curve(solver: str, thickness: float) -> None:
    line = fixed({"type": "segment", "start": [-3, 0], "end": [0, 0], "thickness": thickness})
    ball = disc((-1, r + thickness / 2), radius=r, velocity=[3, 0])
    bodies = {"ball": ball, "line": line, "curve": fixed(curve("s", "s**3/2", 0, 1.2, thickness))}
    world = build(level(bodies, effects(solver, rough=False), stepping={"rate": 480}))
    comes = run(world, 300)
    flat = comes.position[:, 0, 0] < -0.01
    energy = (comes.velocity[:, 0] ** 2).sum(axis=1) / 2 + G * comes.position[:, 0, 1]

    assert comes.position[-1, 0, 1] > 0.2
    assert np.abs(comes.velocity[flat, 0, 1]).max() <= 1e-12
    assert np.ptp(energy) <= 3e-4 * energy[0]  # 3e-5


@pytest.mark.sweep
@pytest.mark.parametrize("impacts", ["together", "sequence"])
def test_what_bounces_on_a_curve_keeps_its_energy(impacts: str) -> None:
    bodies = {
        "ball": disc((0.3, 1), radius=r, restitution=1),
        "curve": fixed(curve("s", "0.2*s**2", -3, 3), restitution=1),
    }
    laws = {**GRAVITY, "contact": {}, "restitution": {"impacts": impacts}}
    world = build(level(bodies, laws, stepping={"rate": 480}))
    falls = run(world, 960)
    energy = (falls.velocity[:, 0] ** 2).sum(axis=1) / 2 + G * falls.position[:, 0, 1]

    assert falls.position[:, 0, 0].min() < 0
    assert np.ptp(energy) <= 1e-12 * energy[0]


@pytest.mark.parametrize(("high", "depth"), [(r - 1e-4, "0.0001"), (0.05, "0.05"), (-0.05, "0.05")])
def test_what_starts_in_a_curve_is_told_how_deep(high: float, depth: str) -> None:
    with pytest.raises(SimulationError, match=f"'body' and 'curve' overlap by {depth} m"):
        on(VALLEY, disc((0, high), radius=r))


def test_a_side_that_starts_in_a_crest_is_told_how_deep() -> None:
    with pytest.raises(SimulationError, match=r"'body' and 'curve' overlap by 0\.01 m"):
        on(HILL, box((0, 0.59), size=(0.6, 0.2)))


def test_who_touches_a_curve_is_known() -> None:
    """With the circle that is closest to it there: of the parabola, 1 + 4 x² to the 3/2 over 2."""
    x, depth = 0.5, 1e-7
    left = 1 / hypot(1, 2 * x)
    place = disc((x - 2 * x * left * (r - depth), x * x + left * (r - depth)), radius=r)
    world = on(VALLEY, place)
    assert world.scene.hollows
    (found,) = world.scene.hollows.inside(world.scene.batch.state())

    assert found.sign == 1
    assert found.arc.radius == pytest.approx((1 + 4 * x * x) ** 1.5 / 2, rel=1e-7)
    assert found.depth == pytest.approx(depth, abs=2e-9)
    assert found.normal == pytest.approx(complex(-2 * x, 1) * left, abs=1e-9)


@pytest.mark.parametrize(
    ("changes", "rule"),
    [
        ({"s": [1, 1]}, "'s' must increase"),
        ({"curve": ["s", "sqrt(s)"]}, "the curve has no finite point at s = -2"),
        ({"curve": ["s", "abs(s)"]}, "must not have sharp corners, but has one at [0, 0]"),
        ({"curve": ["s", "0.01*sin(2e4*s)"]}, "too long for 4096 pieces: divide it into several"),
        ({"curve": ["sin(2*s)", "-sin(s)"], "s": [-1, 4]}, "must not cross itself"),
        ({"curve": ["s", "s**1.5"], "s": [0, 1]}, "the curve is not smooth near [0, 0]"),
        ({"curve": ["s + sin(s)", "-cos(s)"], "s": ["-pi", "pi"]}, "end it before, or round it"),
        ({"thickness": 1.1}, "at [0, 0] is 0.5 m, less than half its thickness, 0.55 m"),
        ({"curve": ["1e16*s", "s"]}, "away from the origin"),
        ({"curve": ["s", "t"]}, "the time 't' has no meaning here"),
    ],
    ids=lambda value: str(value)[:40],
)
def test_what_cannot_be_touched_is_refused(changes: Spec, rule: str) -> None:
    bodies = {"disc": disc((0, 9)), "way": fixed({**VALLEY, **changes})}
    with pytest.raises(LevelError) as told:
        level(bodies, {**GRAVITY, "contact": {"overlaps": True}})

    assert rule in str(told.value)


def test_a_curve_does_not_move_freely() -> None:
    bodies = {"disc": disc((0, 9)), "way": {"shape": VALLEY, "mass": 1}}
    with pytest.raises(LevelError, match="its 'type' must be 'static' or 'kinematic'"):
        level(bodies, {**GRAVITY, "contact": {}})


@pytest.mark.parametrize(
    ("bodies", "laws", "rule"),
    [
        (
            {},
            {"contact": {"located": ["disc"]}},
            "'way' is a curve; a level with one cannot have located",
        ),
        (
            {},
            {"contact": {}, "sticking": {"pairs": [{"bodies": ["disc", "way"]}]}},
            "'way' is a curve; nothing can stick to one",
        ),
        (
            {"ring": {"shape": {"type": "arc", "radius": 1, "start": 0, "end": 3}, "mass": 1}},
            {"contact": {"overlaps": True}},
            "'ring' is a dynamic arc and cannot touch the curve 'way'",
        ),
    ],
    ids=["located", "sticking", "arc"],
)
def test_what_cannot_be_done_beside_a_curve_is_refused(bodies: Spec, laws: Spec, rule: str) -> None:
    scene = {"disc": disc((0, 9)), "way": fixed(VALLEY), **bodies}
    with pytest.raises(LevelError, match=rule):
        level(scene, laws)


def test_a_parameter_is_not_called_as_what_runs_along_a_curve() -> None:
    s = {"s": {"value": 1, "min": 0, "max": 2}}
    with pytest.raises(
        LevelError, match="'s' is the parameter along the curves; choose another name"
    ):
        level(
            {"disc": disc((0, "9 + s")), "way": fixed(VALLEY)},  # type: ignore[arg-type]
            {"contact": {}},
            parameters=s,
        )


@pytest.mark.parametrize("shape", ["disc", "corner"])
def test_what_is_far_from_a_stretch_does_not_touch_it(
    shape: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Most of what is near the circle around a stretch is told from its nearest knot alone."""
    x = np.linspace(-3, 3, 24 * KNOT + 1)
    middle_line = MiddleLine(x + 0.3j * np.cos(2 * x))
    square = tuple(0.3 * 1j**k for k in range(4))
    other = Piece(1, (0j,), 0.3) if shape == "disc" else Piece(1, square, 0.0, corner=square[0])
    draw, is_far = np.random.default_rng(3), curve_contacts._is_far
    told: list[bool] = []
    monkeypatch.setattr(curve_contacts, "_is_far", lambda *args: told.append(is_far(*args)))
    for _ in range(500):
        place = complex(*draw.uniform((-3.5, -1), (3.5, 1))), complex(np.exp(6j * draw.random()))
        for stretch in middle_line.stretches:
            piece = Piece(0, (), 0.0, curve=Side(0, middle_line, stretch, 0.01))
            found = curve_contacts.verdict(piece, other, (0j, 1 + 0j), place)
            assert not (found and told[-1])
    assert sum(told) > len(told) / 2


def test_a_middle_line_is_shared_by_a_scene_and_goes_with_its_level() -> None:
    """A window that opens many levels keeps no middle lines of those before: 0.5 MB each."""
    shape = Curve.model_validate_json(json.dumps(curve("p*s", "s**2", -1, 1)))

    middle_line = curve_contacts.middle_line_of(shape, {"p": 1.0})

    assert curve_contacts.middle_line_of(shape, {"p": 1.0, "q": 2.0}) is middle_line
    assert curve_contacts.middle_line_of(shape, {"p": 2.0}) is not middle_line
    kept = ref(curve_contacts.middle_line_of(shape, {"p": 3.0}))
    del shape, middle_line
    gc.collect()
    assert kept() is None
