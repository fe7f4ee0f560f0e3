"""Valid examples of effects with required fields, made from the types of the fields."""

from collections.abc import Sequence
from typing import Any, get_args, get_origin

from pydantic.fields import FieldInfo

from sandbox.app.building.editable_fields import bare_type
from sandbox.editing.inserted_value_layout import Json
from sandbox.model.base import Model
from sandbox.model.effects import Effects
from sandbox.model.expressions import Expression, Positive
from sandbox.model.reference_fields import Mention

LITTLE = 0.1
"""The example value of a field that must be positive and may have an upper bound."""


def example(effect: str, moving: Sequence[str], others: Sequence[str]) -> dict[str, Json]:
    """Return example settings of an effect, given the names of moving and other bodies."""
    kind = bare_type(Effects.model_fields[effect].annotation)
    model = bare_type(get_args(kind)[0]) if get_origin(kind) is tuple else kind
    return _of(model, moving, others)


def _of(model: type[Model], moving: Sequence[str], others: Sequence[str]) -> dict[str, Json]:
    fields = model.model_fields.items()
    return {name: _value(field, moving, others) for name, field in fields if field.is_required()}


def _value(field: FieldInfo, moving: Sequence[str], others: Sequence[str]) -> Json:
    kind = bare_type(field.annotation)
    mention = next((each for each in field.metadata if isinstance(each, Mention)), None)
    if mention is not None:
        bodies = moving if mention.acted_on else [*others, *moving]
        return list(moving[:2]) if mention.of in ("couple", "bodies") else "".join(bodies[:1])
    if get_origin(kind) is tuple:
        return _several(get_args(kind), moving, others)
    return LITTLE if _is(kind, Positive) else 1


def _several(kinds: tuple[Any, ...], moving: Sequence[str], others: Sequence[str]) -> Json:
    """Return a point on the first axis, or a list of one part."""
    if _is(kinds[0], Expression):
        return [1, 0]
    part = bare_type(kinds[0])
    return [_of(part, moving, others)] if _is(part, Model) else []


def _is(kind: Any, of: type) -> bool:  # noqa: ANN401 (a type is any object)
    return isinstance(kind, type) and issubclass(kind, of)
