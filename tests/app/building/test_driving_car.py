"""A newcomer draws a car that drives: two wheels on pins, and a motor on one of the pins."""

import pytest

from sandbox.app.words.language import say
from sandbox.model.loading import parse
from sandbox.physics.run import simulate
from tests.app.building.builder import Builder

FRONT, REAR = (1, 0.5), (-1, 0.5)


def draw(builder: Builder) -> None:
    """Draw a frame over two wheels, each on a pin."""
    builder.new()
    builder.tool("box")
    builder.drag((-2, 0.5), (2, 1.5))
    builder.tool("disc")
    builder.drag(REAR, (-0.5, 0.5))
    builder.drag(FRONT, (1.5, 0.5))
    builder.tool("join")
    builder.tool("pivot")
    builder.at(*REAR)
    builder.at(*FRONT)


def faults(builder: Builder) -> bool:
    """Whether faults of what a click here would make are foreseen."""
    found = builder.editor._on_stage._foreseeing.found
    return found is not None and bool(found.faults)


@pytest.mark.sweep
def test_a_car_with_pins_and_a_motor_drives_once_there_is_friction(builder: Builder) -> None:
    draw(builder)
    builder.tool("motor")
    builder.at(*REAR)  # where a pin is already: the motor replaces it
    assert not builder.editor.applying.refusal
    assert builder.person.window.banner.is_showing(
        say("Without the effect 'friction', a wheel that it drives slips")
    )
    builder.act("Select nothing")
    builder.act("friction")

    level = parse(builder.editor.work.draft.text)
    x = simulate(level, duration=2.0, record=["box1.position.x"]).columns["box1.position.x"]

    assert sorted(joint.type for joint in level.joints.values()) == ["motor", "pivot"]
    assert 0.5 < x[-1] - x[0] < 1.01  # 0.5 m times 1 rad/s times 2 s, were there no start
    assert builder.clicks < 20


def test_nothing_is_marked_on_top_of_what_was_just_joined_or_off_the_stage(
    builder: Builder,
) -> None:
    draw(builder)
    person = builder.person
    person.wait(0.5)
    assert not faults(builder)  # another pin there would be redundant

    person.move(person.on_screen((FRONT[0] + 0.1, FRONT[1])))
    person.wait(0.5)
    assert faults(builder)

    person.move(person.window.panels.layout.side.center)
    person.wait(0.5)
    assert not faults(builder)

    builder.tool("motor")
    person.move(person.on_screen((-4, 5)))  # nothing is there to be driven
    person.wait(0.5)
    assert not faults(builder)
