"""An unknown name is reported with its place, wherever a level may use a name."""

import json
import random
from collections.abc import Callable, Iterator
from copy import deepcopy
from typing import Any

import pytest

from sandbox.model import level_catalog
from sandbox.model.level import Level
from sandbox.model.loading import parse
from sandbox.model.rules.consistency.references_by_name import named_bodies
from sandbox.model.shorthand.expansion import write_out
from sandbox.model.write_json_schema import grammar
from tests.model.levels import Data, bare, hanging, mistakes, mistakes_in

SCHEMA = grammar()
Place = tuple[str | int, ...]
Sample = tuple[Place, Any]
"""Where in a part of a level something is named, and the part, as little of it as there can be."""

WRONG = "nobody"

Wanted = Callable[[dict[str, Any]], bool]


def _names(what: str) -> Wanted:
    return lambda part: part.get("names") == what


def _is_formula(part: dict[str, Any]) -> bool:
    """Whether a part of the schema may be a formula of the parameters."""
    return "string" in part.get("type", "") and "number" in part["type"]


def _wherever(part: dict[str, Any], wanted: Wanted) -> Iterator[Sample]:
    """Yield, for each required text in a part of the schema, the least value with a wrong name."""
    part = _resolved(part)
    if wanted(part):
        keyed = part["type"] == "object"
        yield ((WRONG,), {WRONG: _least(_values(part))}) if keyed else ((), WRONG)
    for choice in part.get("oneOf", ()):
        yield from _wherever(choice, wanted)
    for key, inside in part.get("properties", {}).items():
        for place, value in _wherever(inside, wanted):
            yield (key, *place), {**_least(part), key: value}
    for inside in part.get("patternProperties", {}).values():
        for place, value in _wherever(inside, wanted):
            yield ("thing", *place), {"thing": value}
    yield from _in_lists(part, wanted)


def _in_lists(part: dict[str, Any], wanted: Wanted) -> Iterator[Sample]:
    for index, inside in enumerate(part.get("prefixItems", ())):
        for place, value in _wherever(inside, wanted):
            made = [_least(item) for item in part["prefixItems"]]
            made[index] = value
            yield (index, *place), made
    for place, value in _wherever(part["items"], wanted) if "items" in part else ():
        rest = [_least(part["items"])] * (part.get("minItems", 1) - 1)
        yield (0, *place), [value, *rest]


def _resolved(part: dict[str, Any]) -> dict[str, Any]:
    if "$ref" not in part:
        return part
    definition: dict[str, Any] = SCHEMA["$defs"][part["$ref"].rpartition("/")[2]]
    return definition


def _values(part: dict[str, Any]) -> dict[str, Any]:
    (value,) = part["patternProperties"].values()
    assert isinstance(value, dict)
    return value


def _least(part: dict[str, Any]) -> Any:  # noqa: ANN401 (whatever JSON holds)
    """Return the least value that a part of the schema allows."""
    part = _resolved(part)
    if "const" in part:
        return part["const"]
    if "enum" in part:
        return part["enum"][0]
    if "oneOf" in part:
        return _least(part["oneOf"][0])
    if part["type"] == "object":
        return {key: _least(part["properties"][key]) for key in part.get("required", ())}
    if part["type"] == "array":
        items = part.get("prefixItems") or [part["items"]] * part.get("minItems", 0)
        return [_least(item) for item in items]
    return {"string": "ball"}.get(str(part["type"]), 1)


def _told(place: Place) -> str:
    return ".".join(map(str, place))


def _samples(wanted: Wanted) -> list[Any]:
    found = {_told(place): (place, value) for place, value in _wherever(SCHEMA, wanted)}
    return [pytest.param(*sample, id=told) for told, sample in found.items()]


BODIES, QUANTITIES = _samples(_names("body")), _samples(_names("quantity"))
FORMULAS, PARAMETERS = _samples(_is_formula), _samples(_names("parameter"))


def _with(place: Place, value: Data) -> Data:
    """Return a level in which a part is replaced."""
    part = str(place[0])
    return {**bare(), "ghosts": {}, "joints": {}, part: deepcopy(value[part])}


def test_the_schema_tells_that_effects_joints_checks_ghosts_and_the_view_name_bodies() -> None:
    places = {sample.id for sample in BODIES}

    assert {"effects.drag.bodies.0", "joints.thing.ends.0.body", "joints.thing.over.0"} < places
    assert {"ghosts.nobody", "checks.0.at.bodies.1", "view.landscape.body"} < places


@pytest.mark.parametrize(("place", "value"), BODIES)
@pytest.mark.parametrize("quantity", ["ball.speed", "system.energy", "system.work.joints"])
def test_an_unknown_body_is_told_wherever_one_is_named(
    place: Place, value: Data, quantity: str
) -> None:
    data = _with(place, value)
    if place[0] != "checks":
        data["checks"] = [{"quantity": quantity, "formula": 1, "tolerance": 1}]

    told = [mistake.rule for mistake in mistakes(data) if mistake.path == _told(place)]

    assert told == ["unknown body 'nobody'; known: ball"]


@pytest.mark.parametrize("name", ["nobody.tension", "ball.tension", "string.speed", "system.speed"])
@pytest.mark.parametrize(("place", "value"), QUANTITIES)
def test_an_unknown_joint_or_quantity_is_told_wherever_one_is_asked_for(
    place: Place, value: Data, name: str
) -> None:
    part = str(place[0])
    data = hanging() | {part: json.loads(json.dumps(value[part]).replace(WRONG, name))}

    told = [mistake.rule for mistake in mistakes(data) if mistake.path == _told(place)]

    assert len(told) == 1
    assert told[0].startswith(f"'{name}' is not a quantity of this level")


@pytest.mark.parametrize(("place", "value"), [*FORMULAS, *PARAMETERS])
def test_an_unknown_parameter_is_told_wherever_one_may_stand(place: Place, value: Data) -> None:
    found = mistakes(_with(place, value))

    told = [mistake.rule for mistake in found if mistake.path == _told(place)]
    assert told
    assert told[0].startswith("unknown parameter 'nobody'")
    assert not [mistake for mistake in found if "nothing can be computed" in mistake.rule]


@pytest.mark.parametrize("mass", ["mas", "1/(p - 1)", "-p"])
def test_a_mass_without_a_value_is_told_where_the_solver_depends_on_masses(mass: str) -> None:
    """Which solver contacts have by default depends on the ratio of two masses."""
    data = bare()
    data["bodies"]["other"] = {"shape": {"type": "disc", "radius": 1}, "mass": mass}
    data["parameters"] |= {"p": {"value": 1, "min": 0, "max": 2}}
    data["effects"] |= {"contact": {}}

    assert "bodies.other.mass" in [m.path for m in mistakes(data)]


def test_formulas_stand_in_bodies_effects_joints_and_checks() -> None:
    places = {sample.id for sample in FORMULAS}

    assert {"effects.drag.linear", "joints.thing.stiffness", "bodies.thing.mass"} < places
    assert {"effects.force.0.force.1", "checks.0.formula", "ghosts.thing.0", "duration"} < places


def test_a_misspelt_body_beside_a_check_of_the_energy_is_told() -> None:
    data = hanging()
    data["joints"] = {"rod": {"type": "rod", "ends": ["bal", "other"]}}
    data["checks"] = [{"quantity": "system.energy", "formula": 1, "tolerance": 1}]

    (found,) = [m for m in mistakes(data) if m.path.startswith("joints")]

    assert (found.path, found.rule) == (
        "joints.rod.ends.0",
        "unknown body 'bal'; did you mean 'ball'?",
    )


def test_what_only_follows_from_a_misspelt_body_is_not_told() -> None:
    """The pair leaves the floor without a coefficient, but that is not the mistake."""
    data = bare()
    data["bodies"]["floor"] = {"type": "static", "shape": {"type": "disc", "radius": 1}}
    pair = {"bodies": ["ball", "flor"], "coefficient": 1}
    data["effects"] |= {"contact": {}, "restitution": {"pairs": [pair]}}

    assert [m.path for m in mistakes(data)] == ["effects.restitution.pairs.0.bodies.1"]


def _mentioned(level: Level) -> list[Place]:
    return [path for path, _ in named_bodies(level) if path[0] != "ghosts"]


@pytest.mark.parametrize("name", level_catalog.names()[::9])
def test_a_letter_too_few_in_a_body_s_name_is_answered_at_its_place(name: str) -> None:
    typed = level_catalog.find(name).read_text(encoding="utf-8")
    text = json.dumps(write_out(json.loads(typed), typed).data)
    places = _mentioned(parse(text))
    for place in random.Random(name).sample(places, min(3, len(places))):
        data: Data = json.loads(text)
        part: Any = data
        for step in place[:-1]:
            part = part[step]
        right = part[place[-1]]
        part[place[-1]] = wrong = f"{right[:1]}{right[2:]}" if len(right) > 1 else f"{right}q"
        told = {m.path: m.rule for m in mistakes(data)}

        assert told[_told(place)].startswith(f"unknown body '{wrong}'")


@pytest.mark.parametrize("name", level_catalog.names()[4::9])
def test_a_letter_too_many_anywhere_in_a_level_is_answered_or_harmless(name: str) -> None:
    """In whatever text: the result is a level or its mistakes."""
    text = level_catalog.find(name).read_text(encoding="utf-8")
    letters = [index for index, letter in enumerate(text) if letter.isalpha()]
    for index in random.Random(name).sample(letters, 12):
        for mistake in mistakes_in(f"{text[:index]}q{text[index:]}"):
            assert mistake.rule
