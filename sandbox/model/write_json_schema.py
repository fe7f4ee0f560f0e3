"""Makes the JSON Schema of the level format, for editors.

`python -m sandbox.model.write_json_schema` writes it to `levels/level.schema.json`.
"""

import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from pydantic.json_schema import GenerateJsonSchema, JsonSchemaValue
from pydantic_core import core_schema, to_jsonable_python

from sandbox import program
from sandbox.model import level_catalog
from sandbox.model.atomic_file_writing import generate, write_atomically
from sandbox.model.base import Model
from sandbox.model.comments import SIGN
from sandbox.model.expressions import Expression
from sandbox.model.level import Level
from sandbox.model.loading import read
from sandbox.model.reference_fields import NAMES
from sandbox.model.schema_examples import add_examples
from sandbox.model.shorthand.json_schema import Each, Typed, with_repeats

DIALECT = "https://json-schema.org/draft/2020-12/schema"

Object = dict[str, Any]
"""An object of JSON."""


class _Generate(GenerateJsonSchema):
    """Generates pydantic's schema, adapted for authors of levels."""

    def encode_default(self, dft: object) -> Any:  # noqa: ANN401 (whatever JSON holds)
        return to_jsonable_python(dft, fallback=_source, exclude_none=True)

    def default_schema(self, schema: core_schema.WithDefaultSchema) -> JsonSchemaValue:
        """Omit a default of null, since an author omits the key instead."""
        made = super().default_schema(schema)
        return {key: value for key, value in made.items() if (key, value) != ("default", None)}

    def nullable_schema(self, schema: core_schema.NullableSchema) -> JsonSchemaValue:
        """Omit null for the same reason."""
        return self.generate_inner(schema["schema"])

    def dict_schema(self, schema: core_schema.DictSchema) -> JsonSchemaValue:
        """Allow only proper names as keys."""
        made = {**super().dict_schema(schema), "additionalProperties": False}
        keys = made.pop("propertyNames", {})  # their pattern is already included
        return {**made, NAMES: keys[NAMES]} if NAMES in keys else made


def grammar() -> dict[str, Any]:
    """Return the JSON Schema of a level, with a mark on texts that name a body or a quantity.

    On an object, the mark means that its keys are such names.
    """
    return _grammar(Level)


def _grammar(model: type[Model]) -> dict[str, Any]:
    return model.model_json_schema(by_alias=True, schema_generator=_Generate)


def schema() -> dict[str, Any]:
    """Return the JSON Schema of a level as its author types it, including shorthand."""
    return _described(with_repeats(_grammar(Typed), _grammar(Each)))


def of(model: type[Model]) -> dict[str, Any]:
    """Return the JSON Schema of a format."""
    return _described(_grammar(model))


def _described(made: dict[str, Any]) -> dict[str, Any]:
    return _everywhere({"$schema": DIALECT, **made}, _explain)


def text() -> str:
    """Return the content of the schema file: the schema, with examples from the levels."""
    made = schema()
    levels = (read(level_catalog.find(name)) for name in level_catalog.names())
    add_examples(made, map(json.loads, levels))
    return json.dumps(_everywhere(made, _with_comments), indent=2, ensure_ascii=False) + "\n"


def write() -> Path:
    """Write the schema beside the levels, atomically, and return its path.

    Raises `SandboxError` if the package is installed, with the schema inside it.
    """
    level_catalog.sources()
    target = level_catalog.root() / level_catalog.SCHEMA
    write_atomically(target, text())
    return target


def _source(default: object) -> float | str:
    if isinstance(default, Expression):
        return default.source
    raise TypeError(f"{default!r} cannot be written as JSON")


def _everywhere(part: Any, change: Callable[[Object], Object]) -> Any:  # noqa: ANN401 (any JSON)
    """Return a part with a change made to each of its objects, the innermost first."""
    if isinstance(part, list):
        return [_everywhere(item, change) for item in part]
    if not isinstance(part, dict):
        return part
    return change({key: _everywhere(value, change) for key, value in part.items()})


def _explain(made: Object) -> Object:
    """Move the comment of an expression to the end of its field's description."""
    if isinstance(made.get(NAMES), str):  # unknown to editors
        del made[NAMES]
    if isinstance(text := made.get("description"), str):
        made["description"] = " ".join(text.split())
    if isinstance(comment := made.pop("$comment", None), str):
        made["description"] = f"{made['description']}. {comment}" if text else comment
    return made


def _with_comments(made: Object) -> Object:
    """Allow comments in an object whose keys are known."""
    if made.get("additionalProperties") is False:
        made["patternProperties"] = {**made.get("patternProperties", {}), f"^{SIGN}": {}}
    return made


def main() -> int:
    """Write the schema, print its path, and return the exit status."""
    return generate(lambda: [write()])


if __name__ == "__main__":
    with program.started():
        sys.exit(main())
