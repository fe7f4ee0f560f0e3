"""The force laws that a level declares, made by each effect's own module.

The module of a law is imported when a level declares it, and not otherwise.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from importlib import import_module
from importlib.util import find_spec
from typing import Any

from sandbox.model.base import Model
from sandbox.model.effects import EFFECTS, Effects
from sandbox.model.effects.contract import Effect, IncompleteError
from sandbox.model.expressions import Array, Values
from sandbox.model.level import Level
from sandbox.model.shapes import evaluate
from sandbox.physics.forces.gravity import Gravity
from sandbox.physics.forces.law import Law, LawInputs, VelocityRotation
from sandbox.physics.forces.variable_mass import Flow, MassFlows, MassFraction, constant_mass

_ROOM = __name__.rpartition(".")[0]


def gravity(
    effects: Effects, values: Values, mass: Array, mass_fraction: MassFraction
) -> Gravity | None:
    """Return the level's uniform gravity, if it declares any."""
    if effects.gravity is None:
        return None
    return Gravity(evaluate(effects.gravity.acceleration, values), mass, mass_fraction)


def laws(
    effects: Effects, inputs: LawInputs
) -> tuple[tuple[Law, ...], tuple[VelocityRotation, ...]]:
    """Return the laws that pymunk does not apply by itself: forces, and rotations of velocities.

    Raises `IncompleteError` if the law of an effect contradicts its declaration.
    """
    forces: list[Law] = []
    rotations: list[VelocityRotation] = []
    for effect in effects.declarations:
        if not effect.is_law:
            continue
        for law in _laws_of(effect, getattr(effects, effect.name), inputs):
            _require(effect, law)
            (rotations if effect.rotates_velocity else forces).append(law)
    return tuple(forces), tuple(rotations)


def _laws_of(effect: Effect, settings: Any, inputs: LawInputs) -> Iterable[Any]:  # noqa: ANN401
    make = part_of(effect, "laws")
    if not inputs.switches:
        return make(settings, inputs)
    from sandbox.physics.forces.switched_laws import switched_laws

    return switched_laws(make, settings, effect.name, inputs)


def laws_by_entry(effects: Effects, inputs: LawInputs) -> Iterator[tuple[Model, Law]]:
    """Yield each force with its settings; if these are a list, one law for each entry."""
    for effect in effects.declarations:
        if effect.is_law and not effect.rotates_velocity:
            settings = getattr(effects, effect.name)
            for entry in settings if isinstance(settings, tuple) else (settings,):
                part = (entry,) if isinstance(settings, tuple) else entry
                yield from ((entry, law) for law in _laws_of(effect, part, inputs))


def mass_fraction_of(
    effects: Effects, values: Values, names: Sequence[str], mass: Array
) -> MassFraction:
    """Return the mass fractions of bodies over time; `constant_mass` if no matter flows."""
    flows: list[Flow] = []
    for effect in effects.declarations:
        if effect.changes_mass:
            flows += part_of(effect, "flows")(getattr(effects, effect.name), values, names)
    return MassFlows(flows, mass) if flows else constant_mass


def any_law(level: Level) -> bool:
    """Return whether a level has forces that pymunk does not apply by itself, as springs."""
    declared = any(effect.is_law for effect in level.effects.declarations)
    return declared or any(joint.kind.force for joint in level.joints.values())


def missing(effects: Iterable[Effect]) -> Iterator[str]:
    """Yield a message for each effect that lacks the module of its law, without loading any."""
    for effect in effects:
        if effect.is_law and find_spec(f"{_ROOM}.{effect.name}") is None:
            yield _message(effect, f"it has no law: add {_file(effect)} with a function 'laws'")


def part_of(effect: Effect, function: str) -> Callable[..., Iterable[Any]]:
    """Return a function of an effect's own module; raise `IncompleteError` if it has none."""
    module = import_module(f"{_ROOM}.{effect.name}")
    if not hasattr(module, function):
        lacking = f"its law is incomplete: add a function '{function}' to {_file(effect)}"
        raise IncompleteError(_message(effect, lacking))
    return getattr(module, function)


def _require(effect: Effect, law: Law | VelocityRotation) -> None:
    """Refuse a law that contradicts its effect's declaration."""
    required = ("rate",) if effect.rotates_velocity else ("add", "potential_energy")
    if lacking := [name for name in required if not hasattr(law, name)]:
        kind = (
            "does no work, so it is a VelocityRotation" if effect.rotates_velocity else "is a Law"
        )
        which = f"its law {kind}, but {type(law).__name__} in {_file(effect)}"
        raise IncompleteError(_message(effect, f"{which} has no '{lacking[0]}'"))
    if law.effect.name != effect.name:
        which = f"{type(law).__name__} in {_file(effect)} says that it is of '{law.effect.name}'"
        raise IncompleteError(_message(effect, which))


def _message(effect: Effect, rule: str) -> str:
    declared = f"sandbox/model/effects/{effect.name}.py"
    return f"the effect '{effect.name}' is declared in {declared}, but {rule}"


def _file(effect: Effect) -> str:
    return f"{_ROOM.replace('.', '/')}/{effect.name}.py"


if _lacking := next(missing(EFFECTS.values()), None):
    raise IncompleteError(_lacking)
