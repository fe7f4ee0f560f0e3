"""The questions that a level allows."""

from sandbox.app.words.formatting import brief, name_in_words
from sandbox.app.words.language import later, say
from sandbox.model.expressions import Expression, Values
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
from sandbox.model.quantities import quantity
from sandbox.physics.measuring.grading import applies


def questions(level: Level, values: Values) -> tuple[Check, ...]:
    """Return the checks that apply and have an instant; if none has one, all at the end."""
    applying = [check for check in level.checks if applies(check, values)]
    timed = [check for check in applying if check.at is not None]
    if not timed:
        end = {"at": Expression(level.duration(values))}
        timed = [check.model_copy(update=end) for check in applying if check.quantity != "t"]
    return tuple({(check.quantity, check.at): check for check in reversed(timed)}.values())[::-1]


def when(at: Instant | None) -> str:
    """Return a description of an instant."""
    match at:
        case ApexEvent(body=body):
            return say("when {body} stops rising", body=name_in_words(body))
        case LandingEvent(body=body):
            return say("when {body} lands", body=name_in_words(body))
        case ContactEvent(bodies=bodies, nth=nth):
            a, b = map(name_in_words, bodies)
            return say("just after {a} and {b} meet", a=a, b=b) + _again(nth)
        case SeparationEvent(bodies=bodies, nth=nth):
            a, b = map(name_in_words, bodies)
            return say("when {a} and {b} part", a=a, b=b) + _again(nth)
        case CrossingEvent(quantity=name, value=value):
            message = later("when {quantity} first comes to {value}")
            return say(message, quantity=name, value=value.source)
        case Expression(source=time):
            return say("at t = {t} s", t=brief(time) if isinstance(time, float) else time)
    return ""


def _again(nth: int) -> str:
    if nth > 3:
        return say(", the {nth}th time", nth=nth)
    return ("", say(", the second time"), say(", the third time"))[nth - 1]


def unit_of(check: Check, level: Level) -> str:
    """Return the SI unit of the predicted quantity; empty if it has none."""
    return quantity(check.quantity, level).unit
