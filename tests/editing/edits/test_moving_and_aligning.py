"""Bodies are moved, turned and aligned: their new places, and what moves with them."""

from collections.abc import Callable
from math import pi

import pytest

from sandbox.editing.bodies_at_start import placed
from sandbox.editing.draft import Draft
from sandbox.editing.edits.bodies import add_box
from sandbox.editing.edits.moving_and_aligning import Side, align, distribute, move, turn
from sandbox.editing.text_patches import value_at
from sandbox.editing.written_out_shorthand import expanded
from sandbox.model import level_catalog
from sandbox.model.level import Level
from sandbox.model.loading import parse, read
from tests.sample import sampled


def shipped(name: str) -> tuple[str, Level]:
    text = expanded(read(level_catalog.find(name)))
    return text, parse(text)


def three_boxes() -> tuple[str, Level]:
    text = Draft.empty().text
    for x, y, w, h in ((0, 0, 1, 1), (3, 1, 1, 2), (7, 4, 0.5, 0.5)):
        text = add_box(text, parse(text), (x, y), (x + w, y + h)).text
    return text, parse(text)


BOXES = ["box1", "box2", "box3"]


def test_a_formula_stays_one_when_its_body_is_moved() -> None:
    text, level = shipped("kinematics/free-fall")
    moved = move(text, level, ["ball"], (0.5, 0.25))
    assert value_at(moved, ("bodies", "ball", "position")) == [0.5, "height + 0.25"]
    again = move(moved, parse(moved), ["ball"], (0, 0.5))
    assert value_at(again, ("bodies", "ball", "position")) == [0.5, "height + 0.75"]
    back = move(again, parse(again), ["ball"], (-0.5, -0.75))
    assert back == text


def test_pins_and_all_that_is_pinned_move_along() -> None:
    text, level = shipped("machines/ragdoll")
    moved = parse(move(text, level, ["torso"], (1, 2)))
    before, after = placed(level), placed(moved)
    ways = {name: after[name].center - before[name].center for name in before}
    assert ways["torso"] == pytest.approx(1 + 2j)
    assert all(
        way == pytest.approx(1 + 2j)
        for name, way in ways.items()
        if level.bodies[name].type == "dynamic"
    )


def test_the_bob_of_a_pendulum_moves_and_its_pivot_stays() -> None:
    text, level = shipped("lagrange/simple-pendulum")
    moved = parse(move(text, level, ["bob"], (0.1, 0)))
    assert moved.joints == level.joints


def test_the_pin_of_a_door_goes_with_it() -> None:
    text, level = shipped("rotation/door")
    name = next(n for n, joint in level.joints.items() if joint.type == "pivot")
    door = next(n for n, body in level.bodies.items() if body.type == "dynamic")
    moved = move(text, level, [door], (0.5, 0.5))
    assert parse(moved).joints[name] != level.joints[name]
    turned = move(text, level, [door], (0, 0))
    assert turned == text


def test_a_body_turns_about_its_centre_and_is_written_in_degrees() -> None:
    text, level = three_boxes()
    turned = turn(text, level, ["box2"], pi / 6)
    assert value_at(turned, ("bodies", "box2", "angle")) == "30*deg"
    assert value_at(turned, ("bodies", "box2", "position")) == [3.5, 2]
    back = turn(turned, parse(turned), ["box2"], -pi / 6)
    assert value_at(back, ("bodies", "box2", "angle")) == 0


def test_bodies_turn_together_about_a_point() -> None:
    text, level = three_boxes()
    after = placed(parse(turn(text, level, BOXES, pi / 2, about=(0, 0))))
    before = placed(level)
    for name in BOXES:
        assert after[name].center == pytest.approx(before[name].center * 1j, abs=1e-12)


EDGES: dict[Side, Callable[[complex, complex], float]] = {
    "left": lambda low, _: low.real,
    "right": lambda _, high: high.real,
    "bottom": lambda low, _: low.imag,
    "top": lambda _, high: high.imag,
    "center-x": lambda low, high: (low + high).real,
    "center-y": lambda low, high: (low + high).imag,
}


@pytest.mark.parametrize("side", EDGES)
def test_aligned_bodies_have_a_side_in_common(side: Side) -> None:
    text, level = three_boxes()
    after = placed(parse(align(text, level, BOXES, side)))
    found = [EDGES[side](*after[name].bounds) for name in BOXES]
    assert found == pytest.approx([found[0]] * 3, abs=1e-12)


def test_distributed_bodies_have_equal_gaps() -> None:
    text, level = three_boxes()
    after = placed(parse(distribute(text, level, BOXES, "x")))
    boxes = [after[name].bounds for name in BOXES]
    assert boxes[1][0].real - boxes[0][1].real == pytest.approx(
        boxes[2][0].real - boxes[1][1].real, abs=1e-12
    )
    assert boxes[0] == placed(level)["box1"].bounds


@pytest.mark.parametrize("name", sampled(level_catalog.textbook(), "move"))
def test_every_body_of_every_level_can_be_moved(name: str) -> None:
    text, level = shipped(name)
    for body in list(level.bodies)[:2]:
        draft = Draft.of(text)
        draft.change(move(text, level, [body], (0.125, -0.25)), "move")
        named = {mistake.path.split(".")[0] for mistake in draft.mistakes}
        assert named <= {"joints", "bodies"}, draft.mistakes
