"""Iteration over anything made of frozen parts and expressions."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import cast

from sandbox.model.base import Model
from sandbox.model.expressions import Expression
from sandbox.model.json_positions import Path

Members = Iterable[tuple[str | int, object]]

Lists = Callable[[object], Members]
"""Lists the members of a part, with their names."""

_KINDS: dict[type, Lists | None] = {}
"""What lists the members of each type so far: to ask what pydantic's models are takes long."""


def expressions(part: object, path: Path = ()) -> Iterator[tuple[Path, Expression]]:
    """Yield every expression in a part of a level, with its path."""
    found: list[tuple[Path, Expression]] = []
    if isinstance(part, Expression):
        found.append((path, part))
    elif members := _members(type(part)):
        _collect(members(part), path, found)
    return iter(found)


def _collect(members: Members, path: Path, found: list[tuple[Path, Expression]]) -> None:
    """Append every expression in some members of the part at a path."""
    for name, member in members:
        if isinstance(member, Expression):
            found.append(((*path, name), member))
        elif inner := _members(type(member)):
            _collect(inner(member), (*path, name), found)


def _members(kind: type) -> Lists | None:
    """Return what lists the members of a part of some type; None if it has none."""
    if kind not in _KINDS:
        _KINDS[kind] = _lists(kind)
    return _KINDS[kind]


def _lists(kind: type) -> Lists | None:
    if issubclass(kind, Model):
        return lambda part: vars(part).items()
    if issubclass(kind, tuple):
        return lambda part: enumerate(cast("tuple[object, ...]", part))
    if issubclass(kind, Mapping):
        return lambda part: cast("Mapping[str, object]", part).items()
    return None
