"""Variants of a level, with one effect more or less.

A variant is a new level; nothing is changed in place. Effects that depend on one that is switched
off are switched off with it: friction needs contact.
"""

import json
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple, cast

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from sandbox.model import parser_error_messages
from sandbox.model.body import Body
from sandbox.model.did_you_mean import suggestion
from sandbox.model.effects import EFFECTS, Effects
from sandbox.model.effects.contract import Settings
from sandbox.model.errors import MisuseError, brief
from sandbox.model.events import ACTIONS
from sandbox.model.expression_compiler import ExpressionError
from sandbox.model.expressions import Expression
from sandbox.model.level import Level
from sandbox.model.level_parts import Fault
from sandbox.model.named_constants import define
from sandbox.model.rules.consistency import inconsistencies
from sandbox.model.rules.level_validation import faults
from sandbox.model.translatable_message import Message

DEFAULTS: Mapping[str, Settings] = {
    name: effect.trial for name, effect in EFFECTS.items() if effect.trial is not None
}
"""The settings of effects that are switched on by their name alone; other effects need settings."""

TOLD = ("parameters", "checks", "ghosts", "challenge")
"""The parts of a level that describe the expected outcome, which a variant may invalidate."""

_COEFFICIENTS: Mapping[str, type[Expression]] = {
    name: effect.coefficient for name, effect in EFFECTS.items() if effect.coefficient
}
"""The effects with a coefficient per body: 'coefficient' is that of every pair."""


class Variation(NamedTuple):
    """A change of one effect of a level."""

    effect: str
    gone: tuple[str, ...] = ()
    """the effects that were switched off with it"""
    settings: Settings | None = None
    """the settings with which it is switched on; None if it is switched off"""

    def __str__(self) -> str:
        if self.settings is None:
            also = f" (and so without {', without '.join(self.gone)})" if self.gone else ""
            return f"without {self.effect}{also}"
        values = ", ".join(f"{field} {shown(value)}" for field, value in self.settings.items())
        return f"with {self.effect}" + (f" ({values})" if values else "")


class EffectError(MisuseError):
    """An effect that cannot be switched off, or on, in this level."""


def without(level: Level, effect: str) -> tuple[Level, tuple[str, ...]]:
    """Return a level without an effect, and the effects that were switched off with it.

    Raises `EffectError` if the level does not declare the effect, or is impossible without it.
    """
    if effect not in level.effects.declared:
        hint = suggestion(effect, level.effects.declared)
        raise EffectError(
            "the level declares no effect '{effect}'{hint}", effect=brief(effect), hint=hint
        )
    changed, gone = _dropped(level, effect), [effect]
    while found := list(_scene_faults(changed)):
        name = next((str(fault.path[1]) for fault in found if fault.path[0] == "effects"), None)
        if name is not None:
            changed = _dropped(changed, name)
            gone.append(name)
        elif (silenced := _silenced(changed, found)) is not changed:
            changed = silenced
        else:
            changed = _cleared(changed, found, effect)
    return changed, tuple(name for name in level.effects.declared if name in gone[1:])


def _scene_faults(level: Level) -> Iterator[Fault]:
    """Yield the contradictions in the scene itself, ignoring its checks and texts."""
    return (fault for fault in inconsistencies(level) if fault.path[0] not in TOLD)


def _dropped(level: Level, effect: str) -> Level:
    return level.model_copy(update={"effects": level.effects.model_copy(update={effect: None})})


def _silenced(level: Level, found: list[Fault]) -> Level:
    """Remove from events what they can no longer switch, and events that then do nothing."""
    gone = {fault.path[1:4] for fault in found if fault.path[0] == "events"}
    events = {}
    for name, event in level.events.items():
        left = {
            field: tuple(
                part for i, part in enumerate(getattr(event, field)) if (name, field, i) not in gone
            )
            for field in ACTIONS
        }
        if any(left.values()):
            events[name] = event.model_copy(update=left)
    same = events == dict(level.events)
    return level if same else level.model_copy(update={"events": events})


def _cleared(level: Level, found: list[Fault], effect: str) -> Level:
    """Reset the fields of bodies that only the effect gave a meaning."""
    bodies = dict(level.bodies)
    for fault in found:
        if fault.path[0] != "bodies" or len(fault.path) < 3:
            path = ".".join(map(str, fault.path))
            raise EffectError(
                "without '{effect}' the level is impossible: {place}: {rule}",
                effect=effect,
                place=path,
                rule=fault.rule,
            )
        name, field = str(fault.path[1]), str(fault.path[2])
        default = Body.model_fields[field].default
        bodies[name] = bodies[name].model_copy(update={field: default})
    return level.model_copy(update={"bodies": bodies})


def including(level: Level, effect: str, settings: Settings) -> Level:
    """Return a level with one more effect, or with other settings of an effect that it declares.

    The settings are its fields, as in a file, or `DEFAULTS`; for an effect that is a list, the
    fields of every entry; for `friction` and `restitution`, the `coefficient` of every pair. Raises
    `EffectError` if there is no such effect or setting, or it contradicts the level.
    """
    if effect not in Effects.model_fields:
        hint = suggestion(effect, Effects.model_fields, longest=20)
        raise EffectError("unknown effect '{name}'{hint}", name=brief(effect), hint=hint)
    declared = effect in level.effects.declared
    if declared and not settings:
        raise EffectError(
            "the level already declares '{effect}'; change a setting of it, such as"
            " {effect}.{example}",
            effect=effect,
            example=_example(effect),
        )
    fields = dict(settings or DEFAULTS.get(effect, {}))
    coefficient = fields.pop("coefficient", None) if effect in _COEFFICIENTS else None
    changed = level.model_copy(update={"effects": _declaring(level, effect, fields)})
    if coefficient is not None:
        changed = _with_coefficient(changed, effect, coefficient)
    _require_no_new_fault(level, changed, effect)
    return changed


def _require_no_new_fault(level: Level, changed: Level, effect: str) -> None:
    known = set(faults(level))
    for fault in faults(changed):
        if fault not in known and fault.path[0] not in TOLD:
            path = ".".join(map(str, fault.path))
            raise EffectError(
                "'{effect}' is not possible here: {place}: {rule}",
                effect=effect,
                place=path,
                rule=fault.rule,
            )


def vary(
    level: Level, off: Sequence[str], on: Mapping[str, Settings]
) -> tuple[Level, tuple[Variation, ...]]:
    """Return a level with some effects switched off, then others on, and each change.

    Raises `EffectError` if the result would be impossible.
    """
    changed = level
    parts: list[Variation] = []
    for name in dict.fromkeys(off):
        if name in level.effects.declared and name not in changed.effects.declared:
            continue  # already switched off with another
        changed, gone = without(changed, name)
        parts.append(Variation(name, gone))
    for name, fields in on.items():
        changed = including(changed, name, fields)
        parts.append(Variation(name, settings=fields))
    return changed, tuple(parts)


def shown(value: object) -> str:
    """Return a setting as a person would type it."""
    return value if isinstance(value, str) else json.dumps(value)


def _example(effect: str) -> str:
    """Return an example of an effect's settings, as a person would type it."""
    for name, value in DEFAULTS.get(effect, {}).items():
        return f"{name}={json.dumps(value)}"
    return "...=..."


def _declaring(level: Level, effect: str, fields: Settings) -> Effects:
    """Return a level's effects with some fields of one of them set."""
    document = level.effects.model_dump(mode="json", exclude_none=True)
    before = document.get(effect, {})
    entries = before if isinstance(before, list) else [before]
    many = [{**entry, **fields} for entry in entries]
    for entry in (many,) if before is entries else (many[0], many):
        try:
            made = Effects.model_validate_json(json.dumps({**document, effect: entry}))
            define(made, level.constants)
            return made
        except ValidationError as error:
            detail = error.errors(include_url=False)[0]
            if detail["type"] != "tuple_type" or len(detail["loc"]) > 1:
                raise EffectError(_in_words(effect, detail)) from error
    raise AssertionError(effect)  # one of the two forms is valid


def _in_words(effect: str, detail: ErrorDetails) -> Message:
    """Return a message about wrong settings of an effect."""
    place = ".".join(str(step) for step in detail["loc"] if not isinstance(step, int))
    shown = cast("ErrorDetails", {**detail, "loc": ("effects", *detail["loc"])})
    if detail["type"] == "missing" and isinstance(detail["loc"][-1], str):
        return Message(
            "'{effect}' needs a setting: {effect}.{field}=...",
            effect=effect,
            field=detail["loc"][-1],
        )
    return Message("{place}: {rule}", place=place, rule=parser_error_messages.rule(shown))


def _with_coefficient(level: Level, effect: str, coefficient: object) -> Level:
    """Give every body the square root of a coefficient, so that each pair has the product."""
    kind = _COEFFICIENTS[effect]
    if not isinstance(coefficient, int | float | str):
        raise EffectError("{effect}.coefficient: must be a number or an expression", effect=effect)
    try:
        root = kind(f"sqrt({kind(coefficient).source})")
    except ExpressionError as error:
        raise EffectError(
            "{effect}.coefficient: {error}", effect=effect, error=error.message
        ) from error
    bodies = {name: body.model_copy(update={effect: root}) for name, body in level.bodies.items()}
    for body in bodies.values():
        define(body, level.constants)
    pairless = level.effects.model_copy(
        update={effect: getattr(level.effects, effect).model_copy(update={"pairs": ()})}
    )
    return level.model_copy(update={"bodies": bodies, "effects": pairless})
