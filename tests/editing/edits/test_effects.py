"""Effects: declared with what they need, and removed with what needs them."""

from typing import Any

import pytest

from sandbox.editing.draft import Draft
from sandbox.editing.edits.bodies import add_box
from sandbox.editing.edits.effects import COEFFICIENT, costs, declare, drop
from sandbox.editing.text_patches import value_at
from sandbox.model import level_catalog
from sandbox.model.errors import SandboxError
from sandbox.model.levels_with_changed_effects import DEFAULTS
from sandbox.model.loading import parse, read
from sandbox.physics.run import simulate

ATWOOD = read(level_catalog.find("newton/atwood"))
EMPTY = Draft.empty().text
SETTINGS: dict[str, dict[str, Any]] = {
    "attraction": {"mu": 1, "center": [0, 5]},
    "force": {"body": "left", "force": [1, "sin(t)"]},
}


TRIED = sorted({*DEFAULTS, *SETTINGS} - {"gravity"})


@pytest.mark.parametrize("effect", TRIED)
def test_an_effect_that_can_be_is_declared_and_dropped_again(effect: str) -> None:
    text = declare(ATWOOD, parse(ATWOOD), effect, SETTINGS.get(effect))
    level = parse(text)
    assert effect in level.effects.declared
    without = parse(drop(text, level, effect))
    assert effect not in without.effects.declared
    assert without.checks == parse(ATWOOD).checks


def test_friction_brings_contact_and_coefficients() -> None:
    text = declare(ATWOOD, parse(ATWOOD), "friction")
    assert parse(text).effects.contact is not None
    assert value_at(text, ("bodies", "left", "friction")) == COEFFICIENT
    less = parse(drop(text, parse(text), "contact"))
    assert less.effects.declared == ("gravity",)
    assert less.bodies["left"].friction is None


def test_another_force_is_added_to_the_first() -> None:
    once = declare(ATWOOD, parse(ATWOOD), "force", SETTINGS["force"])
    twice = declare(once, parse(once), "force", SETTINGS["force"])
    assert len(parse(twice).effects.force or ()) == 2


@pytest.mark.parametrize("effect", ["gravity", "gravty", "force"])
def test_what_cannot_be_declared_is_refused(effect: str) -> None:
    with pytest.raises(SandboxError, match=r"already|did you mean 'gravity'|told"):
        declare(ATWOOD, parse(ATWOOD), effect)


def test_what_is_not_declared_is_not_dropped() -> None:
    with pytest.raises(SandboxError, match="no effect 'drag'"):
        drop(ATWOOD, parse(ATWOOD), "drag")


def test_what_effects_cost_is_measured_for_those_that_can_be_switched() -> None:
    found = dict(costs(parse(ATWOOD)))
    assert {"gravity", "drag"} <= found.keys()
    assert all(abs(seconds) < 0.1 for seconds in found.values())
    assert found["drag"] > 0


def test_what_is_drawn_floats_in_the_liquid_that_a_click_declares() -> None:
    """A box of 2 m floats 1 m deep in a liquid of twice its density; the ground is below both."""
    deep = EMPTY.replace("[-10, 0]", "[-10, -5]").replace("[10, 0]", "[10, -5]")
    text = add_box(deep, parse(deep), (-1, -1), (1, 1)).text
    for effect in ("gravity", "buoyancy"):
        level = parse(text)
        text = text if effect in level.effects.declared else declare(text, level, effect)
    moved = simulate(parse(text), duration=2, record=["box1.position.y"]).columns["box1.position.y"]

    assert abs(moved).max() <= 1e-12
