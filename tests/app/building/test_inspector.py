"""Every field of a level can be set beside the stage, and refuses nonsense there."""

from typing import get_args

import pygame
import pytest

from sandbox.app.building import editable_fields
from sandbox.app.building.editable_fields import Section
from sandbox.model.body import Body
from sandbox.model.effects import EFFECTS
from sandbox.model.joints import Joint
from tests.app.building.builder import Builder
from tests.sample import thinned


def test_a_field_takes_an_expression(builder: Builder) -> None:
    builder.at(-0.6, 0)
    builder.fill("2*m2 + 1", "bodies", "left", "mass")

    assert builder.document["bodies"]["left"]["mass"] == "2*m2 + 1"
    assert builder.person.session.level.bodies["left"].mass({"m2": 1.5}) == 4  # type: ignore[misc]


def test_nonsense_is_refused_beside_the_field_with_the_loaders_sentence(builder: Builder) -> None:
    before = builder.editor.work.draft.text
    builder.at(-0.6, 0)
    builder.fill("-3", "bodies", "left", "mass")

    assert builder.editor.work.draft.text == before
    assert "greater than 0" in builder.page._refused["bodies", "left", "mass"]


def test_one_click_makes_a_number_a_parameter(builder: Builder) -> None:
    builder.new()
    builder.tool("disc")
    builder.drag((0, 3), (1, 3))
    builder.click(builder.page.inspector.parametrise_button("bodies", "disc1", "mass").rect)
    builder.person.wait(1.0)  # changes are applied after a pause that grows with their cost

    assert builder.document["bodies"]["disc1"]["mass"] == "mass"
    assert "mass" in builder.person.session.level.parameters


def test_no_slider_lies_on_its_field(builder: Builder) -> None:
    """The time of a check may also be an event, so its field was as wide as one for text."""
    builder.key(pygame.K_ESCAPE)
    builder.act("Add a check")
    last = len(builder.document["checks"]) - 1
    for path in (("checks",), ("checks", last)):
        builder.open(*path)
    builder.fill("0.5", "checks", last, "at")
    inspector = builder.page.inspector
    button = inspector.parametrise_button("checks", last, "at")

    assert not button.rect.colliderect(inspector.field("checks", last, "at").rect)


def test_half_of_a_point_that_is_not_said_can_be_typed(builder: Builder) -> None:
    builder.at(-0.6, 0)
    builder.fill("-2", "bodies", "left", "velocity", 1)

    assert builder.document["bodies"]["left"]["velocity"] == [0, -2]


def test_several_bodies_are_given_a_field_alike_and_by_one_slider(builder: Builder) -> None:
    builder.new()
    for x in (-4, 0, 4):
        builder.tool("disc")
        builder.drag((x, 3), (x + 1, 3))
    builder.fill("3", "bodies", "disc3", "mass")
    builder.tool("select")
    builder.drag((-2, 6), (7, 1))
    field = builder.page.inspector.field("bodies", "disc2", "mass")
    assert field.get_text() == ""  # they differ

    builder.fill("2", "bodies", "disc2", "mass")
    builder.fill("0.7", "bodies", "disc2", "restitution")
    masses = [builder.document["bodies"][f"disc{i}"]["mass"] for i in (1, 2, 3)]
    assert masses[1:] == [2, 2]
    assert masses[0] > 4
    assert builder.page.inspector.field("bodies", "disc2", "mass").get_text() == "2"

    button = builder.page.inspector.parametrise_button("bodies", "disc2", "restitution")
    builder.reach(button)
    builder.click(button.rect)
    builder.person.wait(0.1)
    bounces = [builder.document["bodies"][f"disc{i}"]["restitution"] for i in (1, 2, 3)]
    assert bounces[1] == bounces[2] == list(builder.document["parameters"])[-1]
    assert bounces[0] == 0.5


def test_what_one_of_several_cannot_have_none_of_them_gets(builder: Builder) -> None:
    builder.new()
    for x in (-4, 0):
        builder.tool("disc")
        builder.drag((x, 3), (x + 1, 3))
    builder.tool("select")
    builder.drag((-6, 6), (3, 1))
    before = builder.editor.work.draft.text
    builder.fill("-1", "bodies", "disc1", "mass")

    assert builder.editor.work.draft.text == before
    assert "greater than 0" in builder.page._refused["bodies", "disc1", "mass"]


@pytest.mark.sweep
@pytest.mark.parametrize("effect", thinned(EFFECTS, 5))
def test_every_effect_is_switched_on_and_off(builder: Builder, effect: str) -> None:
    builder.new()
    for x in (0, 4):
        builder.tool("disc")
        builder.drag((x, 3), (x + 1, 3))
    builder.key(27)
    builder.key(27)
    if effect in builder.document["effects"]:
        builder.act(effect)
    if effect == "belt":  # which the loader refuses without
        builder.act("friction")
    builder.act(effect)
    builder.person.wait(0.1)
    assert effect in builder.document["effects"]
    builder.act(effect)

    assert effect not in builder.document.get("effects", {})


def test_every_field_of_the_models_has_a_row() -> None:
    for model in (Body, *get_args(get_args(Joint)[0])):
        said: dict[str, object] = {}
        rows = editable_fields.rows(model, said, ())  # type: ignore[arg-type]
        shown = {row.path[0] if isinstance(row, Section) else row[0].path[0] for row in rows}
        assert shown | {"type"} == {*model.model_fields, "type"}


def test_what_a_field_means_is_said_with_it() -> None:
    rows = editable_fields.rows(Body, {"shape": {"type": "disc", "radius": 1}}, ())
    entries = [entry for row in rows if not isinstance(row, Section) for entry in row]

    assert all(entry.help for entry in entries if entry.label != "type")
    assert next(entry.unit for entry in entries if entry.label == "mass") == "kg"


def test_an_angle_is_typed_in_degrees(builder: Builder) -> None:
    builder.at(-0.6, 0)
    builder.fill("30*deg", "bodies", "left", "angle")

    assert builder.document["bodies"]["left"]["angle"] == "30*deg"
