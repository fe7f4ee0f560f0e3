"""The register of effects, made from the manifest; it reports incomplete declarations."""

from collections.abc import Iterator, Mapping
from typing import Any, get_args

from sandbox.model.base import Model
from sandbox.model.effects.contract import Effect, IncompleteError


def register(manifest: type[Model]) -> Mapping[str, Effect]:
    """Return the declarations of a manifest's effects, by name and in its order.

    Raises `IncompleteError` if a declaration is missing, or contradicts its model, or if two models
    have the same name.
    """
    _require_names_of_their_own(_models(manifest))
    fields = manifest.model_fields.items()
    return {name: _declared(name, field.annotation) for name, field in fields}


def _declared(name: str, kind: Any) -> Effect:  # noqa: ANN401 (a type is any object)
    """Return the declaration of an effect, if it is complete."""
    model = next(_models(kind))
    place = f"the class {model.__name__} in {_file(model)}"
    effect = getattr(model, "effect", None)
    if not isinstance(effect, Effect):
        rule = f"add 'effect: ClassVar[Effect] = Effect(name=\"{name}\", ...)' to {place}"
        raise IncompleteError(f"the effect '{name}' has no declaration: {rule}")
    if effect.name != name:
        rule = f"{place} says '{effect.name}'"
        raise IncompleteError(f"'{name}' in the list of effects has another name: {rule}")
    for field in (*effect.strength, *effect.needs, effect.softening):
        if field and field not in model.model_fields:
            rule = f"{place} has no field '{field}', which its declaration names"
            raise IncompleteError(f"the effect '{name}' is not told in full: {rule}")
    if effect.turns and not effect.sees_velocity:
        rule = f"{place} does not say 'book', what becomes of the energy that it takes"
        raise IncompleteError(f"the effect '{name}' is not told in full: {rule}")
    return effect


def _models(kind: Any) -> Iterator[type[Model]]:  # noqa: ANN401 (a type is any object)
    """Yield the models that a type consists of, and those of their fields."""
    if isinstance(kind, type) and issubclass(kind, Model):
        yield kind
        for field in kind.model_fields.values():
            yield from _models(field.annotation)
    for inside in get_args(kind):
        yield from _models(inside)


def _require_names_of_their_own(models: Iterator[type[Model]]) -> None:
    """Refuse two models of the same name, which the schema of a level could not tell apart."""
    known: dict[str, type[Model]] = {}
    for model in models:
        other = known.setdefault(model.__name__, model)
        if other is not model:
            rule = f"one in {_file(other)} and one in {_file(model)}; rename one of them"
            raise IncompleteError(f"two models are named {model.__name__}: {rule}")


def _file(model: type[Model]) -> str:
    return f"{model.__module__.replace('.', '/')}.py"
