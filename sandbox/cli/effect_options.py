"""`--without` and `--with`: a level with fewer or more effects."""

import json
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from sandbox.app.words import formatting
from sandbox.cli.argument_parsing import UsageError
from sandbox.cli.text_columns import aligned
from sandbox.model import levels_with_changed_effects
from sandbox.model.errors import brief
from sandbox.model.level import Level, Stepping
from sandbox.model.levels_with_changed_effects import Variation
from sandbox.physics.measuring.csv_export import Change
from sandbox.physics.measuring.run_comparison import Difference

_HEADER = ("quantity", "as declared", "changed", "difference")


class Varied(NamedTuple):
    """A level with some effects switched off or on."""

    level: Level
    change: Change
    variations: tuple[Variation, ...]


def vary(
    level: Level, off: Sequence[str], on: Sequence[str], stepping: Stepping | None = None
) -> Varied | None:
    """Return a level with some effects switched off, then others on; None if none are given.

    The level gets the stepping, if one is given: other schemes allow other effects. Raises
    `EffectError` if the effects do not fit the level. Raises `UsageError` if an option is invalid.
    """
    if not (off or on):
        return None
    settings = _settings(on)
    both = next((name for name in off if name in settings), None)
    if both is not None:
        raise UsageError(f"--without {both}: '{both}' is asked for by --with, too")
    run = level if stepping is None else level.model_copy(update={"stepping": stepping})
    changed, variations = levels_with_changed_effects.vary(run, off, settings)
    options = [*(word for name in off for word in ("--without", name))]
    options += [word for text in on for word in ("--with", text)]
    description = ", ".join(map(str, variations))
    return Varied(changed, Change(level, description, tuple(options)), variations)


def _settings(texts: Sequence[str]) -> dict[str, dict[str, object]]:
    """Return the settings of the effects to switch on, from NAME or NAME.FIELD=VALUE."""
    found: dict[str, dict[str, object]] = {}
    for text in texts:
        place, equals, value = text.partition("=")
        name, dot, field = place.strip().partition(".")
        if not name or bool(dot) is not bool(equals) or (dot and not field):
            rule = "must be EFFECT or EFFECT.SETTING=VALUE, such as drag.linear=0.1"
            raise UsageError(f"--with {brief(text)}: {rule}")
        fields = found.setdefault(name, {})
        if field in fields:
            raise UsageError(f"--with {brief(text)}: '{brief(place)}' is set twice")
        if dot:
            fields[field] = _value(value.strip())
    return found


def _value(text: str) -> object:
    """Return a setting as in a level file; a text that is not JSON is an expression or a name."""
    try:
        return json.loads(text)
    except ValueError:
        return text


def differences(found: Sequence[Difference]) -> Iterator[str]:
    """Yield a header and one line per difference, in columns."""
    yield from aligned([_HEADER, *(row(difference) for difference in found)])


def row(difference: Difference) -> tuple[str, ...]:
    """Return the quantity, the two values, and their difference."""
    values = (_number(v, difference.unit) for v in (difference.first, difference.second))
    return (about(difference), *values, formatting.difference(difference))


def _number(value: float | None, unit: str) -> str:
    return "never comes" if value is None else f"{value:.6g} {unit}"


def about(difference: Difference) -> str:
    """Return the quantity of a difference, with its instant."""
    label, quantity = difference.label, difference.quantity
    return f"{quantity} ({label})" if label else quantity
