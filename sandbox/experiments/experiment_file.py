"""The format of an experiment's JSON file, and reading one.

The texts of `vary` and `measure` are those of the command line, which defines the same experiment.
"""

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, ValidationError
from pydantic_core import ErrorDetails

from sandbox.experiments.random_points import Method
from sandbox.model import parser_error_messages
from sandbox.model.base import Model, Name
from sandbox.model.did_you_mean import suggestion
from sandbox.model.errors import brief
from sandbox.model.expression_compiler import MAX_LENGTH
from sandbox.model.json_document import Document
from sandbox.model.level_parts import Fault
from sandbox.model.loading import read as read_text
from sandbox.model.number_bounds import Finite
from sandbox.model.translatable_message import Message

MAX_BYTES = 1_000_000
"""The largest file that is read [bytes]."""

Text = Annotated[str, Field(min_length=1, max_length=MAX_LENGTH)]


class Experiment(Model):
    """Runs of a level with varied parameters, and what is measured in each."""

    schema_: Annotated[str | None, Field(alias="$schema")] = None
    """where an editor finds the JSON Schema of the format"""
    format: Literal[1] = 1
    """the version of the format"""
    title: Annotated[str, Field(max_length=80)] = ""
    """the title of the report; the level's own if left out"""
    summary: Annotated[str, Field(max_length=2000)] = ""
    """a description, in a few sentences"""
    level: Text
    """a level's name, such as `newton/atwood`, or the path of its file, relative to this file"""
    vary: Annotated[Mapping[Name, Annotated[str, Field(max_length=100_000)]], Field(max_length=20)]
    """the values of each varied parameter of the level, or of `without` (names of effects, or
    `none`, joined by +), `scheme` or `rate`. `0:90:91` is a grid of 91 values from 0 to 90,
    `1:1000:31:log` one with equal ratios, `1, 2, 5` a list. Random values are drawn uniformly or
    log-uniformly with `0..1` and `1..100:log`, and from a normal distribution with `1.00±0.01`"""
    measure: Annotated[tuple[Text, ...], Field(min_length=1, max_length=50)]
    """the measures of each run: `QUANTITY@end`, `@TIME`, `@landing(BODY)`, `@apex(BODY)`,
    `@contact(BODY, BODY)`, `@crossing(QUANTITY, VALUE, up)` or `@until`; `min`, `max`, `largest`,
    `amplitude`, `mean` or `integral` of `(QUANTITY)`; `error(CHECK)`. `QUANTITY` may be an
    arithmetic expression in several quantities"""
    set: Mapping[Name, Finite] = {}
    """the values of parameters that differ from the level's own"""
    draws: Annotated[int, Field(ge=1, le=10**9)] | None = None
    """the number of random draws at each point of the grid; for `sobol-indices`, the number of base
    points"""
    method: Method = "random"
    """the sampling method: independent draws, a Latin hypercube, a Sobol sequence, or the design
    from which Sobol sensitivity indices are computed"""
    seed: Annotated[int, Field(ge=0, le=2**32 - 1)] = 0
    """the seed of the random draws"""
    duration: Annotated[float, Field(gt=0, allow_inf_nan=False)] | None = None
    """s, the duration of each run; the level's own if left out"""
    until: Text | None = None
    """a condition on quantities, such as `ball.position.y < 0`: a run ends at the first step at
    which it holds"""
    rate: Annotated[float, Field(ge=1, le=100_000)] | None = None
    """Hz, steps per second; the level's own if left out"""
    scheme: Text | None = None
    """the integration scheme; the level's own if left out"""


def load(path: Path) -> Experiment:
    """Read an experiment from a JSON file.

    Raises `LevelError` if it cannot be read or has mistakes; the error lists all of them.
    """
    return read(path)[0]


def read(path: Path) -> tuple[Experiment, Document]:
    """Return an experiment and its text, which locates mistakes; see `load`."""
    text = read_text(path, MAX_BYTES)
    document = Document(text, str(path))
    data = document.read()
    try:
        return Experiment.model_validate_json(text), document
    except ValidationError as error:
        document.refuse(_faults(error, document, data))


def parsed(fields: Mapping[str, object]) -> tuple[Experiment | None, list[Fault]]:
    """Return the experiment with the given fields, or all mistakes in them."""
    try:
        return Experiment.model_validate_json(json.dumps(fields)), []
    except ValidationError as error:
        return None, list(_faults(error, None, fields))


def _faults(error: ValidationError, document: Document | None, data: Any) -> Iterator[Fault]:  # noqa: ANN401 (whatever JSON holds)
    if not isinstance(data, dict):
        yield Fault((), "must be an object, {...}")
        return
    for detail in error.errors(include_url=False):
        locations = document.values.keys() if document else {detail["loc"][:1]}
        path = parser_error_messages.path_of(detail, locations.__contains__)
        yield Fault(path, _rule(detail))


def _rule(detail: ErrorDetails) -> Message:
    if detail["type"] == "extra_forbidden":
        keys = [f.alias or name for name, f in Experiment.model_fields.items()]
        name = str(detail["loc"][-1])
        hint = suggestion(name, keys, longest=len(keys))
        return Message("unknown key '{name}'{hint}", name=brief(name), hint=hint)
    return parser_error_messages.rule(detail)
