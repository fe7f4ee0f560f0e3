"""Formats numbers, times and settings as text."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from math import ceil, degrees, floor, inf, isclose, isfinite, log10
from typing import TYPE_CHECKING

from sandbox.app.words import language, level_translation
from sandbox.app.words.language import later, plural, say
from sandbox.app.words.level_translation import Say
from sandbox.model.level import (
    ApexEvent,
    Check,
    ContactEvent,
    CrossingEvent,
    LandingEvent,
    SeparationEvent,
    Stepping,
)
from sandbox.model.levels_with_changed_effects import Variation, shown
from sandbox.physics.measuring.challenge_goals import Outcome
from sandbox.physics.measuring.run_comparison import Difference

if TYPE_CHECKING:
    from sandbox.physics.accuracy.candidate_settings import Offer
    from sandbox.physics.accuracy.requested_accuracy import Setting
    from sandbox.physics.accuracy.trusted_digits import Trust

MINUS = "−"
RAISED = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
"""The digits of an exponent."""
ROUNDING = 1e-12
"""A value below this fraction of a scale counts as a rounding error."""
NO_DIFFERENCE = later("no difference")
SCHEMES: Mapping[str, str] = {
    "leapfrog": later("leapfrog"),
    "symplectic-euler": later("symplectic Euler"),
    "explicit-euler": later("explicit Euler"),
    "fourth-order": later("fourth order"),
    "sixth-order": later("sixth order"),
    "eighth-order": later("eighth order"),
}


def number(value: float, digits: int = 5, *, all_count: bool = False) -> str:
    """Format a number with some significant digits, and a power of ten if it needs one.

    A number from 1e3 to 1e5 with fewer digits than places is rounded, 8170; if `all_count`, so
    that no digit is shown that does not count, it has a power of ten, 8.17×10³.
    """
    if not isfinite(value):
        return "–" if value != value else ("∞" if value > 0 else f"{MINUS}∞")
    if value == 0:
        return "0"
    if 1e-3 <= abs(value) < 1e5:
        text = f"{value:#.{digits}g}".rstrip(".")
        if "e" in text and not all_count:
            text = f"{float(text):.0f}"
    else:
        text = f"{value:.{max(digits - 3, 0)}e}"
    return _typeset(text)


def brief(value: float) -> str:
    """Format a number without needless zeros, as at a tick of an axis."""
    return _typeset(f"{value:.5g}")


def without_rounding(value: float, scale: float) -> float:
    """Return a value, or 0 if it is only a rounding error relative to a scale."""
    return 0.0 if abs(value) < ROUNDING * scale else value


def error(value: float) -> str:
    """Format an error with one significant digit, since only its magnitude matters."""
    if value == 0 or not isfinite(value):
        return number(value)
    return _typeset(f"{value:.1g}" if 1e-3 <= abs(value) < 10 else f"{value:.0e}")


def share(value: float) -> str:
    """Format a fraction, in per cent unless it is very small or large."""
    return f"{100 * value:.1f} %".replace("-", MINUS) if 1e-3 <= abs(value) < 1e4 else error(value)


def quantity(value: float, unit: str, digits: int = 5, *, all_count: bool = False) -> str:
    """Format a number with its unit, see `number`; radians are shown in degrees."""
    return _in_unit(value, unit, partial(number, digits=digits, all_count=all_count))


def _in_unit(value: float, unit: str, write: Callable[[float], str]) -> str:
    """Format a number by a function, and append its unit; radians are shown in degrees."""
    if unit.startswith("rad"):
        return f"{write(degrees(value))}{shown_unit(unit)}"
    return f"{write(value)} {unit}".rstrip()


def shown_unit(unit: str) -> str:
    """Return the unit in which values of a unit are shown: degrees for radians."""
    return unit.replace("rad", "°")


def name_in_words(name: str) -> str:
    """Return the name of a body or joint as it is read: rear axle 2, not rear_axle2."""
    return level_translation.name_in(language.used(), name)


def bounds(outcome: Outcome) -> str:
    """Format the bounds of a goal: the lower, the upper, or both."""
    least, most = (_in_unit(bound, outcome.unit, brief) for bound in (outcome.lower, outcome.upper))
    if outcome.lower == -inf:
        return say("at most {most}", most=most)
    if outcome.upper == inf:
        return say("at least {least}", least=least)
    return say("{least} to {most}", least=least, most=most)


def measured(value: float, expected: float, unit: str) -> str:
    """Format a measured value; one that differs from the expected by rounding looks the same."""
    return quantity(expected if isclose(value, expected, rel_tol=1e-9) else value, unit)


def with_unit(text: str, unit: str) -> str:
    """Append a unit to a number; degrees are written as ° without a space."""
    return f"{text}°" if unit == "deg" else f"{text} {unit}".rstrip()


def with_unit_in_brackets(name: str, unit: str) -> str:
    """Format the heading of a column; radians are shown in degrees."""
    return f"{name} [{shown_unit(unit)}]" if unit else name


def setting(value: float) -> str:
    """Format a parameter as one would type it."""
    return f"{value:.7g}"


def seconds(value: float) -> str:
    """Format a time with two decimals."""
    return f"{value:.2f} s"


def span(value: float) -> str:
    """Format an approximate duration in seconds, minutes or hours, rounded up.

    >>> span(3.2), span(200), span(8000)
    ('4 s', '4 min', '3 h')
    """
    for size, unit in ((3600, "h"), (60, "min")):
        if value > 2 * size:
            return f"{ceil(value / size)} {unit}"
    return f"{ceil(value)} s"


def nice(value: float) -> float:
    """Return the largest of …, 0.1, 0.2, 0.5, 1, 2, 5, … that is at most a positive value."""
    power = 10.0 ** floor(log10(value))
    return next(m * power for m in (5.0, 2.0, 1.0, 0.5) if m * power <= value * (1 + 1e-12))


def rounded_up(value: float) -> float:
    """Return the smallest of …, 0.1, 0.2, 0.5, 1, 2, 5, … that is at least a value.

    0 if the value is not positive, or not finite.
    """
    if value <= 0 or not isfinite(value):
        return 0.0
    below = nice(value)
    return below if below >= value * (1 - 1e-9) else nice(2.5 * below)


def scheme(name: str) -> str:
    """Return the translated name of a scheme."""
    return say(SCHEMES.get(name, name))


def moment_in_words(check: Check) -> str:
    """Describe the moment at which a check can first be made."""
    match check.at:
        case None:
            return say("the first step")
        case ApexEvent(body=body):
            return say("the apex of {body}", body=name_in_words(body))
        case LandingEvent(body=body):
            return say("the landing of {body}", body=name_in_words(body))
        case ContactEvent(bodies=bodies, nth=nth):
            a, b = map(name_in_words, bodies)
            return say("{a} to meet {b}", a=a, b=b) + _times(nth)
        case SeparationEvent(bodies=bodies, nth=nth):
            a, b = map(name_in_words, bodies)
            return say("{a} to part from {b}", a=a, b=b) + _times(nth)
        case CrossingEvent(quantity=name, value=value):
            return say("{quantity} to cross {value}", quantity=name, value=value.source)
        case time:
            return f"t = {time.source} s"


def _times(nth: int) -> str:
    return say(" {nth} times", nth=nth) if nth > 1 else ""


def event_in_words(check: Check) -> str:
    """Describe in a word or two the event that a check waits for."""
    match check.at:
        case ApexEvent():
            return say("at apex")
        case LandingEvent():
            return say("landing")
        case ContactEvent():
            return say("contact")
        case SeparationEvent():
            return say("parting")
        case CrossingEvent():
            return say("crossing")
        case _:
            return say("later")


def difference(found: Difference) -> str:
    """Format the difference between two runs, relative to the first if that makes sense."""
    if found.fraction == 0:
        return say(NO_DIFFERENCE)
    if found.first is None or found.second is None:
        return say("comes") if found.first is None else say("never comes")
    if found.relative is not None and abs(found.relative) < 10:
        return f"{100 * found.relative:+.3g} %"
    return f"{found.second - found.first:+.3g} {found.unit}"


def step_cost(seconds: float) -> str:
    """Format the difference in the cost of a step."""
    return say("{cost:+.2g} ms a step", cost=round(1e3 * seconds, 4))


def variations(found: Iterable[Variation]) -> str:
    """Describe how the effects of a level were changed."""
    return ", ".join(map(_variation, found))


def _variation(found: Variation) -> str:
    effect = say(found.effect)
    if found.settings is None:
        if not found.gone:
            return say("without {effect}", effect=effect)
        removed = ", ".join(map(say, found.gone))
        return say("without {effect} (and so without {others})", effect=effect, others=removed)
    settings = ", ".join(f"{say(field)} {shown(value)}" for field, value in found.settings.items())
    if not settings:
        return say("with {effect}", effect=effect)
    return say("with {effect} ({settings})", effect=effect, settings=settings)


def summary(found: Sequence[Difference], words: Say) -> Iterator[str]:
    """Yield a short text for each quantity that a change of effects alters."""
    for label, one in {words(each.label) or each.quantity: each for each in found}.items():
        if one.fraction:
            yield f"{label} {difference(one)}"


def offered_setting(setting: "Setting") -> str:
    """Describe the setting that reaches an accuracy, or the best one possible in real time."""
    if setting.in_real_time is None:
        return f"{error(setting.target)}: {_setting_in_words(setting.for_playing)}"
    return say(
        "{error} is not possible in real time: 1 s takes {cost:.2g} s of computing."
        " Instead: {offer}",
        error=error(setting.target),
        cost=setting.for_drawing.cost,
        offer=_setting_in_words(setting.in_real_time),
    )


def stepping(chosen: Stepping) -> str:
    """Describe a stepping: scheme and rate, and the solver of contacts if one is chosen."""
    name, rate = scheme(chosen.scheme), chosen.rate
    if chosen.solver == "direct":
        return say("{scheme} at {rate:g} Hz, contacts solved directly", scheme=name, rate=rate)
    return say("{scheme} at {rate:g} Hz", scheme=name, rate=rate)


def _setting_in_words(found: "Offer") -> str:
    return say(
        "{setting}, error {error}, {cost:.3g} ms of computing for 1 s",
        setting=stepping(found.stepping),
        error=error(found.error),
        cost=1e3 * found.cost,
    )


def trusted(found: "Trust") -> str:
    """Describe how many digits of a quantity hold in a run, and until when it is predictable."""
    message = plural("{count} digit holds", "{count} digits hold", found.digits)
    if not found.digits:
        message = say("no digit holds")
    if found.until is None:
        return message
    return say("{digits}; predictable until t = {t}", digits=message, t=seconds(found.until))


def next_digit(found: "Trust") -> str:
    """Describe what another digit of a quantity takes; empty if all that are shown hold."""
    from sandbox.physics.accuracy.trusted_digits import MOST_DIGITS

    if found.digits >= MOST_DIGITS or not found.off:
        return ""
    if found.next_digit is None:
        return say("a smaller step does not give the next digit")
    return say("the next digit takes {times:.2g} times the computing", times=found.next_digit)


def trusted_value(value: float, off: float, unit: str) -> str:
    """Format a value that has an error, with only the digits that can be trusted."""
    from sandbox.physics.accuracy.trusted_digits import certain_digits

    scale = degrees(1) if unit.startswith("rad") else 1.0
    digits = certain_digits(scale * value, scale * off)
    return quantity(value if digits else 0.0, unit, digits or 1, all_count=True)


def _typeset(text: str) -> str:
    """Write a number as it is printed: −2×10³, not -2e+03, and 10⁻⁵, not 1e-05."""
    mantissa, _, exponent = text.partition("e")
    if exponent:
        shown = mantissa.rstrip(".")
        factor = {"1": "", "-1": MINUS}.get(shown, f"{shown}×")
        text = f"{factor}10{str(int(exponent)).translate(RAISED)}"
    return text.replace("-", MINUS)
