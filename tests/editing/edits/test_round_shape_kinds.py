"""Round bodies are turned into each other."""

import json

import pytest

from sandbox.editing.draft import Draft
from sandbox.editing.edits.bodies import add_disc
from sandbox.editing.edits.events import reverse, wait_for_quantity
from sandbox.editing.edits.field_values import set_field
from sandbox.editing.edits.resizing import ROUND, rounded
from sandbox.editing.renaming import rename
from sandbox.editing.text_patches import value_at
from sandbox.model.loading import parse
from sandbox.physics.run import build


def disc() -> str:
    text = Draft.empty().text
    return add_disc(text, parse(text), (0, 2), (1, 2)).text


@pytest.mark.parametrize("first", ROUND)
@pytest.mark.parametrize("second", ROUND)
def test_what_is_round_may_be_something_else_of_the_same_radius(first: str, second: str) -> None:
    text, name = disc(), "disc1"
    for kind in (first, second):
        text, (name,) = rounded(text, parse(text), name, kind)
    body = parse(text).bodies[name]

    assert name == f"{second}1"  # it is called after what it is
    assert value_at(text, ("bodies", name, "shape", "radius")) == 1
    assert (body.shape.type, body.type == "static") == (second, second == "arc")
    assert (body.mass is None) == (second == "arc")
    build(parse(text))


def test_what_has_a_name_keeps_it() -> None:
    text = rename(disc(), ("bodies", "disc1"), "bowl")
    assert rounded(text, parse(text), "bowl", "arc").name == "bowl"


def test_what_an_arc_is_comes_first_in_its_text() -> None:
    """As people write it, and as `format` leaves it: not after its colour and position."""
    text = rounded(disc(), parse(disc()), "disc1", "arc").text
    assert next(iter(json.loads(text)["bodies"]["arc1"])) == "type"


def test_a_disc_as_an_arc_and_back_moves_under_gravity_again() -> None:
    text = rounded(disc(), parse(disc()), "disc1", "arc").text
    assert not parse(text).effects.declared  # nothing moves that it could act on
    text = rounded(text, parse(text), "arc1", "disc").text
    assert value_at(text, ("bodies", "disc1", "mass")) == pytest.approx(31.4, rel=1e-2)


def test_a_valve_can_be_made_before_anything_moves() -> None:
    text = rounded(disc(), parse(disc()), "disc1", "arc").text
    text = set_field(text, ("bodies", "arc1", "one_way"), "left")
    text = add_disc(text, parse(text), (4, 2), (4.5, 2)).text
    assert parse(text).effects.contact is not None


def test_an_event_reverses_it_at_a_time_or_at_a_crossing() -> None:
    text = rounded(disc(), parse(disc()), "disc1", "arc").text
    text = set_field(text, ("bodies", "arc1", "one_way"), "left")
    text = add_disc(text, parse(text), (4, 2), (4.5, 2)).text
    text = reverse(text, parse(text), "arc1")
    assert value_at(text, ("events", "event1")) == {"at": 1, "reverse": ["arc1"]}
    text = wait_for_quantity(text, parse(text), "event1")
    assert value_at(text, ("events", "event1", "at", "quantity")) == "disc1.position.x"
