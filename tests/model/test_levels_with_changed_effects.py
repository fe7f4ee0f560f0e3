"""Effects are switched off and on: what changes with them, and what makes no sense."""

from typing import Any

import pytest

from sandbox.model import level_catalog
from sandbox.model.effects import Effects
from sandbox.model.levels_with_changed_effects import (
    DEFAULTS,
    TOLD,
    EffectError,
    including,
    without,
)
from sandbox.model.rules.consistency import inconsistencies
from tests.sample import sampled
from validation.case import textbook


@pytest.mark.parametrize("name", sampled(level_catalog.names(), "switch off"))
def test_every_effect_of_every_level_can_be_switched_off(name: str) -> None:
    level = textbook(name)
    for effect in level.effects.declared:
        less, gone = without(level, effect)

        assert set(less.effects.declared) == {*level.effects.declared} - {effect, *gone}
        assert not [fault for fault in inconsistencies(less) if fault.path[0] not in TOLD]


def test_what_needs_contact_goes_with_it() -> None:
    level = textbook("rotation/rolling")
    less, gone = without(level, "contact")

    assert gone == ("friction", "rotation")
    assert less.effects.declared == ("gravity",)
    assert all(body.friction is None for body in less.bodies.values())
    assert "contact" in level.effects.declared  # the level itself has not changed


def test_what_is_alone_leaves_the_rest_as_it_is() -> None:
    level = textbook("newton/projectile-with-drag")
    less, gone = without(level, "drag")

    assert gone == ()
    assert less.bodies == level.bodies
    assert less == level.model_copy(
        update={"effects": level.effects.model_copy(update={"drag": None})}
    )


def test_an_effect_switched_off_and_on_again_is_the_level_that_was() -> None:
    level = textbook("newton/projectile-with-drag")
    less, _ = without(level, "drag")

    assert including(less, "drag", {"linear": "c"}) == level


@pytest.mark.parametrize(
    ("effect", "message"),
    [
        ("contact", "the level declares no effect 'contact'; known: drag, gravity"),
        ("darg", "the level declares no effect 'darg'; did you mean 'drag'"),
    ],
)
def test_what_is_not_there_cannot_be_switched_off(effect: str, message: str) -> None:
    with pytest.raises(EffectError, match=message):
        without(textbook("newton/projectile-with-drag"), effect)


@pytest.mark.parametrize("effect", DEFAULTS)
def test_every_default_is_an_effect(effect: str) -> None:
    level = textbook("rotation/rolling")
    if effect in level.effects.declared:
        level, _ = without(level, effect)
    if effect in ("friction", "restitution", "rotation") and not level.effects.contact:
        level = including(level, "contact", {})

    assert effect in including(level, effect, {}).effects.declared


def test_a_setting_changes_what_is_declared_and_leaves_the_other_settings() -> None:
    level = including(textbook("newton/projectile-with-drag"), "drag", {"quadratic": 0.5})

    drag = level.effects.drag
    assert drag
    assert (drag.linear.source, drag.quadratic.source) == ("c", 0.5)


def test_the_coefficient_of_every_pair_is_what_was_asked_for() -> None:
    level = including(textbook("newton/incline"), "friction", {"coefficient": 0.3})
    one, other = (body.friction for body in level.bodies.values())

    assert one
    assert other
    assert one({}) * other({}) == pytest.approx(0.3, rel=1e-15)


def test_a_list_takes_its_settings_for_each_entry() -> None:
    level = including(textbook("energy/circular-orbit"), "attraction", {"center": [1, 2]})

    attraction = level.effects.attraction
    assert attraction
    assert [part.source for part in attraction[0].center] == [1, 2]
    assert attraction[0].mu.source == "mu"


@pytest.mark.parametrize(
    ("effect", "settings", "message"),
    [
        ("frictoin", {}, "unknown effect 'frictoin'; did you mean 'friction'?"),
        ("gravity", {}, "already declares 'gravity'; .* gravity.acceleration="),
        ("gravity", {"acceleration": [0]}, "gravity.acceleration: is a list with too few entries"),
        ("drag", {"linaer": 1}, "unknown key 'linaer'; did you mean 'linear'?"),
        ("drag", {"linear": -1}, "drag.linear: is -1, but must be at least 0"),
        ("drag", {"linear": "k"}, "effects.drag.linear: unknown parameter 'k'"),
        ("drag", {"linear": 0}, "needs 'linear' or 'quadratic' greater than 0"),
        ("drag", {"linear": 1, "bodies": ["moon"]}, "unknown body 'moon'"),
        ("drag", {"linear": 1, "bodies": ["ground"]}, "'ground' is static, so no force moves it"),
        ("drag", {"coefficient": 1}, "unknown key 'coefficient'"),
        ("force", {}, "'force' needs a setting: force.body="),
        ("friction", {}, "'friction' needs the effect 'contact'"),
        ("restitution", {"coefficient": 2}, "restitution.coefficient: is 2, but must be"),
        ("friction", {"coefficient": [1]}, "must be a number or an expression"),
    ],
)
def test_what_makes_no_sense_is_refused_by_name(
    effect: str, settings: dict[str, Any], message: str
) -> None:
    with pytest.raises(EffectError, match=message):
        including(textbook("kinematics/projectile"), effect, settings)


def test_the_defaults_are_effects_that_there_are() -> None:
    assert set(DEFAULTS) <= set(Effects.model_fields)


def test_a_setting_of_another_effect_is_told_so() -> None:
    with pytest.raises(EffectError, match="unknown key 'mu'; it is a setting of 'attraction'"):
        including(textbook("kinematics/projectile"), "drag", {"mu": 1})
