"""Examples for the fields of the JSON Schema, taken from the levels that come with the project."""

import json
import re
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

Json = Any
"""Whatever JSON holds."""

MOST = 2
"""The largest number of examples of a field."""

LONGEST = 100
"""The largest number of characters of an example."""

UNFINISHED = re.compile(r'{[^"}]')
"""What a shorthand completes, in the text of a value."""

PLAIN: Mapping[str, tuple[type, ...]] = {
    "boolean": (bool,),
    "array": (list,),
    "string": (str,),
    "number": (int, float),
    "integer": (int,),
}
"""The types of values other than objects, by their names in a schema."""

UNUSED: Mapping[str, Json] = {
    "Level.parameters": {"g": {"value": 9.81, "min": 1, "max": 25, "unit": "m/s²"}},
    "Level.groups": {"cart": {"bodies": {"box": {"mass": 2}}}},
    "Level.challenge": {"task": "Land in the bucket.", "free": ["v"], "goals": [], "solution": {}},
    "Challenge.stars": [{"label": "gently", "quantity": "ball.speed", "at": 0, "below": 14}],
    "Group.bodies": {"wheel": {"shape": {"type": "disc", "radius": "r"}, "mass": 1}},
    "Group.joints": {"axle": {"type": "pivot", "ends": ["wheel", "box"]}},
    "Each.each": "ball{i}",
    "View.together": [["frame", "wheel"]],
    "Stepping.accuracy": 1e-6,
    "Event.off": ["drag"],
    "Event.reverse": ["gate"],
    "ContactEvent.nth": 2,
    "SeparationEvent.nth": 2,
    "Buoyancy.surface": 0.5,
    "Centrifugal.axis": 0.2,
    "Contact.correction": 0.1,
    "Contact.apart": [["arm", "wheel"]],
    "Gravitation.softening": 0.01,
    "Gravitation.bodies": ["sun", "planet"],
    "Restitution.pairs": [{"bodies": ["ball", "floor"], "coefficient": 0.8}],
    "RestitutionPair.coefficient": 0.8,
    "Torque.against": "frame",
    "Torsion.against": "frame",
    "Gear.carrier": "arm",
    "Pulley.length": 6,
    "Rope.length": "2*l",
}
"""Examples of the fields that none of those levels has, or only at length."""


def add_examples(schema: dict[str, Json], levels: Iterable[Json]) -> None:
    """Give each field of a schema the first short values that levels have there.

    Texts that a shorthand completes, such as `{i}*d`, are no values of their own. A field that no
    level has takes the examples of another one of the same name and form.
    """
    for level in levels:
        for field, value in _values(schema, schema, level):
            shown = json.dumps(value, ensure_ascii=False)
            examples = field.get("examples", [])
            if UNFINISHED.search(shown):
                continue
            if len(examples) < MOST and len(shown) <= LONGEST and value not in examples:
                field["examples"] = [*examples, value]
    shared = {_form(key, f): f["examples"] for _, key, f in fields(schema) if "examples" in f}
    for part, key, field in fields(schema):
        name = f"{part}.{key}"
        if examples := [UNUSED[name]] if name in UNUSED else shared.get(_form(key, field)):
            field.setdefault("examples", examples)


def fields(schema: Json) -> Iterator[tuple[str, str, Json]]:
    """Yield the part, the key and the description of each field that names no values itself."""
    for part, node in (("Level", schema), *schema["$defs"].items()):
        for key, field in node.get("properties", {}).items():
            if not _is_choice(field):
                yield part, key, field


def _form(key: str, field: Json) -> str:
    """Return what fields of one name and form have in common."""
    told = ("title", "description", "default", "examples")
    return json.dumps([key, {name: it for name, it in field.items() if name not in told}])


def _values(schema: Json, field: Json, value: Json) -> Iterator[tuple[Json, Json]]:
    """Yield the fields within a value, each with its own value."""
    node = _chosen(schema, field, value)
    if isinstance(value, dict):
        (pattern,) = node.get("patternProperties", {"": {}}).values()
        for key, inner in value.items():
            below = node.get("properties", {}).get(key, pattern)
            if below is not pattern and not _is_choice(below):
                yield below, inner
            yield from _values(schema, below, inner)
    elif isinstance(value, list):
        for index, inner in enumerate(value):
            places = node.get("prefixItems", [])
            below = places[index] if index < len(places) else node.get("items", {})
            yield from _values(schema, below, inner)


def _is_choice(field: Json) -> bool:
    """Return whether a field names its values itself."""
    return "const" in field or "enum" in field or field.get("type") == "boolean"


def _chosen(schema: Json, field: Json, value: Json) -> Json:
    """Return the part of a schema that describes a value: references and unions are resolved."""
    if reference := field.get("$ref"):
        return _chosen(schema, schema["$defs"][reference.rpartition("/")[2]], value)
    options = field.get("oneOf") or field.get("anyOf")
    if not options:
        return field
    found = (_chosen(schema, option, value) for option in options)
    return next((one for one in found if _fits(one, value)), {})


def _fits(node: Json, value: Json) -> bool:
    """Return whether a part of a schema describes a value, by its type and its keys."""
    if not isinstance(value, dict):
        types = node.get("type", ())
        return any(
            isinstance(value, PLAIN.get(one, ()))
            for one in ([types] if isinstance(types, str) else types)
        )
    known = node.get("properties", {})
    kinds = ((key, part["const"]) for key, part in known.items() if "const" in part)
    return (
        value.keys() <= known.keys()
        and value.keys() >= set(node.get("required", ()))
        and all(value.get(key) == kind for key, kind in kinds)
    )
