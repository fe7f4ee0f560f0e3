"""Walking through the parts of a level."""

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from sandbox.model.base import Model
from sandbox.model.expressions import Expression
from sandbox.model.locating import Path


class Fault(NamedTuple):
    """Something wrong with a level: where, and what."""

    path: Path
    rule: str


def expressions(part: object, path: Path = ()) -> Iterator[tuple[Path, Expression]]:
    """Yield every expression below a part of a level, with the path to it."""
    if isinstance(part, Expression):
        yield path, part
        return
    children: Iterator[tuple[str | int, Any]] = iter(())
    if isinstance(part, Model):
        children = ((name, getattr(part, name)) for name in type(part).model_fields)
    elif isinstance(part, Mapping):
        children = iter(part.items())
    elif isinstance(part, tuple):
        children = iter(enumerate(part))
    for name, child in children:
        yield from expressions(child, (*path, name))


def names_in(part: object) -> frozenset[str]:
    """Return the names that the expressions below a part of a level use."""
    return frozenset().union(*(expression.names for _, expression in expressions(part)))
