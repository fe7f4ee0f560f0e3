"""Snapping: to contact, to the grid, to corners; and distant parts are left alone."""

from math import cos, pi, sin, sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sandbox.editing.bodies_at_start import placed
from sandbox.editing.draft import Draft
from sandbox.editing.edits.bodies import add_box, add_disc, add_polygon, add_surface
from sandbox.editing.edits.moving_and_aligning import move, turn
from sandbox.editing.snapping import flat_turn, grid_step, snap_body, snap_point
from sandbox.model.loading import parse
from sandbox.physics.geometry.outline_distance import gap
from sandbox.physics.run import build

EMPTY = Draft.empty().text


def scene() -> str:
    text = Draft.empty().text
    text = add_disc(text, parse(text), (0, 2), (0.5, 2)).text
    text = add_box(text, parse(text), (2, 2), (3, 3)).text
    return add_polygon(text, parse(text), [(4, 2), (5, 2), (4.5, 3)]).text


def distance(text: str, one: str, other: str) -> float:
    where = placed(parse(text))
    return min(
        gap(a, b, where[one].radius + where[other].radius).distance
        for a in where[one].cores
        for b in where[other].cores
    )


@pytest.mark.parametrize("name", ["disc1", "box1", "polygon1"])
@pytest.mark.parametrize("angle", [0, 0.3, pi / 4, 2.0])
@pytest.mark.parametrize("off", [0.07, -0.05])
def test_a_body_that_comes_near_the_ground_touches_it_exactly(
    name: str, angle: float, off: float
) -> None:
    text = turn(scene(), parse(scene()), [name], angle)
    low = placed(parse(text))[name].bounds[0].imag
    found = snap_body(parse(text), [name], (0.1, off - low), 0.1)
    assert (found.kind, found.bodies) == ("contact", ("ground",))
    after = move(text, parse(text), [name], found.point)
    assert distance(after, name, "ground") == pytest.approx(0, abs=1e-12)
    assert found.point[0] == pytest.approx(0.1)


PAIRS = [("disc1", "box1"), ("disc1", "polygon1"), ("box1", "disc1"), ("box1", "polygon1")]


@pytest.mark.sweep
@pytest.mark.parametrize(("name", "other"), PAIRS)
@settings(max_examples=25)
@given(st.floats(0, 6.28), st.floats(-0.09, 0.09))
def test_bodies_meet_from_any_side_without_a_gap(
    name: str, other: str, angle: float, off: float
) -> None:
    text = scene()
    where = placed(parse(text))
    way = where[other].center - where[name].center
    far = way + 3 * complex(cos(angle), sin(angle))
    apart = distance(move(text, parse(text), [name], (far.real, far.imag)), name, other)
    near = far - (apart - off) * complex(cos(angle), sin(angle))
    level = parse(text)
    found = snap_body(level, [name], (near.real, near.imag), 0.1)
    if found.kind == "contact":
        after = move(text, level, [name], found.point)
        assert distance(after, name, found.bodies[0]) == pytest.approx(0, abs=1e-12)


def test_a_block_in_the_corner_of_a_room_touches_floor_and_wall() -> None:
    text = add_surface(scene(), parse(scene()), [(-4, 0), (-4, 5)]).text
    found = snap_body(parse(text), ["box1"], (-5.93, -1.96), 0.1)
    assert set(found.bodies) == {"ground", "surface1"}
    assert found.point == pytest.approx((-6, -2), abs=1e-14)


def test_a_disc_in_a_bend_of_one_surface_touches_both_sides() -> None:
    text = add_surface(scene(), parse(scene()), [(-4, 6), (-2, 4), (0, 6)]).text
    deep = 0.5 * sqrt(2)
    found = snap_body(parse(text), ["disc1"], (-2.03, 2 + deep + 0.04), 0.1)
    assert found.point == pytest.approx((-2, 2 + deep), abs=1e-12)


def test_along_the_floor_a_body_keeps_to_the_grid() -> None:
    found = snap_body(parse(scene()), ["box1"], (0.53, -1.97), 0.1, step=0.25)
    assert found.point == pytest.approx((0.5, -2), abs=1e-14)
    assert found.kind == "contact"


def test_a_body_that_touches_does_not_fall_and_is_not_thrown() -> None:
    text = scene()
    for name, way in (("box1", (0, -1.95)), ("disc1", (0, -1.45)), ("polygon1", (0, -2.05))):
        level = parse(text)
        text = move(text, level, [name], snap_body(level, [name], way, 0.1).point)
    start = np.array([body.center for body in placed(parse(text)).values()])
    end = build(parse(text)).advance(120).position
    assert np.abs(end - np.stack((start.real, start.imag), axis=1)).max() < 1e-6


def test_what_is_far_from_everything_is_left_alone_or_put_on_the_grid() -> None:
    level = parse(scene())
    assert snap_body(level, ["disc1"], (0.123, 0.3), 0.1).kind is None
    found = snap_body(level, ["disc1"], (0.123, 0.3), 0.1, step=0.5)
    assert (found.kind, found.point) == ("grid", (0, 0.5))


def test_a_point_is_drawn_to_a_corner_before_the_grid() -> None:
    level = parse(scene())
    assert snap_point(level, (2.03, 2.04), 0.1, 0.25) == ((2, 2), "corner", ("box1",))
    assert snap_point(level, (0.03, 1.96), 0.1, 0.25) == ((0, 2), "center", ("disc1",))
    assert snap_point(level, (2.03, 2.04), 0.1, 0.25, ["box1"]).kind == "grid"
    assert snap_point(level, (1.07, 1.11), 0.01).point == (1.07, 1.11)


@pytest.mark.parametrize(
    ("pixel", "step"), [(0.01, 0.1), (0.00125, 0.01), (0.02, 0.2), (1, 10), (1e-9, 1e-8)]
)
def test_the_grid_is_of_round_numbers_eight_pixels_apart_at_least(
    pixel: float, step: float
) -> None:
    assert grid_step(pixel) == pytest.approx(step)
    assert grid_step(pixel) >= 8 * pixel


@pytest.mark.parametrize("angle", [0.4, -0.7])
@pytest.mark.parametrize("off", [0.3, -0.5])
def test_a_block_is_turned_to_lie_flat_on_a_slope(angle: float, off: float) -> None:
    text = add_surface(EMPTY, parse(EMPTY), [(-6, 6), (6, 6)]).text
    text = turn(text, parse(text), ["surface1"], angle)
    text = add_box(text, parse(text), (-0.5, 6.5), (0.5, 7)).text
    text = turn(text, parse(text), ["box1"], angle + off)
    by = flat_turn(parse(text), "box1", 1.0)
    assert by == pytest.approx(-off, abs=1e-9)
    flat = turn(text, parse(text), ["box1"], by)
    level = parse(flat)
    after = move(flat, level, ["box1"], snap_body(level, ["box1"], (0, 0), 1.0).point)
    assert distance(after, "box1", "surface1") == pytest.approx(0, abs=1e-11)
    assert flat_turn(parse(EMPTY), "ground", 1.0) == 0


@pytest.mark.parametrize("size", [1e-6, 1e-3, 1e3, 1e6])
def test_bodies_of_any_size_touch_but_for_rounding(size: float) -> None:
    text = add_surface(EMPTY, parse(EMPTY), [(-6 * size, 30 * size), (6 * size, 31 * size)]).text
    text = add_disc(text, parse(text), (0, 31.7 * size), (size, 31.7 * size)).text
    found = snap_body(parse(text), ["disc1"], (0, 0), 0.5 * size)
    assert found.bodies == ("surface1",)
    after = move(text, parse(text), ["disc1"], found.point)
    assert abs(distance(after, "disc1", "surface1")) <= 1e-12 * max(1, 40 * size)


def test_a_peg_is_drawn_straight_above_what_hangs_from_it() -> None:
    text = Draft.empty().text
    level = parse(add_box(text, parse(text), (1.0, 1.0), (2.5, 2.0)).text)
    found = snap_point(level, (1.7, 6.04), 0.3, 0.5, in_line=True)
    assert found.point == (1.75, 6.0)
    assert found.kind == "line"
    assert snap_point(level, (1.7, 6.04), 0.3, 0.5).point == (1.5, 6.0)
    assert snap_point(level, (4.1, 6.04), 0.3, 0.5, in_line=True).kind == "grid"


PLANK = add_box(EMPTY, parse(EMPTY), (-3, 1), (3, 1.2)).text


@pytest.mark.parametrize("pointed", [(2.43, 1.23), (2.43, 1.17), (2.58, 1.29)])
def test_a_point_near_a_side_is_set_on_it_and_on_the_grid_along_it(
    pointed: tuple[float, float],
) -> None:
    found = snap_point(parse(PLANK), pointed, 0.25, 0.5)
    assert found == ((2.5, 1.2), "side", ("box1",))


def test_a_box_drawn_from_the_side_of_a_plank_touches_it() -> None:
    level = parse(PLANK)
    corner = snap_point(level, (2.03, 1.21), 0.25, 0.5).point
    text = add_box(PLANK, level, corner, (2.5, 1.7)).text
    assert abs(distance(text, "box1", "box2")) < 1e-12
    build(parse(text))


def test_a_corner_comes_before_a_side_and_a_side_before_the_grid() -> None:
    assert snap_point(parse(PLANK), (2.9, 1.25), 0.25, 0.5).kind == "corner"
    assert snap_point(parse(PLANK), (2.0, 1.6), 0.25, 0.5).kind == "grid"


@pytest.mark.sweep
@given(st.floats(0, 6.28), st.floats(-0.1, 0.1))
def test_a_point_near_a_disc_is_set_on_its_rim(angle: float, off: float) -> None:
    point = (0.5 + off) * cos(angle), 2 + (0.5 + off) * sin(angle)
    x, y = snap_point(parse(scene()), point, 0.12, 0.5).point
    assert np.hypot(x, y - 2) == pytest.approx(0.5, abs=1e-9)
