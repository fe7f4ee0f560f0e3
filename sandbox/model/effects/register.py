"""The register of effects, made from the manifest; it reports incomplete declarations."""

from collections.abc import Iterator, Mapping
from typing import Any, get_args

from sandbox.model.base import Model
from sandbox.model.effects.contract import Effect, IncompleteError


def register(manifest: type[Model]) -> Mapping[str, Effect]:
    """Return the declarations of a manifest's effects, by name and in its order.

    Raises `IncompleteError` if a declaration is missing, or contradicts its model.
    """
    fields = manifest.model_fields.items()
    return {name: _declared(name, field.annotation) for name, field in fields}


def _declared(name: str, kind: Any) -> Effect:  # noqa: ANN401 (a type is any object)
    """Return the declaration of an effect, if it is complete."""
    model = next(_models(kind))
    place = f"the class {model.__name__} in {model.__module__.replace('.', '/')}.py"
    effect = getattr(model, "effect", None)
    if not isinstance(effect, Effect):
        rule = f"add 'effect: ClassVar[Effect] = Effect(name=\"{name}\", ...)' to {place}"
        raise IncompleteError(f"the effect '{name}' has no declaration: {rule}")
    if effect.name != name:
        rule = f"{place} says '{effect.name}'"
        raise IncompleteError(f"'{name}' in the list of effects has another name: {rule}")
    for field in (*effect.strength, *effect.needs):
        if field not in model.model_fields:
            rule = f"{place} has no field '{field}', which it says its strength is"
            raise IncompleteError(f"the effect '{name}' is not told in full: {rule}")
    if effect.turns and not effect.sees_velocity:
        rule = f"{place} does not say 'book', what becomes of the energy that it takes"
        raise IncompleteError(f"the effect '{name}' is not told in full: {rule}")
    return effect


def _models(kind: Any) -> Iterator[type[Model]]:  # noqa: ANN401 (a type is any object)
    """Yield the models that a type consists of."""
    if isinstance(kind, type) and issubclass(kind, Model):
        yield kind
    for inside in get_args(kind):
        yield from _models(inside)
