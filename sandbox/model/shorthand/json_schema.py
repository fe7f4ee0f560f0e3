"""The JSON Schema of shorthand, so that editors complete it as well."""

from collections.abc import Iterator, Mapping
from typing import Annotated, Any

from pydantic import Field, create_model

from sandbox.model.base import Model, Name
from sandbox.model.body import Body
from sandbox.model.level import Level
from sandbox.model.shorthand.groups import Copy, Group
from sandbox.model.shorthand.indices import MOST_TIMES
from sandbox.model.shorthand.repeated_members import GROUPS, REPEAT, order

Part = dict[str, Any]

Bound = (
    Annotated[int, Field(ge=-MOST_TIMES, le=MOST_TIMES)]
    | Annotated[str, Field(pattern=r"^\s*\{[^{}]+\}\s*$")]
)
"""A whole number, or an expression in other indices, in braces."""


_TOLD = {
    "bodies": "the bodies, by name, or copies of groups",
    GROUPS: "sets of bodies and joints that can be placed as one, any number of times",
}

_FIELDS: Mapping[str, Any] = {
    "bodies": (
        Annotated[Mapping[Name, Body | Copy], *Level.model_fields["bodies"].metadata],
        Field(description=_TOLD["bodies"]),
    ),
    GROUPS: (Mapping[Name, Group], Field({}, description=_TOLD[GROUPS])),
}

Typed: type[Model] = create_model("Level", __base__=Level, __doc__=Level.__doc__, **_FIELDS)
"""A level as its author types it."""


class Each(Model):
    """A repeated member that is not an object."""

    repeat: Annotated[Mapping[Name, Bound | tuple[Bound, Bound]], Field(min_length=1)]
    """the indices, each with a count, from 0, or with its first and last value; in the texts of
    each copy, expressions in braces such as `{i + 1}` are replaced by their values"""
    each: Any
    """the member to repeat"""


TEMPLATE = r"^[A-Za-z]([A-Za-z0-9_]|\{[^{}]+\})*$"
"""A name with an index in braces."""


def with_repeats(made: Part, each: Part) -> Part:
    """Allow repeats in the schema of `Typed` wherever they are possible, and order its keys."""
    made["properties"] = {name: made["properties"][name] for name in order(made["properties"])}
    for holder, key in list(_members(made)):
        member = holder[key]
        alternatives = member.get("oneOf") or member.get("anyOf") or [member]
        if all("$ref" in one for one in alternatives):
            for one in alternatives:
                _definition(made, one)["properties"].setdefault(REPEAT, {"$ref": "#/$defs/Repeat"})
        else:
            holder[key] = {"anyOf": [member, {"$ref": "#/$defs/Each"}]}
        if key != "items":
            holder[f"{key}|{TEMPLATE}"] = holder.pop(key)
    made["$defs"] |= {"Repeat": each["properties"][REPEAT], "Each": each}
    each["properties"][REPEAT] = {"$ref": "#/$defs/Repeat"}
    return made


def _definition(made: Part, one: Part) -> Part:
    return made["$defs"][one["$ref"].rpartition("/")[2]]


def _members(part: Any) -> Iterator[tuple[Part, str]]:  # noqa: ANN401 (whatever JSON holds)
    """Yield the schema of the members of every list and of every part with named members."""
    if isinstance(part, list):
        for one in part:
            yield from _members(one)
    if not isinstance(part, dict):
        return
    for inside in part.values():
        yield from _members(inside)
    if isinstance(part.get("items"), dict):
        yield part, "items"
    if named := part.get("patternProperties"):
        (pattern,) = named
        yield named, pattern
