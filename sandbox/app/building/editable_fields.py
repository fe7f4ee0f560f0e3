"""The fields of any part of a level that can be edited, derived from its model.

A new field of a level, a body, a joint or an effect appears in the inspector automatically, with
its unit and its docstring.
"""

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic.fields import FieldInfo

from sandbox.app.words.language import say
from sandbox.editing.inserted_value_layout import Json
from sandbox.model.base import Model
from sandbox.model.effects import Effects
from sandbox.model.expressions import Expression
from sandbox.model.field_docstrings import docs
from sandbox.model.json_positions import Path
from sandbox.model.reference_fields import Mention

LEFT_OUT = ("$schema", "format", "bodies", "joints")
"""Fields of a level without a widget: those of the file format, and parts selected on the stage."""

InputKind = Literal["number", "text", "choice", "switch", "json"]


@dataclass(frozen=True, slots=True)
class EditableField:
    """A field that can be set."""

    path: Path
    """Its path in the level."""
    label: str
    """Its name, in the current language."""
    help: str
    """Its description, in the current language."""
    unit: str
    """Its unit."""
    input_kind: InputKind
    """The kind of widget; `json` is for values without a widget of their own, typed as in a file.
    """
    shown: str
    """The text of its value; empty if the level leaves it out."""
    default: str = ""
    """The text of its default value."""
    choices: tuple[str, ...] = ()
    """The options of a choice."""
    required: bool = False
    """Whether the level must have it."""
    names: str = ""
    """The kind of name to be completed, such as `quantity` or `body`; empty if none."""


@dataclass(frozen=True, slots=True)
class Section:
    """Entries that belong together, below a heading that unfolds and folds them."""

    path: Path
    label: str
    help: str
    rows: tuple["Row", ...]


Row = tuple[EditableField, ...] | Section
"""One line of the inspector: an entry, the two coordinates of a point, or a section's heading."""


def rows(model: type[Model], values: Mapping[str, Json], path: Path) -> list[Row]:
    """Return the rows for the fields of a part, given by its values in the level and its path."""
    found: list[Row] = []
    for name, field in model.model_fields.items():
        if model is Effects and values.get(name) is None:
            continue  # an effect has fields only if it is switched on
        key = field.alias or name
        if key in LEFT_OUT and not path:
            continue
        found += _rows(key, field, say(help_of(model, name)), values.get(key), (*path, key))
    return found


def read(entry: EditableField, typed: str) -> Json:
    """Return the value that a text means; None if the field is to be left out.

    A text that is not JSON is a string: a formula, a name or words.
    """
    text = typed.strip()
    if not text and not (entry.input_kind == "text" and entry.required):
        return None
    if entry.input_kind in ("text", "choice"):
        return text
    try:
        value: Json = json.loads(text)
    except ValueError:
        return text
    if entry.input_kind == "number" and isinstance(value, bool):
        return text
    return value


def _rows(key: str, field: FieldInfo, message: str, content: Json, path: Path) -> Iterator[Row]:
    kind = bare_type(field.annotation)
    if content is None and isinstance(field.default, Model):
        content = {}
    if get_origin(kind) is Literal and len(get_args(kind)) == 1:
        return  # the type of a shape or a joint
    if isinstance(content, Mapping) and (model := model_of(kind, content)):
        yield Section(
            path, _label(key), message or say(summary_of(model)), tuple(rows(model, content, path))
        )
    elif _members(kind) and isinstance(content, Sequence) and _are_parts(content):
        yield Section(path, _label(key), message, tuple(_items(kind, content, path)))
    elif (
        get_origin(kind) is Mapping
        and isinstance(content, Mapping)
        and model_of(get_args(kind)[1], {})
    ):
        yield Section(path, _label(key), message, tuple(_named(kind, content, path)))
    elif _is_point(kind):
        values = content if isinstance(content, Sequence) and len(content) == 2 else (None, None)
        defaults = field.default if isinstance(field.default, tuple) else (None, None)
        yield tuple(
            _entry(
                f"{_label(key)} {axis}", types, value, (*path, i), message, default, required=True
            )
            for i, (axis, types, value, default) in enumerate(
                zip("xy", get_args(kind), values, defaults, strict=True)
            )
        )
    else:
        default = None if field.is_required() else field.default
        mentions = (extra.of for extra in field.metadata if isinstance(extra, Mention))
        entry = _entry(
            _label(key), kind, content, path, message, default, required=field.is_required()
        )
        yield (replace(entry, names=next(mentions, "")),)


def _are_parts(values: Sequence[Json]) -> bool:
    """Return whether all items of a list have fields; points have none, and are typed in it."""
    return not isinstance(values, str) and all(isinstance(item, Mapping) for item in values)


def _items(kind: Any, values: Sequence[Json], path: Path) -> Iterator[Section]:  # noqa: ANN401
    member = _members(kind)
    for index, item in enumerate(values):
        model = model_of(member, item) if isinstance(item, Mapping) else None
        if model is not None and isinstance(item, Mapping):
            place = (*path, index)
            label = str(item.get("quantity") or item.get("body") or index + 1)
            message = say(summary_of(model))
            yield Section(place, label, message, tuple(rows(model, item, place)))


def _named(kind: Any, values: Mapping[str, Json], path: Path) -> Iterator[Section]:  # noqa: ANN401
    for name, item in values.items():
        model = model_of(get_args(kind)[1], item) if isinstance(item, Mapping) else None
        if model is not None and isinstance(item, Mapping):
            place = (*path, name)
            message = say(summary_of(model))
            yield Section(place, name, message, tuple(rows(model, item, place)))


def _entry(
    label: str, kind: Any, value: Json, path: Path,  # noqa: ANN401
    message: str, default: object, *, required: bool,
) -> EditableField:  # fmt: skip
    kind, unit = bare_type(kind), ""
    input_kind: InputKind = "json"
    choices: tuple[str, ...] = ()
    if isinstance(kind, type) and issubclass(kind, Expression):
        input_kind, unit = "number", kind.unit
    elif kind is bool:
        input_kind = "switch"
    elif kind in (int, float):
        input_kind = "number"
    elif kind is str:
        input_kind = "text"
    elif get_origin(kind) is Literal and all(isinstance(c, str) for c in get_args(kind)):
        input_kind, choices = "choice", get_args(kind)
    shown = _shown(value)
    return EditableField(
        path, label, message, unit, input_kind, shown, _default(default), choices, required
    )


def _shown(value: Json) -> str:
    """Return a value as a person would type it into a field."""
    if value is None:
        return ""
    return value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)


def _default(default: object) -> str:
    if isinstance(default, Expression):
        return _default(default.source)
    if isinstance(default, float) and default.is_integer():
        return _shown(int(default))
    if isinstance(default, bool | int | float | str):
        return _shown(default)
    return ""


def bare_type(kind: Any) -> Any:  # noqa: ANN401 (a type is any object)
    """Return a type without annotations, and without None."""
    while True:
        if get_origin(kind) is Annotated:
            kind = get_args(kind)[0]
        elif get_origin(kind) in (Union, UnionType):
            others = [each for each in get_args(kind) if each is not NoneType]
            if len(others) != 1:
                return kind
            kind = others[0]
        else:
            return kind


def model_of(kind: Any, values: Mapping[str, Json]) -> type[Model] | None:  # noqa: ANN401
    """Return the model of a part; in a union, the one that the part's `type` or `event` names."""
    kind = bare_type(kind)
    if isinstance(kind, type) and issubclass(kind, Model):
        return kind
    if get_origin(kind) in (Union, UnionType):
        parts = (each for each in map(bare_type, get_args(kind)) if isinstance(each, type))
        return next(
            (each for each in parts if issubclass(each, Model) and _is_named(each, values)), None
        )
    return None


def _is_named(model: type[Model], values: Mapping[str, Json]) -> bool:
    """Return whether the `type` or the `event` of a part names a model."""
    fields = model.model_fields
    keys = (key for key in ("type", "event") if key in values and key in fields)
    return any(values[key] in get_args(fields[key].annotation) for key in keys)


def _members(kind: Any) -> Any:  # noqa: ANN401
    """Return the type of a list's items if they are models, else None."""
    arguments = get_args(kind)
    if len(arguments) == 2 and arguments[1] is ...:
        member = bare_type(arguments[0])
        parts = get_args(member) if get_origin(member) in (Union, UnionType) else (member,)
        if any(isinstance(p, type) and issubclass(p, Model) for p in map(bare_type, parts)):
            return member
    return None


def _is_point(kind: Any) -> bool:  # noqa: ANN401
    parts = get_args(kind)
    return (
        get_origin(kind) is tuple
        and len(parts) == 2
        and all(isinstance(p, type) and issubclass(p, Expression) for p in parts)
    )


def _label(key: str) -> str:
    """Return the name of a field, in the current language."""
    return say(label_of(key))


def label_of(key: str) -> str:
    """Return the English name of a field."""
    return key.replace("_", " ")


def help_of(model: type[Model], name: str) -> str:
    """Return the English description of a field; empty if there is none."""
    return " ".join(docs(model).get(name, "").split())


def choices_of(kind: Any) -> tuple[str, ...]:  # noqa: ANN401 (a type is any object)
    """Return the English captions of the options of a type; none if it is not a choice."""
    kind = bare_type(kind)
    literals = get_args(kind) if get_origin(kind) is Literal else ()
    return tuple(caption_of(each) for each in literals if isinstance(each, str))


def caption_of(choice: str) -> str:
    """Return the English caption of an option."""
    return choice.replace("-", " ")


def summary_of(model: type[Model]) -> str:
    """Return the summary line of a model's docstring, in English."""
    return " ".join((model.__doc__ or "").split("\n\n")[0].split())
