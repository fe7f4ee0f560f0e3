"""The JSON Schema agrees with the models, and editors have the latest one."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from sandbox.model import level_catalog
from sandbox.model.effects import Effects
from sandbox.model.level import Level
from sandbox.model.loading import read
from sandbox.model.schema_examples import UNUSED, add_examples, fields
from sandbox.model.shorthand.json_schema import TEMPLATE
from sandbox.model.write_json_schema import main, schema, text, write

SCHEMA = schema()


def _parts(part: object) -> Iterator[dict[str, Any]]:
    """Yield every object below a part of the schema."""
    if isinstance(part, dict):
        yield part
        part = list(part.values())
    for child in part if isinstance(part, list) else ():
        yield from _parts(child)


def test_the_file_is_what_the_models_say() -> None:
    written = (level_catalog.root() / "level.schema.json").read_text(encoding="utf-8")
    assert written == text(), "run 'make docs'"


def test_every_field_that_names_no_values_itself_has_examples() -> None:
    """Editors offer them during typing."""
    made = json.loads(text())
    bare = [f"{part}.{key}" for part, key, field in fields(made) if "examples" not in field]

    assert not bare, f"use each in a level, or add it to sandbox/model/schema_examples.py: {bare}"
    assert made["$defs"]["Spring"]["properties"]["stiffness"]["examples"] == ["k", 50]


def test_every_field_but_those_that_name_a_kind_is_described() -> None:
    parts = {"Level": SCHEMA, **SCHEMA["$defs"]}
    assert not [
        f"{part}.{key}"
        for part, node in parts.items()
        for key, field in node.get("properties", {}).items()
        if not field.keys() & {"description", "const", "$ref"}  # a reference is described there
    ]


def test_only_what_levels_do_not_have_gets_examples_of_its_own() -> None:
    made = schema()
    add_examples(
        made, (json.loads(read(level_catalog.find(name))) for name in level_catalog.names())
    )
    given = {f"{part}.{key}": field.get("examples") for part, key, field in fields(made)}

    assert {name: given.get(name) for name in UNUSED} == {name: [it] for name, it in UNUSED.items()}


def test_it_is_written_whole(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(level_catalog, "root", lambda: tmp_path)

    assert write().read_text(encoding="utf-8") == text()
    assert [path.name for path in tmp_path.iterdir()] == ["level.schema.json"]


def test_an_installed_package_keeps_its_schema(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "sandbox" / "levels" / "level.schema.json"
    file.parent.mkdir(parents=True)
    file.write_text("as it was installed")
    monkeypatch.setattr(
        level_catalog, "__file__", str(tmp_path / "sandbox" / "model" / "catalog.py")
    )

    assert main() == 2
    assert "is written in a checkout of the project" in capsys.readouterr().err
    assert file.read_text() == "as it was installed"


def test_every_reference_leads_to_a_definition() -> None:
    leads = {part["$ref"] for part in _parts(SCHEMA) if "$ref" in part}

    assert leads == {f"#/$defs/{name}" for name in SCHEMA["$defs"]}


@pytest.mark.parametrize("name", sorted(SCHEMA["$defs"]))
def test_every_part_is_described_and_refuses_unknown_keys(name: str) -> None:
    part = SCHEMA["$defs"][name]

    assert part["description"]
    assert part["additionalProperties"] is False


def test_no_part_refuses_every_key() -> None:
    """An editor would mark everything typed there."""
    closed = [part for part in _parts(SCHEMA) if part.get("additionalProperties") is False]

    assert [part for part in closed if not {"properties", "patternProperties"} & part.keys()] == []


@pytest.mark.parametrize("name", sorted(Level.model_fields.keys() - {"schema_"}))
def test_every_field_of_a_level_is_described(name: str) -> None:
    assert SCHEMA["properties"][name]["description"]


@pytest.mark.parametrize("name", Effects.model_fields)
def test_every_effect_is_described(name: str) -> None:
    assert SCHEMA["$defs"]["Effects"]["properties"][name]["description"]


def test_a_description_keeps_the_unit_and_says_the_rule() -> None:
    mass = SCHEMA["$defs"]["Body"]["properties"]["mass"]

    assert mass["description"].startswith("kg")
    assert "greater than 0" in mass["description"]
    assert mass["type"] == ["number", "string"]
    assert mass["exclusiveMinimum"] == 0


@pytest.mark.parametrize("tag", ["disc", "hoop", "box", "polygon", "segment", "polyline"])
def test_a_shape_is_chosen_by_its_tag(tag: str) -> None:
    lead = SCHEMA["$defs"]["Body"]["properties"]["shape"]["discriminator"]["mapping"][tag]

    assert SCHEMA["$defs"][lead.rpartition("/")[2]]["properties"]["type"]["const"] == tag


@pytest.mark.parametrize("kind", ["parameters", "bodies", "joints", "ghosts"])
def test_names_have_the_form_that_the_loader_asks_for(kind: str) -> None:
    part = SCHEMA["properties"][kind]

    assert list(part["patternProperties"]) == ["^[A-Za-z][A-Za-z0-9_]{0,30}$|" + TEMPLATE]
    assert part["additionalProperties"] is False


def test_an_author_is_never_offered_a_null() -> None:
    assert not [part for part in _parts(SCHEMA) if part.get("type") == "null"]
    assert not [part for part in _parts(SCHEMA) if part.get("default", 0) is None]
