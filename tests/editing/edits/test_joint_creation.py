"""Joints of every kind, made by picking points."""

import pytest

from sandbox.editing.draft import Draft
from sandbox.editing.edits.bodies import add_box, add_disc
from sandbox.editing.edits.joint_creation import Pick, add_joint, picks
from sandbox.editing.text_patches import value_at
from sandbox.model.errors import SandboxError
from sandbox.model.joints import KINDS
from sandbox.model.loading import parse
from sandbox.physics.run import build


def scene() -> str:
    text = Draft.empty().text
    text = add_disc(text, parse(text), (0, 3), (0.5, 3)).text
    return add_box(text, parse(text), (2, 3), (3, 4)).text


DISC, BOX, PEG = Pick((0, 3), "disc1"), Pick((2.5, 3.5), "box1"), Pick((1, 6))


def chosen(kind: str, first: Pick, second: Pick) -> list[Pick]:
    return [first, PEG, second][:: 1 if picks(kind) == 3 else 2]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("first", [DISC, Pick((0.25, 3.25), "disc1")], ids=["centre", "point"])
@pytest.mark.parametrize("second", [BOX, Pick((3, 3), "box1"), Pick((2, 5))], ids=str)
def test_every_joint_is_made_and_runs(kind: str, first: Pick, second: Pick) -> None:
    text = scene()
    level = parse(text)
    order = chosen(kind, first, second)
    if kind in ("winding", "rack"):
        order = [second, first]
    if kind == "gear":  # it ties bodies to each other
        order = [first, BOX]
    made = add_joint(text, level, kind, order)
    after = parse(made.text)
    assert made.name == f"{kind}1"
    assert after.joints[made.name].type == kind
    build(after).advance(3)


def test_a_gear_needs_two_wheels() -> None:
    with pytest.raises(SandboxError, match="pick two bodies"):
        add_joint(scene(), parse(scene()), "gear", [DISC, PEG])


def test_a_centre_is_the_body_and_a_point_is_in_its_axes() -> None:
    made = add_joint(scene(), parse(scene()), "rod", [DISC, Pick((3, 4), "box1")])
    assert value_at(made.text, ("joints", "rod1", "ends")) == [
        "disc1",
        {"body": "box1", "at": [0.5, 0.5]},
    ]


def test_what_turns_a_body_declares_that_bodies_turn() -> None:
    made = add_joint(scene(), parse(scene()), "motor", [DISC, Pick((0, 3))])
    assert parse(made.text).effects.rotation is not None
    assert value_at(made.text, ("joints", "motor1", "ends")) == [[0, 3], "disc1"]
    rope = add_joint(scene(), parse(scene()), "rope", [DISC, Pick((0, 5))])
    assert parse(rope.text).effects.rotation is None


@pytest.mark.parametrize("other", [BOX.body, None])
def test_a_motor_takes_the_place_of_a_pivot_since_it_is_a_pin_itself(other: str | None) -> None:
    parts = [DISC, DISC._replace(body=other)]
    pinned = add_joint(scene(), parse(scene()), "pivot", parts).text
    elsewhere = add_joint(pinned, parse(pinned), "pivot", [BOX, BOX._replace(body=None)]).text

    made = parse(add_joint(elsewhere, parse(elsewhere), "motor", parts).text)

    assert list(made.joints) == ["pivot2", "motor1"]
    if other is None:  # else the frame is pinned and driven at once
        build(made).advance(3)


def test_a_string_leaves_its_wheel_on_the_side_that_was_picked() -> None:
    tied = Pick((0, 6))
    for x, way in ((0.4, "counterclockwise"), (-0.4, "clockwise")):
        made = add_joint(scene(), parse(scene()), "winding", [tied, Pick((x, 3), "disc1")])
        assert value_at(made.text, ("joints", "winding1", "unwinds")) == way
        assert value_at(made.text, ("joints", "winding1", "radius")) == 0.5


def test_what_cannot_be_joined_is_refused_by_the_loaders_own_sentence() -> None:
    with pytest.raises(SandboxError, match="two different bodies are needed"):
        add_joint(scene(), parse(scene()), "rod", [DISC, DISC])
    with pytest.raises(SandboxError, match="at least one end must be a dynamic body"):
        add_joint(scene(), parse(scene()), "rod", [Pick((0, 0)), Pick((1, 0), "ground")])
    with pytest.raises(SandboxError, match="needs 3 points"):
        add_joint(scene(), parse(scene()), "pulley", [DISC, BOX])
    with pytest.raises(SandboxError, match="did you mean 'rope'"):
        add_joint(scene(), parse(scene()), "roep", [DISC, BOX])


def test_a_wheel_that_overlaps_its_car_does_not_meet_it() -> None:
    text = add_disc(scene(), parse(scene()), (2, 3), (2.3, 3)).text
    pin = [Pick((2, 3), "disc2"), Pick((2, 3), "box1")]
    level = parse(add_joint(text, parse(text), "pivot", pin).text)
    contact = level.effects.contact
    assert contact is not None
    assert contact.apart == (("box1", "disc2"),)
    build(level).advance(3)


def test_bodies_that_are_joined_at_a_distance_still_meet() -> None:
    level = parse(add_joint(scene(), parse(scene()), "rope", [DISC, BOX]).text)
    assert level.effects.contact is not None
    assert not level.effects.contact.apart


def test_what_is_put_on_a_pin_can_turn() -> None:
    """A plank on a pin through its middle is a seesaw, and does not stand stiffly."""
    text = Draft.empty().text
    text = add_box(text, parse(text), (-3, 1), (3, 1.2)).text
    made = add_joint(text, parse(text), "pivot", [Pick((0, 1.1), "box1"), Pick((0, 1.1))])
    assert parse(made.text).effects.rotation is not None
