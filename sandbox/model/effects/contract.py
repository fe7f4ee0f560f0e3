"""The contract of an effect: it is declared once, and everything else is derived from that.

To add one, see `docs/how-to/add-an-effect.md`. An effect is

- a module of its name in `sandbox/model/effects/`: a frozen model whose docstring is the equation,
  whose fields name their units, and whose `effect` is an `Effect`, as below;
- a field in the list, `Effects` in `sandbox/model/effects/__init__.py`;
- if it is a force, a module of the same name in `sandbox/physics/forces/`, with a function `laws`;
  see `sandbox.physics.forces.law` for what a law is.

The following derive from it: the manifest and its JSON Schema, the messages about unknown effects,
keys and bodies, the remarks about effects without strength, the suggestions in the app and the
option `--with`, the accounts of the ledger and their quantities, the schemes that a level may use,
and the tests of all effects. An incomplete declaration is reported when the package is loaded, with
the file to mend.

The fields that name bodies are recognized by their types (see `sandbox.model.reference_fields`).
Units are part of the types in `sandbox.model.number_bounds`, and of the fields' docstrings.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Literal, get_args

from sandbox.model.base import Model
from sandbox.model.expressions import Expression

Book = Literal["potential", "loss", "work", "none"]
"""The destination of the energy that an effect takes: stored, lost, or exchanged with the outside;
`none` if the effect does no work."""

Sight = Literal["position", "angle", "velocity", "time"]
"""A variable that a force depends on."""

Settings = Mapping[str, object]
"""The fields of an effect, as in a level's file."""


class IncompleteError(TypeError):
    """An effect or a joint whose declaration is incomplete; the message says what is missing."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Effect:
    """The declaration of an effect."""

    name: str
    """Its name in the manifest, and that of its modules."""
    acts: Literal["law", "pymunk", "scene"] = "law"
    """How it acts: as a `law`, a force in a module of `sandbox/physics/forces/`; by a force that
    `pymunk` applies itself; or on the `scene`, through its surfaces and moments of inertia."""
    depends_on: tuple[Sight, ...] = ()
    """The variables that the force depends on."""
    smooth: bool = True
    """Whether the force is a smooth function of these. A jump reduces any scheme to first order."""
    book: Book = "none"
    """The destination of the energy that it takes; `none` if it does no work. A law that depends on
    the velocity but does no work turns velocities (see `sandbox.physics.forces.law`)."""
    drives: Callable[[Any], bool] | None = None
    """A function of its settings that returns whether it is booked as `work` instead; optional."""
    account: str = ""
    """The account of its energy; its name if left out."""
    is_internal: bool = False
    """Whether it acts only between bodies, and between every two of those that it acts on, so that
    it does not change their total momentum. Their number is limited by the cost of a step."""
    is_singular: bool = False
    """Whether the force between two bodies at the same position is infinite, so that bodies that
    start there are refused."""
    softening: str = ""
    """The field that keeps such a force finite if it is positive; optional."""
    strength: tuple[str, ...] = ()
    """The fields that give it strength: if all of them are zero, a remark says so."""
    needs: tuple[str, ...] = ()
    """Fields of which at least one must be positive, or the level is refused."""
    coefficient: type[Expression] | None = None
    """The type of its coefficients of bodies and pairs, which are fields of its name."""
    trial: Settings | None = None
    """The settings with which to try it in any level; None if it needs settings of its own."""
    changes_mass: bool = False
    """Whether it changes the masses of the bodies that it names."""
    exerts_torque: bool = False
    """Whether it can turn bodies, so that `rotation` has an effect with it."""
    force_name: str = ""
    """The name of its force in a free-body diagram; its own name if left out."""

    @property
    def is_force(self) -> bool:
        """Whether it is a force, and not a property of the scene."""
        return self.acts != "scene"

    @property
    def is_law(self) -> bool:
        """Whether it is a force that pymunk does not apply by itself."""
        return self.acts == "law"

    @property
    def depends_on_velocity(self) -> bool:
        """Whether the force depends on velocities."""
        return "velocity" in self.depends_on

    @property
    def rotates_velocity(self) -> bool:
        """Whether it only turns velocities, and does no work."""
        return self.is_law and self.book == "none"

    @property
    def account_name(self) -> str:
        """The name of the account of its energy."""
        return self.account or self.name

    @property
    def is_rough(self) -> bool:
        """Whether a level with it cannot use a scheme of higher order than leapfrog."""
        return self.depends_on_velocity or not self.smooth

    @property
    def shown_force_name(self) -> str:
        """The name of its force in a free-body diagram."""
        return self.force_name or self.name

    def stores(self, name: str) -> bool:
        """Whether it is the effect of that name, and stores energy."""
        return self.name == name and self.book == "potential"

    def book_of(self, settings: object) -> Book:
        """Return the destination of the energy that the effect takes, given its settings."""
        return "work" if self.drives and self.drives(settings) else self.book


def register(manifest: type[Model]) -> Mapping[str, Effect]:
    """Return the declarations of a manifest's effects, by name and in its order.

    Raises `IncompleteError` if a declaration is missing, or contradicts its model, or if two models
    have the same name.
    """
    _require_unique_names(_models(manifest))
    fields = manifest.model_fields.items()
    return {name: _declared(name, field.annotation) for name, field in fields}


def _declared(name: str, kind: Any) -> Effect:  # noqa: ANN401 (a type is any object)
    """Return the declaration of an effect, if it is complete."""
    model = next(_models(kind))
    class_and_file = f"the class {model.__name__} in {_file(model)}"
    effect = getattr(model, "effect", None)
    if not isinstance(effect, Effect):
        rule = f"add 'effect: ClassVar[Effect] = Effect(name=\"{name}\", ...)' to {class_and_file}"
        raise IncompleteError(f"the effect '{name}' has no declaration: {rule}")
    if effect.name != name:
        rule = f"{class_and_file} says '{effect.name}'"
        raise IncompleteError(f"'{name}' in the list of effects has another name: {rule}")
    for field in (*effect.strength, *effect.needs, effect.softening):
        if field and field not in model.model_fields:
            rule = f"{class_and_file} has no field '{field}', which its declaration names"
            raise IncompleteError(f"the effect '{name}' is not told in full: {rule}")
    if effect.rotates_velocity and not effect.depends_on_velocity:
        rule = f"{class_and_file} does not say 'book', what becomes of the energy that it takes"
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


def _require_unique_names(models: Iterator[type[Model]]) -> None:
    """Refuse two models of the same name, which the schema of a level could not tell apart."""
    known: dict[str, type[Model]] = {}
    for model in models:
        other = known.setdefault(model.__name__, model)
        if other is not model:
            rule = f"one in {_file(other)} and one in {_file(model)}; rename one of them"
            raise IncompleteError(f"two models are named {model.__name__}: {rule}")


def _file(model: type[Model]) -> str:
    return f"{model.__module__.replace('.', '/')}.py"
