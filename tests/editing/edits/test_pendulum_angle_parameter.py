"""The angle of a pendulum becomes one parameter, and its rod keeps its length."""

import pytest

from sandbox.editing.draft import Draft
from sandbox.editing.edits.bodies import add_disc
from sandbox.editing.edits.field_values import make_parameter
from sandbox.editing.edits.joint_creation import Pick, add_joint
from sandbox.editing.edits.pendulum_angle_parameter import peg_of, swing
from sandbox.editing.suggested_checks import suggestions, with_suggestion
from sandbox.editing.text_patches import put, value_at
from sandbox.model.errors import SandboxError
from sandbox.model.joint_ends_at_start import span
from sandbox.model.loading import parse
from sandbox.physics.measuring.grading import grade
from sandbox.physics.run import simulate
from tests.editing.suggested_checks.set_ups import cradle, pendulum

EMPTY = Draft.empty().text


@pytest.mark.parametrize("kind", ["rod", "rope"])
@pytest.mark.parametrize("x", [0, -1, 1.2])
def test_what_it_hangs_on_is_as_long_at_every_angle(kind: str, x: float) -> None:
    text = pendulum(kind, x, 5)
    before = span(parse(text).joints[f"{kind}1"], parse(text).bodies, {})
    level = parse(swing(text, parse(text), "disc1"))
    for angle in (5, 20, 60):
        values = {"angle": float(angle)}
        length = span(level.joints[f"{kind}1"], level.bodies, values)
        assert length == pytest.approx(before, rel=1e-11)
    if x:
        was = parse(text).bodies["disc1"].position[0]({})
        assert level.bodies["disc1"].position[0](level.defaults) == pytest.approx(was)


def test_what_hangs_straight_is_drawn_to_where_nothing_is() -> None:
    left, right = (
        swing(text, parse(text), name)
        for text, name in ((cradle(3, 1, angle=0), "disc1"), (cradle(3, 1, angle=0), "disc3"))
    )
    assert value_at(left, ("bodies", "disc1", "position", 0)) == "1 - 3*sin(angle*deg)"
    assert value_at(right, ("bodies", "disc3", "position", 0)) == "3 + 3*sin(angle*deg)"


@pytest.mark.sweep
@pytest.mark.parametrize("text", [pendulum("rod", 0, 5), cradle(3, 1, angle=0)])
def test_its_checks_hold_at_every_angle(text: str) -> None:
    text = swing(text, parse(text), "disc1")
    (one,) = suggestions(parse(text))
    level = parse(with_suggestion(text, parse(text), one))
    assert len(level.checks) == 3
    for angle in (5, 25, 60):
        run = simulate(level, {**level.defaults, "angle": angle})
        assert {result.verdict for result in grade(run)} == {"passed"}


def test_only_what_hangs_from_a_peg_by_a_length_that_is_not_given_can_swing() -> None:
    text = add_disc(EMPTY, parse(EMPTY), (0, 3), (1, 3)).text
    assert peg_of(parse(text), "disc1") is None
    with pytest.raises(SandboxError, match="does not hang"):
        swing(text, parse(text), "disc1")
    tied = add_joint(text, parse(text), "rod", [Pick((0, 3), "disc1"), Pick((0, 6))]).text
    assert peg_of(parse(tied), "disc1") == 6j
    assert peg_of(parse(put(tied, ("joints", "rod1", "length"), 3)), "disc1") is None
    named = make_parameter(tied, ("bodies", "disc1", "position", 1), "y")
    assert peg_of(parse(named), "disc1") is None
