"""Switching effects off and on: the changed level runs over the original."""

from collections.abc import Sequence
from dataclasses import replace

from sandbox.app.drawing.theme import Color
from sandbox.app.runs.companion_runs import NONE, Changes, Variant
from sandbox.app.runs.session import Session
from sandbox.app.words import formatting, level_translation
from sandbox.app.words.language import later, say
from sandbox.model.effects.contract import Settings
from sandbox.model.level import Level, Scheme, Stepping
from sandbox.model.levels_with_changed_effects import DEFAULTS, vary
from sandbox.model.scheme_requirements import unsmooth
from sandbox.physics.measuring.run_comparison import Difference, differences

DECLARED = later("as the level declares it")


def toggle(session: Session, effect: str) -> None:
    """Switch an effect off or on, and restart the comparison.

    Raises `SandboxError` if the changed level is invalid, or cannot run; nothing is changed then.
    """
    changes = session.changes
    if effect in session.original.effects.declared:
        changes = replace(changes, off=_without(changes.off, effect))
    else:
        changes = replace(changes, on=_without(changes.on, effect))
    change(session, changes)


def strengthen(session: Session, effect: str, times: float) -> None:
    """Scale an effect that was switched on, and restart the comparison; see `toggle`."""
    before = session.changes.strength
    strength = {**before, effect: before.get(effect, 1.0) * times}
    change(session, replace(session.changes, strength=strength))


def _without(names: tuple[str, ...], name: str) -> tuple[str, ...]:
    return tuple(n for n in names if n != name) if name in names else (*names, name)


def change(session: Session, changes: Changes) -> None:
    """Play the level with some effects off and others on; see `toggle`.

    Both runs have the same scheme, so that only the effects differ: the level's, or leapfrog if the
    changed level does not allow that.
    """
    original = declared_with_present_stepping(session)
    if not (changes.off or changes.on):
        session.play_as(original)
        return
    play_over(session, *changed(original, changes))


def changed(original: Level, changes: Changes) -> tuple[Level, Level, Changes]:
    """Return a level and the changed one, with the same scheme, and the changes with their effects.

    Raises `EffectError` if the changed level is invalid.
    """
    wanted = original.stepping.scheme
    level, effects = vary(with_scheme(original, "leapfrog"), changes.off, _settings(changes))
    left = wanted if original.stepping.is_composed and unsmooth(level) else None
    scheme = "leapfrog" if left else wanted
    changes = replace(changes, effects=effects, replaced_scheme=left)
    return with_scheme(original, scheme), with_scheme(level, scheme), changes


def reset(session: Session) -> str:
    """Play the level as declared, and return the message."""
    if not session.changes:
        return say("no effect is changed")
    change(session, NONE)
    return say("all effects are as the level declares them")


def rows(session: Session) -> list[tuple[Color | None, str]]:
    """Return the changed run and the original, with their colours; none if nothing is changed."""
    if not session.changes:
        return []
    original = session.companions[0].variant
    return [(None, session.changes.label), (original.color, say(original.label))]


def with_scheme(level: Level, scheme: Scheme) -> Level:
    """Return a level with another scheme."""
    stepping = level.stepping.model_copy(update={"scheme": scheme})
    return level.model_copy(update={"stepping": stepping})


def play_over(session: Session, original: Level, level: Level, changes: Changes) -> None:
    """Play a changed level over the original, whose formulas do not describe it."""
    unjudged = level.model_copy(update={"checks": (), "ghosts": {}})
    session.play_as(unjudged, [Variant(DECLARED, original, 0)], changes)


def play_with_stepping(session: Session, stepping: Stepping) -> None:
    """Play with another stepping, together with the compared run; a race ends.

    Raises `SandboxError` if it cannot run; nothing is changed then.
    """
    pace = {"stepping": stepping}
    variants = (companion.variant for companion in session.companions if session.changes)
    beside = [replace(each, level=each.level.model_copy(update=pace)) for each in variants]
    changes = replace(session.changes, replaced_scheme=None)
    session.play_as(session.begun_as.model_copy(update=pace), beside, changes)


def declared_with_present_stepping(session: Session) -> Level:
    """Return the level as declared in its file, with the stepping of the present run.

    A scheme that was replaced because of an effect is restored.
    """
    stepping = session.world.stepping
    level = session.original.model_copy(update={"stepping": stepping})
    return with_scheme(level, session.changes.replaced_scheme or stepping.scheme)


def _settings(changes: Changes) -> dict[str, Settings]:
    return {
        name: {
            field_name: _times(value, changes.strength.get(name, 1.0))
            for field_name, value in DEFAULTS[name].items()
        }
        for name in changes.on
    }


def _times(value: object, factor: float) -> object:
    """Return a number, or a list of numbers, times a factor, to four significant digits."""
    if isinstance(value, list):
        return [_times(part, factor) for part in value]
    if not isinstance(value, int | float):
        return value
    scaled = float(f"{value * factor:.4g}")
    return int(scaled) if scaled.is_integer() else scaled


def addable(level: Level) -> list[str]:
    """Return the effects that a level does not declare, and that can be tried without settings."""
    return [name for name in DEFAULTS if name not in level.effects.declared]


def compared(session: Session) -> tuple[Difference, ...]:
    """Return the differences between the run and the original so far."""
    return differences(session.companions[0].trace, session.trace)


def cost(session: Session) -> float | None:
    """Return the cost of the change in each step [s], negative if it saves; None if unknown."""
    own, other = session.clock.step_time, session.companions[0].clock.step_time
    return None if own is None or other is None else own - other


def summary(session: Session, found: Sequence[Difference]) -> str:
    """Return a sentence about the differences by the change, and its cost."""
    lines = list(formatting.summary(found, level_translation.of(session.original)))
    seconds = cost(session)
    if seconds is not None:
        lines.append(formatting.step_cost(seconds))
    text = f"{session.changes.label}: {', '.join(lines) or say(formatting.NO_DIFFERENCE)}"
    return text.replace(" -", f" {formatting.MINUS}")
