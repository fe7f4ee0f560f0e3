"""The texts of the page, and the behaviour of its fields, tools and choices."""

import pygame

from sandbox.app.drawing import theme
from sandbox.app.pages.build import mistakes_suggestions_and_effects
from sandbox.app.widgets.widget_states_and_scrolling import scroll_position
from tests.app.building.builder import Builder


def texts(builder: Builder) -> list[str]:
    return [block.text for block in mistakes_suggestions_and_effects.subject(builder.editor)]


def test_it_says_when_effects_and_checks_are_shown_and_a_button_leads_there(
    builder: Builder,
) -> None:
    builder.at(-0.6, 0)
    assert any("while nothing is selected" in text for text in texts(builder))
    builder.act("Select nothing")
    builder.person.wait(0.1)

    assert builder.page.button("gravity").is_selected


def test_everyday_effects_can_be_switched_beside_the_fields_of_a_body(builder: Builder) -> None:
    """Whoever has just drawn a box saw no way to let it turn."""
    builder.new()
    builder.tool("box")
    builder.drag((0, 0), (1, 1))
    assert builder.editor.work.selected
    assert builder.page.button("contact").is_selected
    assert not builder.page.button("rotation").is_selected

    builder.act("rotation")
    builder.person.wait(0.1)

    assert "rotation" in builder.document["effects"]
    assert builder.editor.work.selected
    assert builder.page.button("rotation").is_selected


def test_a_joint_is_a_pin_at_first_and_is_told_of_in_words(builder: Builder) -> None:
    builder.new()
    builder.tool("box")
    builder.drag((-1, 1), (1, 2))
    builder.tool("join")
    builder.at(0, 1.5)

    (pin,) = builder.document["joints"].values()
    assert pin["type"] == "pivot"
    assert builder.person.window.banner.is_showing("Tied: box 1 to the plane")


def test_tools_stay_where_they_are_while_the_fields_are_scrolled(builder: Builder) -> None:
    builder.at(-0.6, 0)
    before = builder.page.palette.button("disc").rect.copy()
    builder.reach(builder.page.inspector.field("bodies", "left", "layer"))

    assert builder.page.palette.button("disc").rect == before


def test_what_was_typed_into_a_field_that_is_left_is_taken(builder: Builder) -> None:
    builder.at(-0.6, 0)
    builder.click(builder.page.inspector.field("bodies", "left", "angle").rect)
    pygame.event.post(pygame.Event(pygame.TEXTINPUT, text="1"))
    builder.person.wait(0.1)
    builder.at(1.5, 3)

    assert builder.document["bodies"]["left"]["angle"] == 1
    assert not builder.editor.work.selected


def test_enter_leaves_a_field_so_that_the_keys_are_those_of_the_tools(builder: Builder) -> None:
    builder.at(-0.6, 0)
    builder.fill("3", "bodies", "left", "mass")
    builder.key(pygame.K_7, "7")

    assert builder.editor.tools.tool == "join"
    assert builder.document["bodies"]["left"]["mass"] == 3


def test_escape_takes_back_what_was_refused(builder: Builder) -> None:
    builder.at(-0.6, 0)
    builder.fill("-3", "bodies", "left", "mass")
    assert builder.page.inspector.field("bodies", "left", "mass").get_text() == "-3"
    builder.key(pygame.K_ESCAPE)
    builder.person.wait(0.1)

    assert builder.page.inspector.field("bodies", "left", "mass").get_text() == "m1"
    assert builder.page._refused == {}


def test_each_choice_has_a_button_and_what_cannot_be_is_told_beside_it(builder: Builder) -> None:
    builder.at(-0.6, 0)
    lines = builder.page.inspector._lines["bodies", "left", "one_way"]
    left = next(button for button, means in lines.choices.items() if means == "left")
    builder.reach(left)
    builder.click(left.rect)
    builder.person.wait(0.1)

    assert "can be one-way" in builder.page._refused["bodies", "left", "one_way"]
    assert "one_way" not in builder.document["bodies"]["left"]


def test_a_body_that_is_made_static_loses_its_mass(builder: Builder) -> None:
    builder.at(-0.6, 0)
    lines = builder.page.inspector._lines["bodies", "left", "type"]
    static = next(button for button, means in lines.choices.items() if means == "static")
    dynamic = next(button for button, means in lines.choices.items() if means == "dynamic")
    assert dynamic.is_selected
    builder.click(static.rect)
    builder.person.wait(0.1)

    assert builder.page._refused == {}
    assert builder.document["bodies"]["left"]["type"] == "static"
    assert "mass" not in builder.document["bodies"]["left"]


def test_the_joint_in_hand_is_lit(builder: Builder) -> None:
    builder.tool("join")
    builder.tool("rod")
    builder.tool("rod")
    builder.person.move((0, 0))
    corners = [builder.page.palette.button(name).rect.move(4, 4) for name in ("rod", "pulley")]
    rod, pulley = (builder.person.color_at(corner.topleft) for corner in corners)

    assert rod == theme.palette("dark")["selected"]
    assert pulley != rod


def test_an_effect_that_turns_bodies_brings_rotation_with_it(builder: Builder) -> None:
    builder.new()
    builder.tool("disc")
    builder.drag((0, 3), (1, 3))
    builder.key(pygame.K_ESCAPE)
    builder.key(pygame.K_ESCAPE)
    builder.act("torque")

    assert {"torque", "rotation"} <= builder.document["effects"].keys()


def test_the_run_begins_at_the_top_of_the_page(builder: Builder) -> None:
    builder.at(-0.6, 0)
    container = builder.page._sheet.container
    builder.reach(builder.page.inspector.field("bodies", "left", "layer"))
    assert scroll_position(container) > 0

    builder.click(builder.page.palette.button("Try it").rect)
    builder.person.wait(0.2)
    assert scroll_position(container) == 0


def test_the_run_begins_at_the_top_of_the_page_where_no_body_is_selected(builder: Builder) -> None:
    """The page says little about a run, so it needs no scroll bar."""
    container = builder.page._sheet.container
    builder.reach(builder.page.inspector.field("duration"))
    assert scroll_position(container) > 0

    builder.click(builder.page.palette.button("Try it").rect)
    builder.person.wait(0.2)
    assert scroll_position(container) == 0


def test_the_tip_of_a_button_that_was_pressed_does_not_cover_the_answer(builder: Builder) -> None:
    """Why a level cannot run is said right below the button that tries it."""
    button = builder.page.palette.button("Try it")

    def is_tipped() -> bool:
        return button.tool_tip is not None

    builder.person.move(button.rect.center)
    builder.person.wait(1.0)
    assert is_tipped()

    builder.click(button.rect)
    builder.person.wait(1.0)
    assert not is_tipped()

    builder.person.move((button.rect.centerx, button.rect.bottom + 200))
    builder.person.move(button.rect.center)
    builder.person.wait(1.0)
    assert is_tipped()
