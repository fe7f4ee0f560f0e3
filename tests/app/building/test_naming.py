"""Names: bodies are renamed, quantities completed, checks and ghosts added and removed."""

import pygame
import pytest

from sandbox.model.loading import parse
from tests.app.building.builder import Builder


def typed(builder: Builder, text: str, *path: str | int) -> None:
    """Replace the text of a field, and stay in it."""
    field = builder.page.inspector.field(*path)
    builder.reach(field)
    builder.click(field.rect)
    builder.key(pygame.K_a, mod=pygame.KMOD_LCTRL)
    for letter in text:
        pygame.event.post(pygame.Event(pygame.TEXTINPUT, text=letter))
    builder.person.wait(0.1)


@pytest.mark.sweep
def test_a_body_gets_another_name_wherever_it_is_mentioned(builder: Builder) -> None:
    builder.at(-0.6, 0)
    builder.fill("heavy", "bodies", "left")

    assert builder.document["joints"]["string"]["ends"][0] == "heavy"
    assert builder.editor.work.selected == (("bodies", "heavy"),)
    level = parse(builder.editor.work.draft.text)
    assert any(check.quantity.startswith("heavy.") for check in level.checks)


def test_a_name_that_is_taken_is_refused_beside_its_field(builder: Builder) -> None:
    builder.at(-0.6, 0)
    builder.fill("right", "bodies", "left")

    assert "taken" in builder.page._refused["bodies", "left"]
    assert "left" in builder.document["bodies"]


@pytest.fixture
def checked(builder: Builder) -> Builder:
    """A person with a disc and a check of it, whose fields are open."""
    builder.new()
    builder.tool("disc")
    builder.drag((0, 3), (1, 3))
    builder.key(pygame.K_ESCAPE)
    builder.act("Add a check")
    builder.person.wait(0.1)
    headings = builder.page.inspector._headings
    for path in (("checks",), ("checks", 0)):
        builder.person.wait(0.1)
        headings = builder.page.inspector._headings
        button = next(button for button, place in headings.items() if place == path)
        builder.reach(button)
        builder.click(button.rect)
    builder.person.wait(0.1)
    return builder


def test_a_quantity_is_completed_while_it_is_typed_and_tab_takes_the_first(
    checked: Builder,
) -> None:
    typed(checked, "veloc", "checks", 0, "quantity")
    assert checked.page._offered["checks", 0, "quantity"][0].startswith("disc1.velocity")
    checked.key(pygame.K_TAB, "\t")
    field = checked.page.inspector.field("checks", 0, "quantity")
    name = field.get_text()
    assert (name.startswith("disc1.velocity"), field.is_focused) == (True, True)
    checked.key(pygame.K_RETURN, "\r")

    assert checked.document["checks"][0]["quantity"] == name


def test_a_click_takes_a_name_that_is_offered(checked: Builder) -> None:
    typed(checked, "energy", "checks", 0, "quantity")
    checked.person.wait(0.1)
    line = checked.page.inspector._lines["checks", 0, "quantity"]
    button, name = list(line.choices.items())[1]
    checked.reach(button)
    checked.click(button.rect)

    assert checked.document["checks"][0]["quantity"] == name


def test_a_check_is_taken_out(checked: Builder) -> None:
    checked.act("− disc1.position.x")

    assert "checks" not in checked.document


def test_a_ghost_flies_as_a_free_body_does_and_is_taken_out(builder: Builder) -> None:
    builder.new()
    builder.tool("disc")
    builder.drag((0, 3), (1, 3))
    builder.fill("2", "bodies", "disc1", "velocity", 0)
    builder.act("Add a ghost")
    x, y = parse(builder.editor.work.draft.text).ghosts["disc1"]
    assert (x({"t": 0.5}), y({"t": 0.5})) == pytest.approx((1, 3 - 9.81 / 8))
    builder.key(pygame.K_ESCAPE)
    builder.key(pygame.K_ESCAPE)
    builder.act("− ghost of disc1")

    assert "ghosts" not in builder.document


def test_what_is_not_saved_is_offered_beside_the_next_new_scene(builder: Builder) -> None:
    for x in (0, 3):
        builder.new()
        builder.tool("disc")
        builder.drag((x, 3), (x + 1, 3))
    second = builder.editor.work.draft
    builder.key(pygame.K_ESCAPE)
    builder.act("Untitled, with disc1")
    builder.person.wait(0.1)
    assert builder.document["bodies"]["disc1"]["position"] == [0, 3]
    builder.act("Untitled, with disc1")
    builder.person.wait(0.1)

    assert builder.editor.work.draft is second
    builder.person.window.open_level("newton/incline")
    builder.key(pygame.K_b, "b")
    builder.person.wait(0.1)
    assert len([act for _, act in builder.page._acts if act.caption == "Untitled, with disc1"]) == 2
