"""Drawn bodies: their fields, and whether the level loads."""

from math import cos, pi, sin, tau

import numpy as np
import pytest

from sandbox.editing.draft import Draft
from sandbox.editing.edits.bodies import (
    DENSITY,
    add_box,
    add_curve,
    add_disc,
    add_polygon,
    add_surface,
    remove_parts,
)
from sandbox.editing.edits.edit_result import EditResult
from sandbox.editing.edits.effects import declare
from sandbox.editing.written_out_shorthand import expanded
from sandbox.model import level_catalog
from sandbox.model.errors import SandboxError
from sandbox.model.level import Level
from sandbox.model.loading import parse, read
from sandbox.model.shapes import Disc, Polygon, Polyline, Segment
from sandbox.physics.run import build
from tests.sample import sampled

EMPTY = Draft.empty().text


def loaded(made: EditResult) -> Level:
    return parse(made.text)


def test_a_fresh_scene_gets_gravity_and_contact_with_its_first_body() -> None:
    level = loaded(add_disc(EMPTY, parse(EMPTY), (0, 2), (0.5, 2)))
    assert level.effects.declared == ("gravity", "contact")


def lean(text: str) -> float:
    """Return how far six drawn boxes, each 3 mm above the one below, go sideways in 5 s [m]."""
    for i in range(6):
        corner = 0.01 * (i % 2), 1.003 * i + 0.003
        text = add_box(text, parse(text), corner, (corner[0] + 1, corner[1] + 1)).text
    text = declare(declare(text, parse(text), "rotation"), parse(text), "friction")
    world = build(parse(text))
    before = world.snapshot.position
    return float(np.abs(world.advance(300).position - before)[:, 0].max())


def test_a_stack_that_is_drawn_by_hand_stands() -> None:
    """A new level says that contacts are solved directly; left to sweeps, the stack leans."""
    swept = EMPTY.replace('"solver": "direct"', '"solver": "iterative"')
    assert lean(EMPTY) < 1e-10  # 1e-14
    assert lean(swept) > 0.01


def test_a_scene_that_says_what_acts_is_left_to_it() -> None:
    text = read(level_catalog.find("energy/kepler-ellipse"))
    before = parse(text)
    level = loaded(add_disc(text, before, (5, 5), (5.5, 5)))
    assert level.effects == before.effects
    free = read(level_catalog.find("kinematics/uniform-acceleration"))
    assert loaded(add_disc(free, parse(free), (5, 5), (6, 5))).effects.gravity is None or (
        parse(free).effects.gravity is not None
    )


def test_bodies_are_of_one_material_and_named_in_order() -> None:
    disc = add_disc(EMPTY, parse(EMPTY), (0, 2), (0.5, 2))
    box = add_box(disc.text, loaded(disc), (1, 1), (3, 1.5))
    again = add_box(box.text, loaded(box), (1, 3), (2, 4))
    level = loaded(again)
    assert [disc.name, box.name, again.name] == ["disc1", "box1", "box2"]
    masses = {name: body.mass({}) for name, body in level.bodies.items() if body.mass}
    assert masses["disc1"] == pytest.approx(DENSITY * pi / 4, rel=5e-3)
    assert masses["box1"] == pytest.approx(DENSITY * 1, rel=5e-3)
    shape = level.bodies["disc1"].shape
    assert isinstance(shape, Disc)
    assert shape.radius({}) == 0.5


def test_a_polygon_lies_where_it_was_drawn() -> None:
    made = add_polygon(EMPTY, parse(EMPTY), [(3, 1), (5, 1), (3, 4)])
    body = loaded(made).bodies[made.name]
    assert [c({}) for c in body.position] == pytest.approx([3 + 2 / 3, 2])


def test_a_body_has_the_coefficients_that_every_body_needs() -> None:
    text = read(level_catalog.find("newton/incline-with-friction"))
    level = loaded(add_box(text, parse(text), (0, 9), (1, 10)))
    assert level.bodies["box1"].friction is not None


@pytest.mark.parametrize("points", [[(0, 0), (1, 0)], [(0, 0), (1, 1), (2, 2)], [(1, 1)] * 5])
def test_a_polygon_without_area_is_refused(points: list[tuple[float, float]]) -> None:
    with pytest.raises(SandboxError, match="three corners"):
        add_polygon(EMPTY, parse(EMPTY), points)


def test_a_click_is_no_body() -> None:
    with pytest.raises(SandboxError, match="size"):
        add_disc(EMPTY, parse(EMPTY), (1, 1), (1, 1))
    with pytest.raises(SandboxError, match="apart"):
        add_surface(EMPTY, parse(EMPTY), [(1, 1), (1, 1)])


def test_a_surface_stands_still() -> None:
    made = add_surface(EMPTY, parse(EMPTY), [(-3, 2), (1, 0)])
    body = loaded(made).bodies[made.name]
    assert body.type == "static"
    assert isinstance(body.shape, Segment)
    assert [c({}) for c in body.position] == [-1, 1]
    assert isinstance(
        loaded(add_surface(EMPTY, parse(EMPTY), [(0, 0), (1, 0), (1, 2)])).bodies["surface1"].shape,
        Polyline,
    )


def test_a_closed_stroke_is_a_polygon_with_few_corners_and_an_open_one_a_line() -> None:
    def stroke(far: float) -> list[tuple[float, float]]:
        return [(cos(far * i / 400), 2 + sin(far * i / 400)) for i in range(401)]

    round_one = add_curve(EMPTY, parse(EMPTY), stroke(tau), 0.02)
    shape = loaded(round_one).bodies[round_one.name].shape
    assert isinstance(shape, Polygon)
    assert 8 <= len(shape.vertices) <= 40
    half = add_curve(EMPTY, parse(EMPTY), stroke(pi), 0.02)
    line = loaded(half).bodies[half.name].shape
    assert isinstance(line, Polyline)
    assert 4 <= len(line.points) <= 20


def test_what_a_body_gave_a_meaning_goes_with_it() -> None:
    text = read(level_catalog.find("newton/atwood"))
    left = parse(remove_parts(text, parse(text), ["right"]))
    assert list(left.bodies) == ["left"]
    assert not left.joints
    assert list(left.ghosts) == ["left"]


@pytest.mark.parametrize("name", sampled(level_catalog.textbook(), "take out"))
def test_any_body_but_the_last_can_be_taken_out_of_a_level(name: str) -> None:
    text = expanded(read(level_catalog.find(name)))
    level = parse(text)
    for body in list(level.bodies)[:3]:
        if len(level.bodies) > 1:
            assert body not in parse(remove_parts(text, level, [body])).bodies


def test_the_last_body_stays() -> None:
    with pytest.raises(SandboxError, match="draw another"):
        remove_parts(EMPTY, parse(EMPTY), ["ground"])
