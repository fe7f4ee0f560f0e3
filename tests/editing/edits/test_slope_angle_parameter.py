"""The angle of a slope becomes one parameter: slope and block turn together."""

from math import radians

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sandbox.editing.bodies_at_start import placed
from sandbox.editing.draft import Draft
from sandbox.editing.edits.bodies import add_box, add_surface
from sandbox.editing.edits.effects import declare
from sandbox.editing.edits.joint_creation import Pick, add_joint
from sandbox.editing.edits.moving_and_aligning import move, turn
from sandbox.editing.edits.slope_angle_parameter import slope_of, tilt
from sandbox.editing.snapping import flat_turn, snap_body
from sandbox.editing.suggested_checks import suggestions, with_suggestion
from sandbox.editing.text_patches import put, value_at
from sandbox.model.errors import SandboxError
from sandbox.model.joint_ends_at_start import end_position
from sandbox.model.joints import points
from sandbox.model.loading import parse
from sandbox.physics.geometry.outline_distance import gap
from sandbox.physics.measuring.grading import grade
from sandbox.physics.run import build, simulate
from tests.editing.suggested_checks.set_ups import incline

EMPTY = Draft.empty().text


def apart(text: str, angle: float) -> float:
    """Return the distance of the block from the slope at an angle of the slope [m]."""
    level = parse(put(text, ("parameters", "angle", "value"), angle))
    slope, block = (placed(level)[name] for name in ("surface1", "box1"))
    return min(gap(a, b, slope.radius).distance for a in block.cores for b in slope.cores)


@pytest.mark.parametrize("name", ["surface1", "box1"])
@pytest.mark.parametrize("degrees", [-30, 20])
def test_slope_and_block_turn_together(name: str, degrees: float) -> None:
    text = incline(radians(degrees))
    tilted = tilt(text, parse(text), name)

    assert value_at(tilted, ("parameters", "angle", "value")) == pytest.approx(abs(degrees))
    assert value_at(tilted, ("bodies", "surface1", "angle")) == (
        "angle*deg" if degrees > 0 else "-angle*deg"
    )
    assert value_at(tilted, ("bodies", "box1", "angle")) == value_at(
        tilted, ("bodies", "surface1", "angle")
    )
    for angle in (5, 17, 44.4, 60):
        assert abs(apart(tilted, angle)) < 1e-10
        build(parse(put(tilted, ("parameters", "angle", "value"), angle)))


@pytest.mark.sweep
@settings(max_examples=20, deadline=None)
@given(st.floats(-1.0, 1.0).filter(lambda angle: abs(angle) > 0.05))
def test_at_its_own_angle_everything_is_where_it_was(angle: float) -> None:
    text = incline(angle)
    before, after = placed(parse(text)), placed(parse(tilt(text, parse(text), "box1")))
    for name in ("surface1", "box1"):
        for a, b in zip(before[name].corners, after[name].corners, strict=True):
            assert abs(a - b) < 1e-10


@pytest.mark.sweep
@pytest.mark.parametrize("friction", [None, 0.1])
@pytest.mark.parametrize("degrees", [-30, 30])
def test_the_checks_that_are_suggested_hold_at_every_angle(
    degrees: float, friction: float | None
) -> None:
    text = incline(radians(degrees), friction)
    if friction is not None:
        text = put(text, ("bodies", "surface1", "friction"), 1)
    text = tilt(text, parse(text), "surface1")
    (one,) = suggestions(parse(text))
    assert one.setup == "block on a slope"
    text = with_suggestion(text, parse(text), one)
    for angle in (12, 30, 55):
        level = parse(put(text, ("parameters", "angle", "value"), angle))
        assert {result.verdict for result in grade(simulate(level))} == {"passed"}


def test_a_slope_that_is_touched_exactly_is_recognised() -> None:
    """Where the gap is exactly 0, the normal may point to either side of the line."""
    text = add_surface(EMPTY, parse(EMPTY), [(-4, 4), (4, 0)]).text
    text = add_box(text, parse(text), (-2, 4), (-1, 5)).text
    text = turn(text, parse(text), ["box1"], flat_turn(parse(text), "box1", 2))
    found = snap_body(parse(text), ["box1"], (0.0, 0.0), 2)
    text = move(text, parse(text), ["box1"], found.point)
    text = tilt(text, parse(text), "box1")

    assert apart(text, parse(text).defaults["angle"]) == 0
    assert [one.setup for one in suggestions(parse(text))] == ["block on a slope"]


def test_the_point_that_holds_a_block_on_its_slope_turns_along() -> None:
    text = incline(radians(30))
    where = placed(parse(text))["box1"]
    along = where.center - 2 * where.rotation
    pick = Pick((where.center.real, where.center.imag), "box1")
    text = add_joint(text, parse(text), "spring", [pick, Pick((along.real, along.imag))]).text
    text = tilt(text, parse(text), "box1")
    level = parse(put(text, ("parameters", "angle", "value"), 50))
    block = placed(level)["box1"]
    end = end_position(points(level.joints["spring1"])[1], level.bodies, level.defaults)

    assert abs((end - block.center) / block.rotation + 2) < 1e-9


def test_what_is_no_slope_or_is_placed_by_formulas_is_told() -> None:
    text = incline(radians(30))
    twice = tilt(text, parse(text), "box1")
    with pytest.raises(SandboxError, match="the position of 'surface1' is already a formula"):
        tilt(twice, parse(twice), "box1")
    assert slope_of(parse(text), "ground") == "ground"
    text = declare(text, parse(text), "rotation")
    assert slope_of(parse(text), "box1") == "surface1"
