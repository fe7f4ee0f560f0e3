"""What cannot run is marked on the stage while it is drawn, before the button is let go."""

from time import perf_counter, sleep

import pygame
import pytest

from sandbox.app.drawing import theme
from sandbox.editing.edits import joint_creation
from sandbox.editing.edits.joint_creation import Pick
from sandbox.model.shapes import XY
from tests.app.building.builder import Builder


def marked(builder: Builder, *point: float) -> bool:
    """Whether there is a mark in the colour of failures within 12 pixels of a point."""
    ahead = builder.editor._on_stage._foreseeing
    while perf_counter() < ahead._pause_ends:  # a look ahead takes a quarter of the time
        sleep(0.01)
    builder.person.wait(0.1)
    x, y = map(round, builder.person.on_screen((point[0], point[1])))
    place = pygame.Rect(x - 12, y - 12, 25, 25)
    around = builder.person.window.surface.subsurface(place)
    reds = pygame.mask.from_threshold(around, theme.FAILED, (12, 12, 12, 255))
    return bool(reds.count() > 10)


def hold(builder: Builder, start: XY, end: XY) -> None:
    """Drag from a point to another, and keep the button down."""
    person = builder.person
    person.drag(person.on_screen(start), person.on_screen(end), let_go=False)


def let_go(builder: Builder, end: XY) -> None:
    builder.person.button(False, builder.person.on_screen(end))


def two_boxes(builder: Builder) -> None:
    builder.new()
    builder.tool("box")
    builder.drag((-2, 1), (-1, 2))
    builder.drag((1, 1), (2, 2))


@pytest.mark.sweep
def test_a_box_that_is_dragged_into_another_is_marked_before_it_is_let_go(builder: Builder) -> None:
    two_boxes(builder)
    builder.tool("select")
    assert not marked(builder, -1, 1)
    hold(builder, (-1.5, 1.5), (0.9, 1.5))
    assert marked(builder, 0.4, 1)  # a corner of the one in hand, where it would be
    assert marked(builder, 2, 1)  # a corner of the other
    assert not marked(builder, -2, 1)
    assert builder.document["bodies"]["box1"]["position"] == [-1.5, 1.5]
    builder.person.move(builder.person.on_screen((-1.5, 2.5)))
    assert not marked(builder, 2, 1)
    let_go(builder, (-1.5, 2.5))
    assert not builder.editor.applying.refusal


def test_a_box_that_is_drawn_over_another_is_marked_while_it_is_stretched(builder: Builder) -> None:
    two_boxes(builder)
    hold(builder, (-0.5, 1), (0.5, 2))
    assert not marked(builder, 2, 1)
    builder.person.move(builder.person.on_screen((1.6, 1.7)))
    assert marked(builder, 2, 1)


def test_a_rod_that_repeats_another_is_marked_while_its_end_is_chosen(builder: Builder) -> None:
    two_boxes(builder)
    ends = Pick((-1.5, 1.5), "box1"), Pick((1.5, 1.5), "box2")
    builder.editor.work.add_parts(
        "tie", lambda text, level: joint_creation.add_joint(text, level, "rod", ends), "joints"
    )
    builder.tool("join")
    builder.tool("rod")
    builder.at(-1.5, 1.5)
    builder.person.move(builder.person.on_screen((1, 3)))
    assert not marked(builder, 0, 1.5)
    builder.person.move(builder.person.on_screen((1.5, 1.5)))
    assert marked(builder, 0, 1.5)
