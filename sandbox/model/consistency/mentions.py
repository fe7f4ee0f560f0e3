"""Where a level names its bodies and quantities, found from the types of its fields."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache
from types import NoneType, UnionType
from typing import Annotated, Any, NamedTuple, Union, get_args, get_origin, get_type_hints

from sandbox.model.base import Model
from sandbox.model.effects import EFFECTS
from sandbox.model.effects.friction import Friction
from sandbox.model.effects.restitution import Restitution
from sandbox.model.level import Level
from sandbox.model.locating import Path
from sandbox.model.mention import Mention


class Mentioned(NamedTuple):
    """A name, or a list of names, that stands in a level."""

    path: Path
    value: Any
    mention: Mention


Find = Callable[[Any, Path], Iterator[Mentioned]]
"""Yields what a value names, which stands at a path."""


def mentions(part: Model, path: Path = ()) -> Iterator[Mentioned]:
    """Yield everything that a part of a level names, and where."""
    find = _of_model(type(part))
    if find:
        yield from find(part, path)


def named_bodies(level: Level) -> Iterator[tuple[Path, str]]:
    """Yield every mention of a body, and where it stands."""
    return ((path, name) for path, name, mention in mentions(level) if mention.of == "body")


def named_quantities(level: Level) -> Iterator[tuple[Path, str]]:
    """Yield every quantity that is measured, and where it is asked for."""
    return ((path, name) for path, name, mention in mentions(level) if mention.of == "quantity")


def named_parameters(level: Level) -> Iterator[tuple[Path, str]]:
    """Yield every parameter that is named outside of a formula, and where."""
    return ((path, name) for path, name, mention in mentions(level) if mention.of == "parameter")


def acted_on(level: Level) -> Iterator[tuple[Path, str]]:
    """Yield the bodies that an effect acts on."""
    return ((path, name) for path, name, mention in mentions(level) if mention.acted_on)


def lists_of_bodies(level: Level) -> Iterator[tuple[Path, tuple[str, ...]]]:
    """Yield the lists that name the bodies an effect acts on."""
    return ((path, names) for path, names, mention in mentions(level) if mention.of == "bodies")


def couples(level: Level) -> Iterator[tuple[Path, tuple[str, str]]]:
    """Yield everything that two bodies are named for."""
    return ((path, names) for path, names, mention in mentions(level) if mention.of == "couple")


def bodies_of_flows(level: Level) -> Iterator[tuple[Path, str]]:
    """Yield the bodies whose mass changes."""
    changing = {name for name, effect in EFFECTS.items() if effect.changes_mass}
    for path, name in acted_on(level):
        if path[0] == "effects" and path[1] in changing:
            yield path, name


def coefficients(level: Level) -> dict[str, Friction | Restitution]:
    """Return those effects that have a coefficient a body."""
    return {effect.name: said for effect, _, said in level.effects.said if effect.coefficient}


@cache
def _of_model(model: type[Model]) -> Find | None:
    """Return what finds the names in a part of that kind; None if there can be none."""
    hints = get_type_hints(model, include_extras=True)
    found = {field: _finder(hints[field]) for field in model.model_fields}
    fields = {field: find for field, find in found.items() if find}
    if not fields:
        return None

    def find(part: Model, path: Path) -> Iterator[Mentioned]:
        for field, inside in fields.items():
            yield from inside(getattr(part, field), (*path, field))

    return find


def _finder(kind: Any) -> Find | None:  # noqa: ANN401 (a type is any object)
    """Return what finds the names in a value of a type; None if there can be none."""
    origin, arguments = get_origin(kind), get_args(kind)
    if origin is Annotated:
        said = next((extra for extra in arguments[1:] if isinstance(extra, Mention)), None)
        return _mentioned(said, _finder(arguments[0])) if said else _finder(arguments[0])
    if origin in (Union, UnionType):
        return _of_union(arguments)
    if origin is tuple:
        return _of_tuple([argument for argument in arguments if argument is not Ellipsis])
    if origin is Mapping:
        return _of_mapping(*map(_finder, arguments))
    return _of_model(kind) if isinstance(kind, type) and issubclass(kind, Model) else None


def _mentioned(mention: Mention, inside: Find | None) -> Find:
    def find(value: object, path: Path) -> Iterator[Mentioned]:
        yield Mentioned(path, value, mention)
        if inside:
            yield from inside(value, path)

    return find


def _of_union(kinds: Sequence[Any]) -> Find | None:
    """Return what finds the names in a value that is of one of some types."""
    found = [(_classes(kind), _finder(kind)) for kind in kinds if kind is not NoneType]
    if not any(find for _, find in found):
        return None

    def find(value: object, path: Path) -> Iterator[Mentioned]:
        for kind, inside in found:
            if inside and isinstance(value, kind):
                yield from inside(value, path)

    return find


def _classes(kind: Any) -> tuple[type, ...]:  # noqa: ANN401 (a type is any object)
    """Return the classes that the values of a type have."""
    origin, arguments = get_origin(kind), get_args(kind)
    if origin is Annotated:
        return _classes(arguments[0])
    if origin in (Union, UnionType):
        return tuple(found for argument in arguments for found in _classes(argument))
    return (origin or kind,)


def _of_tuple(kinds: Sequence[Any]) -> Find | None:
    """Return what finds the names in a list; if it is of any length, all of it is of one type."""
    found = [_finder(kind) for kind in kinds]
    if not any(found):
        return None

    def find(value: Sequence[object], path: Path) -> Iterator[Mentioned]:
        for index, item in enumerate(value):
            if inside := found[min(index, len(found) - 1)]:
                yield from inside(item, (*path, index))

    return find


def _of_mapping(of_key: Find | None, of_value: Find | None) -> Find | None:
    if not (of_key or of_value):
        return None

    def find(value: Mapping[str, object], path: Path) -> Iterator[Mentioned]:
        for key, item in value.items():
            if of_key:
                yield from of_key(key, (*path, key))
            if of_value:
                yield from of_value(item, (*path, key))

    return find
