"""Fields: typed text is kept as it is, or refused with the loader's message."""

import re

import pytest

from sandbox.editing.draft import Draft
from sandbox.editing.edits.bodies import add_box, add_disc
from sandbox.editing.edits.field_values import make_parameter, parameter_name, set_field
from sandbox.editing.text_patches import put, value_at
from sandbox.editing.written_out_shorthand import expanded
from sandbox.model import level_catalog
from sandbox.model.errors import LevelError, SandboxError
from sandbox.model.expressions import Expression
from sandbox.model.json_positions import Path
from sandbox.model.level_parts import expressions
from sandbox.model.loading import parse, read
from sandbox.model.rules.level_validation import corners

MASS: Path = ("bodies", "box1", "mass")


def scene() -> str:
    empty = Draft.empty().text
    return add_box(empty, parse(empty), (1, 1), (2, 1.5)).text


@pytest.mark.parametrize("typed", ["2.50", "1e-3", "3", "2*pi", "sqrt(2)"])
def test_what_is_typed_stays_to_the_character(typed: str) -> None:
    text = set_field(scene(), MASS, typed)
    assert f'"mass": {typed}' in text or f'"mass": "{typed}"' in text
    assert parse(text).bodies["box1"].mass is not None


def test_numbers_that_json_does_not_know_are_numbers_all_the_same() -> None:
    assert '"mass": 0.5' in set_field(scene(), MASS, ".5")
    assert '"mass": 2' in set_field(scene(), MASS, "+2.")


def test_a_field_that_takes_words_takes_a_number_as_one() -> None:
    assert value_at(set_field(scene(), ("title",), "7"), ("title",)) == "7"


def test_fields_are_made_and_left_out() -> None:
    text = set_field(scene(), ("effects", "contact", "piles"), "true")
    assert value_at(text, ("effects", "contact")) == {"piles": True}
    assert set_field(text, ("effects", "contact", "piles"), " ") == scene()
    told = set_field(scene(), ("summary",), "A box.")
    assert value_at(told, ("summary",)) == "A box."
    assert set_field(told, ("summary",), "") == scene()
    assert set_field(scene(), ("reference",), "") == scene()
    assert '"velocity": [1, 2]' in set_field(scene(), ("bodies", "box1", "velocity"), "[1, 2]")


@pytest.mark.parametrize(
    ("path", "typed", "told"),
    [
        (MASS, "-1", "greater than 0"),
        (MASS, "2m", "a product is written 2*m"),
        (MASS, "x", "unknown parameter 'x'"),
        (MASS, "", "a dynamic body needs a mass"),
        (("bodies", "box1", "color"), "red", "color"),
        (("bodies", "box1", "friction"), "-0.5", "at least 0"),
        (("duration",), "1e99", "at most"),
        (("stepping", "rate"), "fast", "number"),
    ],
)
def test_nonsense_is_refused_in_the_loaders_own_words(path: Path, typed: str, told: str) -> None:
    with pytest.raises(LevelError, match=re.escape(told)):
        set_field(scene(), path, typed)


def test_a_mistake_elsewhere_keeps_no_field_from_being_mended() -> None:
    broken = put(put(scene(), MASS, -1), ("duration",), -1)
    mended = set_field(broken, MASS, "1")
    assert value_at(mended, MASS) == 1
    with pytest.raises(LevelError, match="mass"):
        set_field(mended, MASS, "-2")


def test_a_number_becomes_a_parameter_of_the_same_value() -> None:
    text = make_parameter(scene(), MASS, "m")
    level = parse(text)
    assert value_at(text, MASS) == "m"
    assert level.parameters["m"].value == 5
    assert (level.parameters["m"].min, level.parameters["m"].max) == (1, 25)
    assert (level.parameters["m"].unit, level.parameters["m"].label) == ("kg", "mass of box1")


def test_gravity_becomes_the_opposite_of_a_parameter() -> None:
    path: Path = ("effects", "gravity", "acceleration", 1)
    text = make_parameter(scene(), path, "g")
    assert value_at(text, path) == "-g"
    assert parse(text).parameters["g"].value == 9.81
    assert parse(text).parameters["g"].unit == "m/s²"


def test_an_angle_stays_in_degrees_and_a_share_between_0_and_1() -> None:
    text = set_field(scene(), ("bodies", "box1", "angle"), "30*deg")
    level = parse(make_parameter(text, ("bodies", "box1", "angle"), "angle"))
    assert (level.parameters["angle"].value, level.parameters["angle"].max) == (30, 90)
    stiff = put(scene(), ("effects", "contact", "correction"), 0.3)
    share = parse(make_parameter(stiff, ("effects", "contact", "correction"), "share"))
    assert (share.parameters["share"].min, share.parameters["share"].max) == (0, 1)


def test_what_is_a_formula_already_or_none_at_all_is_no_parameter() -> None:
    text = make_parameter(scene(), MASS, "m")
    with pytest.raises(SandboxError, match="already a formula"):
        make_parameter(text, MASS, "m2")
    with pytest.raises(SandboxError, match="cannot be a formula"):
        make_parameter(text, ("title",), "m2")
    with pytest.raises(SandboxError, match="already a parameter"):
        make_parameter(text, ("duration",), "m")
    with pytest.raises(SandboxError, match="meaning in formulas"):
        make_parameter(text, ("duration",), "t")


@pytest.mark.parametrize("name", level_catalog.textbook()[::6])
def test_numbers_of_the_scene_become_parameters_that_hold_over_their_range(name: str) -> None:
    text = expanded(read(level_catalog.find(name)))
    level = parse(text)
    numbers = [p for p, e in expressions(level) if p[0] == "bodies" and _is_number(text, p, e)]
    for path in numbers[::4][:3]:
        new = make_parameter(text, path, "fresh")
        assert list(corners(parse(new), {"fresh"}))
        assert parse(new).parameters["fresh"].value == abs(dict(expressions(level))[path]({}))


def _is_number(text: str, path: Path, expression: Expression) -> bool:
    try:
        return not isinstance(value_at(text, path), str) and not expression.names
    except SandboxError:
        return False


def test_a_parameter_is_named_after_its_field() -> None:
    level = parse(make_parameter(scene(), MASS, "mass"))
    assert parameter_name(level, ("bodies", "box1", "shape", "width")) == "width"
    assert parameter_name(level, MASS) == "box1_mass"


@pytest.mark.parametrize(
    ("field", "effect"),
    [("friction", "friction"), ("static_friction", "friction"), ("restitution", "restitution"),
     ("moment", "rotation"), ("angular_velocity", "rotation")],
)  # fmt: skip
def test_what_only_an_effect_gives_a_meaning_declares_it(field: str, effect: str) -> None:
    text = set_field(scene(), ("bodies", "box1", field), "0.7")
    assert effect in parse(text).effects.declared
    assert value_at(text, ("bodies", "box1", field)) == 0.7


def test_a_list_is_typed_with_commas() -> None:
    text = set_field(scene(), ("effects", "contact", "apart"), '[["box1", "ground"]]')
    text = set_field(text, ("effects", "contact", "located"), "box1")
    assert value_at(text, ("effects", "contact", "located")) == ["box1"]


def test_a_number_that_is_left_out_becomes_a_parameter() -> None:
    text = make_parameter(scene(), ("bodies", "box1", "velocity", 1), "v")
    assert value_at(text, ("bodies", "box1", "velocity")) == [0, "v"]
    text = make_parameter(text, ("bodies", "box1", "angle"), "turn")
    assert value_at(text, ("bodies", "box1", "angle")) == "turn*deg"
    text = make_parameter(text, ("bodies", "box1", "angular_velocity"), "spin")
    level = parse(text)
    assert set(level.parameters) == {"v", "turn", "spin"}
    assert "rotation" in level.effects.declared


def test_a_body_that_is_drawn_is_made_static_and_a_sensor_and_dynamic_again() -> None:
    text = make_parameter(scene(), MASS, "m")
    text = add_disc(text, parse(text), (0, 8), (0.5, 8)).text
    for kind in ("static", "kinematic"):
        still = set_field(text, ("bodies", "box1", "type"), kind)
        body = parse(still).bodies["box1"]
        assert (body.type, body.mass) == (kind, None)
        assert not parse(still).parameters
    assert parse(set_field(still, ("bodies", "box1", "sensor"), "true")).bodies["box1"].sensor
    again = parse(set_field(still, ("bodies", "box1", "type"), "dynamic"))
    box = parse(scene()).bodies["box1"]
    assert again.bodies["box1"].mass == box.mass
    assert again.effects == parse(scene()).effects
