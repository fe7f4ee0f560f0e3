"""From a level to pymunk: shapes, moments, and nothing that was not asked for."""

from math import cos, inf, pi, sin

import numpy as np
import pymunk
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sandbox.model.level import Stepping
from sandbox.physics.contacts.shapes.pymunk_shapes import INSET, SKIN
from sandbox.physics.engine.pymunk_bodies import local_points
from sandbox.physics.geometry.convex_decomposition import convex_parts, twice_area
from sandbox.physics.run import build
from sandbox.physics.scene.make_scene import Scene, make_scene
from tests.physics.scenes import GRAVITY, G, Spec, box, disc, fixed, floor, level, run

EVERYTHING: Spec = {**GRAVITY, "contact": {}, "rotation": {}}
Points = list[list[float]]

CUP: Points = [[-1, -1], [1, -1], [1, 1], [0.8, 1], [0.8, -0.8], [-0.8, -0.8], [-0.8, 1], [-1, 1]]


def scene(bodies: dict[str, Spec], effects: Spec, scheme: str = "leapfrog") -> Scene:
    made = level(bodies, effects, stepping={"scheme": scheme})
    return make_scene(made, made.defaults, made.stepping)


def body(shape: Spec, **rest: object) -> Spec:
    return {"shape": shape, "mass": 3, **rest}


@pytest.mark.parametrize(
    ("shape", "moment"),
    [
        ({"type": "disc", "radius": 0.4}, 3 * 0.4**2 / 2),
        ({"type": "hoop", "radius": 0.4}, 3 * 0.4**2),
        ({"type": "box", "width": 2, "height": 0.5}, 3 * (2**2 + 0.5**2) / 12),
        (
            {"type": "polygon", "vertices": [[0, 0], [2, 0], [2, 0.5], [0, 0.5]]},
            3 * (2**2 + 0.5**2) / 12,
        ),
        (
            {"type": "polygon", "vertices": [[0, 0.5], [2, 0.5], [2, 0], [0, 0]]},
            3 * (2**2 + 0.5**2) / 12,
        ),
        ({"type": "polygon", "vertices": [[0, 0], [3, 0], [0, 4]]}, 3 * (3**2 + 4**2) / 18),
        ({"type": "segment", "start": [1, 1], "end": [4, 5]}, 3 * 5**2 / 12),
        ({"type": "polyline", "points": [[0, 0], [1, 0], [1.5, 0], [3, 0]]}, 3 * 3**2 / 12),
        ({"type": "polyline", "points": [[0, 0], [2, 0], [2, 2], [0, 2], [0, 0]]}, 3 * 2**2 / 3),
    ],
)
def test_moments_of_inertia_are_those_of_the_textbook(shape: Spec, moment: float) -> None:
    """About the centre of mass; for a triangle with legs a, b that is m (a² + b²) / 18."""
    made = scene({"body": body(shape), "other": disc((9, 9))}, EVERYTHING)

    assert made.moment[0] == pytest.approx(moment, rel=1e-12)


@pytest.mark.parametrize("away", [1e6, 1e9, 1e14])
def test_a_polygon_has_the_same_moment_however_far_its_corners_are_from_the_origin(
    away: float,
) -> None:
    """An area is a difference of squares, of which rounding left nothing but a negative moment."""
    corners = [[away, away], [away + 4, away], [away, away + 2]]
    other = disc((9, 9))
    made = scene({"body": body({"type": "polygon", "vertices": corners}), "b": other}, EVERYTHING)

    assert made.moment[0] == pytest.approx(3 * (4**2 + 2**2) / 18, rel=1e-12)


def test_a_level_may_give_a_moment_of_its_own() -> None:
    made = scene({"body": disc(moment=7), "floor": floor(-1)}, EVERYTHING)

    assert made.bodies["body"].moment == made.moment[0] == 7


@pytest.mark.parametrize(
    ("shape", "shift"),
    [
        ({"type": "polygon", "vertices": [[0, 0], [3, 0], [0, 3]]}, [1, 1]),
        ({"type": "polygon", "vertices": CUP}, None),
        ({"type": "segment", "start": [0, 0], "end": [4, 2]}, [2, 1]),
        ({"type": "polyline", "points": [[0, 0], [2, 0], [2, 2]]}, [1.5, 0.5]),
    ],
)
def test_a_dynamic_bodys_position_is_its_centre_of_mass(
    shape: Spec, shift: list[float] | None
) -> None:
    """A body that turns freely turns about its position: the position goes straight on."""
    spec = body(shape, velocity=[1, 0.5], angular_velocity=2)
    made = level({"body": spec}, {"rotation": {}})
    end = build(made).advance(60)

    assert end.position[0] == pytest.approx([1, 0.5])
    assert end.angle[0] == pytest.approx(2)
    if shift:
        first = np.array(local_points(made.bodies["body"], {})[0])
        assert first == pytest.approx(-np.array(shift), abs=1e-12)


def test_a_static_body_keeps_its_points_as_they_are_written() -> None:
    made = level({"ramp": fixed({"type": "polygon", "vertices": [[0, 0], [3, 0], [0, 3]]})}, {})

    assert local_points(made.bodies["ramp"], {}) == [(0, 0), (3, 0), (0, 3)]


def surface(shape: pymunk.Shape) -> float:
    """The area of a convex shape, rounding left out: that of its core and a rim around it."""
    assert isinstance(shape, pymunk.Poly)
    a = np.array(shape.get_vertices())
    b = np.roll(a, -1, axis=0)
    core = abs(np.sum(a[:, 0] * b[:, 1] - b[:, 0] * a[:, 1])) / 2
    return float(core + np.sum(np.hypot(*(b - a).T)) * shape.radius)


@pytest.mark.sweep
@settings(max_examples=100, deadline=None)
@given(st.lists(st.floats(0.2, 1), min_size=5, max_size=14), st.booleans())
def test_the_parts_of_a_star_fill_it(radii: list[float], clockwise: bool) -> None:
    """Convex or not, and either way round: the parts have the area of the whole."""
    turn = -1 if clockwise else 1
    corners = np.array(
        [
            [r * cos(2 * pi * i / len(radii)), turn * r * sin(2 * pi * i / len(radii))]
            for i, r in enumerate(radii)
        ]
    )
    following = np.roll(corners, -1, axis=0)
    cross = corners[:, 0] * following[:, 1] - following[:, 0] * corners[:, 1]
    shape = {"type": "polygon", "vertices": corners.tolist()}
    made = scene({"star": fixed(shape), "ball": disc((9, 9))}, {"contact": {}})
    parts = made.bodies["star"].shapes

    assert sum(surface(part) for part in parts) == pytest.approx(abs(cross.sum()) / 2, rel=1e-6)


@pytest.mark.sweep
@settings(max_examples=100, deadline=None)
@given(st.integers(2, 40), st.floats(0.3, 6), st.sampled_from([0.01, 0.1, 0.5]))
def test_a_bent_bar_is_cut_into_convex_parts_that_fill_it(n: int, arc: float, width: float) -> None:
    """pymunk's own decomposition of this ends the process for some n."""
    angles = [arc * i / n for i in range(n + 1)]
    outer = [(cos(a), sin(a)) for a in angles]
    bar = outer + [((1 - width) * x, (1 - width) * y) for x, y in outer[::-1]]
    parts = convex_parts(bar)

    areas = [twice_area(np.array(part)) for part in parts]
    assert min(areas) > 0
    assert sum(areas) == pytest.approx(twice_area(np.array(bar)), rel=1e-9)
    assert len(parts) <= n + 1
    for part in parts:
        a, b, c = (np.roll(np.array(part), -i, axis=0) for i in range(3))
        turns = (b - a)[:, 0] * (c - b)[:, 1] - (b - a)[:, 1] * (c - b)[:, 0]
        assert turns.min() >= -1e-11


def test_a_ball_falls_into_a_cup() -> None:
    """pymunk alone would fill the hollow and keep the ball outside."""
    cup = fixed({"type": "polygon", "vertices": CUP})
    bodies = {"ball": disc((0, 3), radius=0.3), "cup": cup}
    end = build(level(bodies, {**GRAVITY, "contact": {}})).advance(240)

    assert end.position[0] == pytest.approx([0, -0.5], abs=1e-5)
    assert end.normal[0] == pytest.approx(G, rel=1e-6)


@pytest.mark.parametrize("clockwise", [False, True])
def test_flat_surfaces_stand_proud_by_a_skin_and_discs_do_not(clockwise: bool) -> None:
    """As a core that is smaller by an inset of each body's own, with the rest as a radius."""
    corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]][:: -1 if clockwise else 1]
    square = body({"type": "polygon", "vertices": corners})
    larger = box((3, 0), size=(2, 2))
    bodies = {"square": square, "box": larger, "disc": disc((6, 0), radius=0.7), "floor": floor(-1)}
    made = scene(bodies, {"contact": {"overlaps": True}})
    insets = []
    for name in ("square", "box"):
        (shape,) = made.bodies[name].shapes
        assert isinstance(shape, pymunk.Poly)
        insets.append(shape.radius - SKIN)
        assert INSET <= insets[-1] <= 2 * INSET
        assert np.abs(shape.get_vertices()) == pytest.approx(1 - insets[-1], rel=1e-15)

    assert abs(insets[0] - insets[1]) > 1e-9
    (circle,), (line,) = made.bodies["disc"].shapes, made.bodies["floor"].shapes
    assert isinstance(circle, pymunk.Circle)
    assert isinstance(line, pymunk.Segment)
    assert circle.radius == 0.7
    assert line.radius == SKIN


def test_the_naive_schemes_take_surfaces_as_they_come() -> None:
    made = scene({"box": box(), "floor": floor(-0.25)}, {"contact": {}}, "symplectic-euler")

    assert [shape.radius for shape in made.space.shapes] == [0, 0]
    assert made.space.collision_slop == pymunk.Space().collision_slop


def test_without_contact_no_shape_is_in_the_space() -> None:
    made = scene({"a": disc(), "b": disc(), "floor": floor()}, {**GRAVITY})

    assert list(made.space.shapes) == []


def test_without_contact_bodies_pass_through_each_other() -> None:
    bodies = {"a": disc((-2, 0), velocity=[2, 0]), "b": disc((2, 0), velocity=[-2, 0])}
    flight = run(build(level(bodies, {})), 120)

    assert (flight.velocity[:, :, 0] == [2, -2]).all()


def test_without_rotation_moments_are_infinite_and_nothing_turns() -> None:
    made = scene({"a": disc(), "b": box((5, 0))}, {"contact": {}})

    assert [b.moment for b in made.bodies.values()] == [inf, inf]
    assert made.moment.tolist() == [0, 0]


def test_without_friction_and_restitution_their_coefficients_are_zero() -> None:
    made = scene({"a": disc(), "b": box((5, 0)), "floor": floor()}, {"contact": {"overlaps": True}})

    assert {(s.friction, s.elasticity) for s in made.space.shapes} == {(0.0, 0.0)}


def test_coefficients_are_the_bodies_own() -> None:
    bodies = {
        "a": disc(friction=0.4, restitution=0.3),
        "floor": floor(-1, friction=0.5, restitution=1),
    }
    made = scene(bodies, {"contact": {}, "friction": {}, "restitution": {}})

    found = {s.body: (s.friction, s.elasticity) for s in made.space.shapes}
    assert found[made.bodies["a"]] == (0.4, 0.3)
    assert found[made.bodies["floor"]] == (0.5, 1)


@pytest.mark.parametrize("rate", [60, 240])
@pytest.mark.parametrize(
    ("contact", "restitution", "share"),
    [
        ({}, False, 0.2),
        ({}, True, 0),
        ({"correction": 0.5}, True, 0.5),
        ({"correction": 1}, False, 1),
    ],
)
def test_an_overlap_is_taken_back_by_its_share_a_step(
    contact: Spec, restitution: bool, share: float, rate: int
) -> None:
    """pymunk's collision_bias is what is left after a second."""
    rest: Spec = {"restitution": 1} if restitution else {}
    made = level(
        {"a": disc(**rest), "floor": floor(-0.4, **rest)},
        {
            "contact": {**contact, "slop": 0, "overlaps": True},
            **({"restitution": {}} if restitution else {}),
        },
        stepping={"rate": rate},
    )
    world = build(made)
    depth = 0.1 + SKIN - run(world, 2).position[:, 0, 1]

    # the correction of a step is seen in the position one drift later
    assert depth[2] == pytest.approx(depth[1] * (1 - share), abs=1e-8)


@pytest.mark.sweep
@given(st.lists(st.sampled_from(["dynamic", "static", "kinematic"]), min_size=1, max_size=6))
def test_only_what_is_dynamic_has_mass(types: list[str]) -> None:
    shape = {"type": "disc", "radius": 1}
    bodies: dict[str, Spec] = {
        f"b{i}": {"type": kind, "shape": shape, **({"mass": i + 1} if kind == "dynamic" else {})}
        for i, kind in enumerate(types)
    }
    made = scene(bodies, {})

    assert made.mass.tolist() == [i + 1 if k == "dynamic" else 0 for i, k in enumerate(types)]


def test_the_stepping_of_a_run_may_differ_from_the_levels() -> None:
    made = level({"a": disc()}, {})
    world = build(made, stepping=Stepping(rate=100, iterations=33))

    assert world.dt == 0.01
    assert world.scene.space.iterations == 33
