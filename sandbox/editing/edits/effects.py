"""Declaring and removing effects, and their cost."""

from collections.abc import Iterator, Mapping
from contextlib import suppress
from functools import partial
from typing import Any, get_args, get_origin

from sandbox.editing.cleanup_after_edit import COEFFICIENTS, accepted, without_meaning
from sandbox.editing.text_patches import Changes, put, put_all, remove
from sandbox.model.did_you_mean import suggestion
from sandbox.model.effects import EFFECTS, Effects
from sandbox.model.errors import SandboxError
from sandbox.model.level import Level
from sandbox.model.levels_with_changed_effects import DEFAULTS, including, without
from sandbox.physics.measuring.step_timing import brief_costs
from sandbox.physics.run import build

COEFFICIENT = 0.5
"""The default coefficient of a dynamic body; others get 1, which keeps that of the other body."""

BESIDE = ("contact", "rotation")
"""The effects that others require, and that need no settings."""


def declare(text: str, level: Level, effect: str, settings: Mapping[str, Any] | None = None) -> str:
    """Return a level that declares an effect, with the contact, rotation or coefficients it needs.

    The settings are its fields, as in a file; by default those of the app. If the effect may be
    declared several times, another is added. Raises `SandboxError` if there is no such effect, it
    needs settings, or the level contradicts it.
    """
    if effect not in EFFECTS:
        raise SandboxError(
            "unknown effect '{name}'{hint}",
            name=effect,
            hint=suggestion(effect, EFFECTS, longest=20),
        )
    declared = getattr(level.effects, effect)
    if declared is not None and not isinstance(declared, tuple):
        raise SandboxError("the level already declares '{effect}'", effect=effect)
    if settings is None and effect not in DEFAULTS:
        raise SandboxError("'{effect}' has to be told what it is", effect=effect)
    fields = settings if settings is not None else _trial(effect)
    index = (len(declared or ()),) if _several(effect) else ()
    form = _with_coefficients(put(text, ("effects", effect, *index), fields), level, effect)
    lacking = (each for each in BESIDE if each not in level.effects.declared)
    return accepted(form, *(put(form, ("effects", each), {}) for each in lacking))


def drop(text: str, level: Level, effect: str) -> str:
    """Return a level without an effect, and without parts that then have no meaning.

    Raises `SandboxError` if the level does not declare it.
    """
    if effect not in level.effects.declared:
        hint = suggestion(effect, level.effects.declared)
        raise SandboxError(
            "the level declares no effect '{effect}'{hint}", effect=effect, hint=hint
        )
    return without_meaning(remove(text, ("effects", effect)))


def costs(level: Level) -> Iterator[tuple[str, float]]:
    """Yield what each effect costs, or would cost, in a step [s]; measured, within seconds.

    Effects without which the level is invalid, or with which it cannot run, are left out.
    """
    for effect in EFFECTS:
        with suppress(SandboxError):
            yield effect, _cost(level, effect)


def _cost(level: Level, effect: str) -> float:
    declared = effect in level.effects.declared
    other = without(level, effect)[0] if declared else including(level, effect, {})
    pair = (other, level) if declared else (level, other)
    before, after = brief_costs(*(partial(build, each) for each in pair))
    return after - before


def _several(effect: str) -> bool:
    """Return whether an effect may be declared several times, in a list."""
    kind = get_args(Effects.model_fields[effect].annotation)[0]
    return get_origin(get_args(kind)[0] if get_args(kind) else kind) is tuple


def _trial(effect: str) -> dict[str, Any]:
    """Return the default settings of an effect, without a coefficient, which the bodies have."""
    return {key: value for key, value in DEFAULTS[effect].items() if key != "coefficient"}


def _with_coefficients(text: str, level: Level, effect: str) -> str:
    """Return a level in which every body has the coefficient that an effect needs."""
    if effect not in COEFFICIENTS:
        return text
    changes = Changes()
    for name, body in level.bodies.items():
        changes["bodies", name, effect] = COEFFICIENT if body.type == "dynamic" else 1
    return put_all(text, changes)
