"""Finding the fields of a model whose types are marked: `Annotated[str, Mark()]`.

A mark is part of a field's declaration. Code that looks for marked values therefore also finds
those of any new field, effect or joint.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from types import NoneType, UnionType
from typing import Annotated, Any, Union, get_args, get_origin, get_type_hints

from sandbox.model.base import Model
from sandbox.model.json_positions import Path

Marked = tuple[Path, Any, Any]
"""The path of a marked value, the value, and its mark."""

Find = Callable[[Any, Path], Iterator[Marked]]
"""A function that yields the marked values within a value, given its path."""


def marked(part: Model, kind: type, path: Path = ()) -> Iterator[Marked]:
    """Yield path, value and mark of every value in a part that has a given kind of mark."""
    find = _of_model(type(part), kind)
    if find:
        yield from find(part, path)


@cache
def _of_model(model: type[Model], kind: type) -> Find | None:
    """Return the finder of marks in a model; None if it can contain none."""
    hints = get_type_hints(model, include_extras=True)
    found = {field: _finder(hints[field], kind) for field in model.model_fields}
    fields = {field: find for field, find in found.items() if find}
    if not fields:
        return None

    def find(part: Model, path: Path) -> Iterator[Marked]:
        for field, inside in fields.items():
            yield from inside(getattr(part, field), (*path, field))

    return find


def _finder(hint: Any, kind: type) -> Find | None:  # noqa: ANN401 (a type is any object)
    """Return the finder of marks in a value of a type; None if it can contain none."""
    origin, arguments = get_origin(hint), get_args(hint)
    if origin is Annotated:
        inside = _finder(arguments[0], kind)
        mark = next((extra for extra in arguments[1:] if isinstance(extra, kind)), None)
        return inside if mark is None else _marked(mark, inside)
    if origin in (Union, UnionType):
        return _of_union(arguments, kind)
    if origin is tuple:
        return _of_tuple([argument for argument in arguments if argument is not Ellipsis], kind)
    if origin is Mapping:
        return _of_mapping(*(_finder(argument, kind) for argument in arguments))
    return _of_model(hint, kind) if isinstance(hint, type) and issubclass(hint, Model) else None


def _marked(mark: object, inside: Find | None) -> Find:
    def find(value: object, path: Path) -> Iterator[Marked]:
        yield path, value, mark
        if inside:
            yield from inside(value, path)

    return find


def _of_union(hints: Sequence[Any], kind: type) -> Find | None:
    """Return the finder of marks in a value of one of several types."""
    found = [(_classes(hint), _finder(hint, kind)) for hint in hints if hint is not NoneType]
    if not any(find for _, find in found):
        return None

    def find(value: object, path: Path) -> Iterator[Marked]:
        for classes, inside in found:
            if inside and isinstance(value, classes):
                yield from inside(value, path)

    return find


def _classes(hint: Any) -> tuple[type, ...]:  # noqa: ANN401 (a type is any object)
    """Return the classes of the values of a type."""
    origin, arguments = get_origin(hint), get_args(hint)
    if origin is Annotated:
        return _classes(arguments[0])
    if origin in (Union, UnionType):
        return tuple(found for argument in arguments for found in _classes(argument))
    return (origin or hint,)


def _of_tuple(hints: Sequence[Any], kind: type) -> Find | None:
    """Return the finder of marks in a tuple; one of variable length has a single item type."""
    found = [_finder(hint, kind) for hint in hints]
    if not any(found):
        return None

    def find(value: Sequence[object], path: Path) -> Iterator[Marked]:
        for index, item in enumerate(value):
            if inside := found[min(index, len(found) - 1)]:
                yield from inside(item, (*path, index))

    return find


def _of_mapping(of_key: Find | None, of_value: Find | None) -> Find | None:
    if not (of_key or of_value):
        return None

    def find(value: Mapping[str, object], path: Path) -> Iterator[Marked]:
        for key, item in value.items():
            if of_key:
                yield from of_key(key, (*path, key))
            if of_value:
                yield from of_value(item, (*path, key))

    return find


@dataclass(frozen=True, slots=True)
class Words:
    """Marks a text for people, which no formula or name uses."""


Prose = Annotated[str, Words()]
"""Text for people."""


def prose(part: Model) -> Iterator[tuple[Path, str]]:
    """Yield all texts in a part of a level that are not empty, with their paths."""
    return ((path, text) for path, text, _ in marked(part, Words) if text)
