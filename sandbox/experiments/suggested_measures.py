"""The measures that a level suggests, in the form of an experiment's file."""

from collections.abc import Iterable

from sandbox.model.expressions import Expression
from sandbox.model.level import (
    ApexEvent,
    Check,
    ContactEvent,
    CrossingEvent,
    Instant,
    LandingEvent,
    Level,
    SeparationEvent,
)


def measures(level: Level, quantities: Iterable[str]) -> list[str]:
    """Return the measures of a level's checks, then quantities at the end and their maxima."""
    checked = [of_check(c) for c in level.checks if c.at is not None]
    always = [c.quantity for c in level.checks if c.at is None]
    names = list(quantities)
    ends = [f"{name}@end" for name in (*always, *names)]
    return list(dict.fromkeys([*checked, *ends, *(f"max({name})" for name in names)]))


def of_check(check: Check) -> str:
    """Return what a check measures; at the end of the run if it is made at every step."""
    return f"{check.quantity}@{'end' if check.at is None else as_text(check.at)}"


def as_text(at: Instant) -> str:
    """Return an instant as it is written in a measure."""
    match at:
        case LandingEvent():
            return f"landing({at.body}, {_typed(at.height)})"
        case ApexEvent():
            return f"apex({at.body})"
        case ContactEvent() | SeparationEvent():
            nth = [str(at.nth)] if at.nth > 1 else []
            return f"{at.event}({', '.join([*at.bodies, *nth])})"
        case CrossingEvent():
            return f"crossing({at.quantity}, {_typed(at.value)}, {at.direction})"
        case _:
            return _typed(at)


def _typed(expression: Expression) -> str:
    """Return a number or a formula as a person would type it."""
    source = expression.source
    return source if isinstance(source, str) else repr(source).removesuffix(".0")
