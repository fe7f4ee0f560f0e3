"""The mark of fields that name another part of the level.

`sandbox.model.rules.consistency.references_by_name` finds them by their types, so that a new effect
or joint needs no further declaration.
"""

from dataclasses import dataclass
from typing import Annotated, Literal

from pydantic import GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema

NAMES = "names"
"""The key in the schema for the kind of part that a text names."""


@dataclass(frozen=True, slots=True)
class Mention:
    """What a text, or a list of texts, names."""

    of: Literal["body", "couple", "bodies", "quantity", "parameter", "joints", "forces"]
    """The kind: a body, a couple of two different bodies, a list of different bodies, a quantity, a
    parameter, a list of joints, or a list of forces that events switch."""
    acted_on: bool = False
    """Whether something acts on the body, so that it must be a dynamic one."""

    def __get_pydantic_json_schema__(
        self, core: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        return {**handler(core), NAMES: self.of}


BodyName = Annotated[str, Mention("body")]
"""A body of the level."""

ActedOn = Annotated[str, Mention("body", acted_on=True)]
"""A body of the level that an effect acts on."""

ActedOnBodies = Annotated[tuple[ActedOn, ...], Mention("bodies")]
"""Bodies of the level that an effect acts on."""

BodyNames = Annotated[tuple[BodyName, ...], Mention("bodies")]
"""Bodies of the level, of any type."""

Couple = Annotated[tuple[BodyName, BodyName], Mention("couple")]
"""Two bodies of the level, in any order."""

QuantityName = Annotated[str, Mention("quantity")]
"""A quantity that can be measured."""

ParameterName = Annotated[str, Mention("parameter")]
"""A parameter of the level."""

JointNames = Annotated[tuple[str, ...], Mention("joints")]
"""Joints of the level."""

ForceNames = Annotated[tuple[str, ...], Mention("forces")]
"""Effects of the level that are forces, or named forces in them."""
