"""A drawn level is made a challenge with the mouse."""

import pygame
import pytest
from pygame_gui import UI_BUTTON_PRESSED

from sandbox.model.loading import parse
from sandbox.physics.measuring.challenge_goals import attempt
from sandbox.physics.run import simulate
from tests.app.building.builder import Builder


def draw_a_bucket(builder: Builder) -> None:
    builder.tool("surface")
    for point in ((5, 1.5), (5, 0), (7, 0), (7, 1.5)):
        builder.at(*point)
    builder.key(pygame.K_RETURN, "\r")


@pytest.mark.sweep
def test_a_throw_into_a_bucket_becomes_a_challenge_with_few_clicks(builder: Builder) -> None:
    builder.new()
    builder.clicks = 0
    draw_a_bucket(builder)
    builder.tool("disc")
    builder.drag((-6, 1), (-5.75, 1))
    builder.fill("5", "bodies", "disc1", "velocity", 0)
    builder.fill("8", "bodies", "disc1", "velocity", 1)
    for axis in (0, 1):
        button = builder.page.inspector.parametrise_button("bodies", "disc1", "velocity", axis)
        builder.reach(button)
        builder.click(button.rect)
        builder.person.wait(0.1)
    builder.key(pygame.K_ESCAPE)
    builder.key(pygame.K_ESCAPE)
    builder.act("Add a challenge")

    assert builder.clicks <= 14
    challenge = builder.document["challenge"]
    assert challenge["free"] == list(builder.document["parameters"])
    assert [goal["quantity"] for goal in challenge["goals"]] == [
        "disc1.position.x",
        "disc1.position.y",
    ]
    assert challenge["goals"][0]["above"] == 5
    assert challenge["goals"][1]["below"] == 1.5
    level = parse(builder.editor.work.draft.text)
    across, _ = level.parameters
    stars = [
        found.stars
        for speed in (5, 7.3)
        if (found := attempt(simulate(level, {**level.defaults, across: speed})))
    ]
    assert stars == [0, 1]

    builder.act("− challenge")
    assert "challenge" not in builder.document


def test_a_challenge_needs_something_to_change(builder: Builder) -> None:
    builder.new()
    builder.tool("disc")
    builder.drag((0, 1), (1, 1))
    builder.key(pygame.K_ESCAPE)
    builder.key(pygame.K_ESCAPE)
    builder.act("Add a challenge")
    builder.person.wait(0.1)

    assert "challenge" not in builder.document
    assert "make a number a parameter" in str(builder.person.window.banner._note)


def test_a_button_acts_on_the_level_as_a_key_before_it_left_that(builder: Builder) -> None:
    """The key and the click come before the page is drawn again."""
    button = builder.page.button("Add a challenge")
    builder.editor.work.select([("bodies", "left")])
    pygame.event.post(pygame.Event(pygame.KEYDOWN, key=pygame.K_DELETE, unicode="", mod=0))
    pygame.event.post(pygame.Event(UI_BUTTON_PRESSED, ui_element=button))
    builder.person.wait(0.1)

    assert list(builder.document["bodies"]) == ["right"]
    (goal,) = builder.document["challenge"]["goals"]
    assert goal["quantity"] == "right.position.x"


def test_of_two_buttons_of_one_caption_the_pressed_one_acts(builder: Builder) -> None:
    for _ in range(2):
        builder.act("Add a check")
        builder.person.wait(0.1)
    last = len(builder.document["checks"]) - 1
    for path in (("checks",), ("checks", last)):
        builder.open(*path)
    builder.fill("1", "checks", last, "formula")
    checks = builder.document["checks"]
    alike = [button for button, act in builder.page._acts if act.caption == "− left.position.x"]
    assert len(alike) == 2
    builder.reach(alike[1])
    builder.click(alike[1].rect)
    builder.person.wait(0.1)

    assert builder.document["checks"] == checks[:-1]
