"""A rope made of knots, over a drum."""

from math import exp, pi

import pytest

from sandbox.editing.draft import Draft
from sandbox.editing.edits.bodies import add_box, add_disc
from sandbox.editing.edits.effects import declare
from sandbox.editing.edits.rope_wrapping import wrap
from sandbox.editing.text_patches import put_all
from sandbox.model.errors import SandboxError
from sandbox.model.loading import parse
from sandbox.physics.run import build

THREE = ["disc1", "box1", "box2"]
EMPTY = Draft.empty().text


def drum(heavy: float, friction: float | None = None, across: float = 1.04) -> str:
    """Return a disc, and weights of 5 kg and of a given mass below its left and right edges."""
    text = add_disc(EMPTY, parse(EMPTY), (0, 4), (1, 4)).text
    for x in (-across, across):
        text = add_box(text, parse(text), (x - 0.3, 1), (x + 0.3, 1.6)).text
    text = put_all(text, {("bodies", "box1", "mass"): 5, ("bodies", "box2", "mass"): heavy})
    if friction is None:
        return text
    text = declare(text, parse(text), "friction")
    return put_all(text, {("bodies", "disc1", "friction"): friction})


@pytest.mark.parametrize(("heavy", "friction"), [(10, None), (10, 0.25), (15, 0.25)])
def test_a_rope_over_a_drum_pulls_as_the_capstan_equation_says(
    heavy: float, friction: float | None
) -> None:
    """Each knot has a thousandth of the mass; that is the difference."""
    level = parse(wrap(text := drum(heavy, friction), parse(text), THREE).text)
    world, ratio = build(level), exp((friction or 0) * pi)
    index = list(level.bodies).index("box2")
    for _ in range(72):
        world.advance()
    a = 9.81 * max(heavy - 5 * ratio, 0) / (heavy + 5 * ratio)
    fallen = 1.3 - world.snapshot.position[index, 1]
    assert fallen == pytest.approx(a * world.snapshot.t**2 / 2, rel=0.03, abs=1e-9)


def test_the_drum_stands_still_and_the_rope_reaches_from_weight_to_weight() -> None:
    text = drum(10, across=1.6)
    made = wrap(text, parse(text), THREE)
    level = parse(made.text)
    assert level.bodies["disc1"].type == "static"
    assert len(level.joints) == len(made.names) + 1
    build(level)


def test_what_lies_within_the_drum_is_refused() -> None:
    text = drum(10, across=0.2)
    text = put_all(text, {("bodies", "box1", "position"): [0.1, 4]})
    with pytest.raises(SandboxError, match="lie within 'disc1'"):
        wrap(text, parse(text), THREE)


def test_a_rope_needs_a_disc_and_two_bodies_that_move() -> None:
    text = drum(10)
    with pytest.raises(SandboxError, match="select the three"):
        wrap(text, parse(text), ["disc1", "box1", "ground"])
