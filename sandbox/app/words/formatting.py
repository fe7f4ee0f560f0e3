"""Numbers, times and settings, formatted for a person to read."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from math import ceil, degrees, floor, inf, isclose, isfinite, log10

from sandbox.app.words.language import later, plural, say
from sandbox.app.words.level_words import Say
from sandbox.model.effect_variants import Variation, shown
from sandbox.model.level import (
    ApexEvent,
    Check,
    ContactEvent,
    CrossingEvent,
    LandingEvent,
    SeparationEvent,
    Stepping,
)
from sandbox.physics.accuracy.calibration import Setting
from sandbox.physics.accuracy.candidates import Offer
from sandbox.physics.accuracy.trusted_digits import Trust, surviving
from sandbox.physics.measuring.comparison import Difference
from sandbox.physics.measuring.goals import Outcome

MINUS = "−"
ROUNDING = 1e-12
"""The share of a scale below which a value counts as rounding."""
NO_DIFFERENCE = later("no difference")
SCHEMES: Mapping[str, str] = {
    "leapfrog": later("leapfrog"),
    "symplectic-euler": later("symplectic Euler"),
    "explicit-euler": later("explicit Euler"),
    "fourth-order": later("fourth order"),
}


def number(value: float, digits: int = 5) -> str:
    """Write a number with that many significant digits, with a power of ten where it needs one."""
    if not isfinite(value):
        return "–" if value != value else ("∞" if value > 0 else f"{MINUS}∞")
    if value == 0:
        return "0"
    if 1e-3 <= abs(value) < 1e5:
        text = f"{value:#.{digits}g}".rstrip(".")
    else:
        text = f"{value:.{max(digits - 3, 0)}e}"
    return (_power(text) if "e" in text else text).replace("-", MINUS)


def without_rounding(value: float, scale: float) -> float:
    """Return a value, or 0 if it is only rounding relative to a scale."""
    return 0.0 if abs(value) < ROUNDING * scale else value


def error(value: float) -> str:
    """Write an error with one significant digit: it is its size that counts."""
    if value == 0 or not isfinite(value):
        return number(value)
    return _power(f"{value:.0e}").replace("-", MINUS)


def share(value: float) -> str:
    """Write a part of a whole: in per cent where it is large enough to be read so."""
    return f"{100 * value:.1f} %".replace("-", MINUS) if 1e-3 <= abs(value) < 1e4 else error(value)


def quantity(value: float, unit: str, digits: int = 5) -> str:
    """Write a number with its unit; what is kept in radians is read in degrees."""
    if unit.startswith("rad"):
        return f"{number(degrees(value), digits)}{unit.replace('rad', '°')}"
    return f"{number(value, digits)} {unit}".rstrip()


def bounds(outcome: Outcome) -> str:
    """Write what a goal asks for: the least, the most, or both."""
    least, most = (quantity(bound, outcome.unit, 4) for bound in (outcome.least, outcome.most))
    if outcome.least == -inf:
        return say("at most {most}", most=most)
    if outcome.most == inf:
        return say("at least {least}", least=least)
    return say("{least} to {most}", least=least, most=most)


def measured(value: float, expected: float, unit: str) -> str:
    """Format a measurement, so that two that differ by rounding look the same."""
    return quantity(expected if isclose(value, expected, rel_tol=1e-9) else value, unit)


def with_unit(text: str, unit: str) -> str:
    """Put a unit behind a number; a degree is written ° and close to it."""
    return f"{text}°" if unit == "deg" else f"{text} {unit}".rstrip()


def with_unit_in_brackets(name: str, unit: str) -> str:
    """Head a column: what is kept in radians is read in degrees."""
    return f"{name} [{unit.replace('rad', '°')}]" if unit else name


def setting(value: float) -> str:
    """Write a parameter as a person would type it."""
    return f"{value:.7g}"


def seconds(value: float) -> str:
    """Write a time with two decimals."""
    return f"{value:.2f} s"


def span(value: float) -> str:
    """Write about how long something takes: in seconds, minutes or hours, rounded up.

    >>> span(3.2), span(200), span(8000)
    ('4 s', '4 min', '3 h')
    """
    for size, unit in ((3600, "h"), (60, "min")):
        if value > 2 * size:
            return f"{ceil(value / size)} {unit}"
    return f"{ceil(value)} s"


def nice(value: float) -> float:
    """Return the largest of …, 0.1, 0.2, 0.5, 1, 2, 5, … that is not above a positive value."""
    power = 10.0 ** floor(log10(value))
    return next(m * power for m in (5.0, 2.0, 1.0, 0.5) if m * power <= value * (1 + 1e-12))


def rounded_up(value: float) -> float:
    """Return the smallest of …, 0.1, 0.2, 0.5, 1, 2, 5, … that is not below a value; 0 if none is.

    What is not positive, or has no end, has none.
    """
    if value <= 0 or not isfinite(value):
        return 0.0
    below = nice(value)
    return below if below >= value * (1 - 1e-9) else nice(2.5 * below)


def scheme(name: str) -> str:
    """Write the name of a scheme."""
    return say(SCHEMES.get(name, name))


def moment(check: Check) -> str:
    """Name the moment at which a check can be made for the first time."""
    match check.at:
        case None:
            return say("the first step")
        case ApexEvent(body=body):
            return say("the apex of {body}", body=body)
        case LandingEvent(body=body):
            return say("the landing of {body}", body=body)
        case ContactEvent(bodies=(a, b), nth=nth):
            return say("{a} to meet {b}", a=a, b=b) + _times(nth)
        case SeparationEvent(bodies=(a, b), nth=nth):
            return say("{a} to part from {b}", a=a, b=b) + _times(nth)
        case CrossingEvent(quantity=name, value=value):
            return say("{quantity} to cross {value}", quantity=name, value=value.source)
        case time:
            return f"t = {time.source} s"


def _times(nth: int) -> str:
    return say(" {nth} times", nth=nth) if nth > 1 else ""


def occasion(check: Check) -> str:
    """Name in a word or two what a check waits for."""
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
    """Write how two runs differ: as a share if there is something to compare it with."""
    if found.share == 0:
        return say(NO_DIFFERENCE)
    if found.before is None or found.after is None:
        return say("comes") if found.before is None else say("never comes")
    if found.relative is not None and abs(found.relative) < 10:
        return f"{100 * found.relative:+.3g} %"
    return f"{found.after - found.before:+.3g} {found.unit}"


def step_cost(seconds: float) -> str:
    """Write what a step costs more or less."""
    return say("{cost:+.2g} ms a step", cost=round(1e3 * seconds, 4))


def variations(found: Iterable[Variation]) -> str:
    """Describe how the effects of a level were changed."""
    return ", ".join(map(_variation, found))


def _variation(found: Variation) -> str:
    effect = say(found.effect)
    if found.settings is None:
        if not found.gone:
            return say("without {effect}", effect=effect)
        gone = ", ".join(map(say, found.gone))
        return say("without {effect} (and so without {others})", effect=effect, others=gone)
    said = ", ".join(f"{say(field)} {shown(value)}" for field, value in found.settings.items())
    if not said:
        return say("with {effect}", effect=effect)
    return say("with {effect} ({settings})", effect=effect, settings=said)


def summary(found: Sequence[Difference], words: Say) -> Iterator[str]:
    """Yield what a change of effects does to each quantity of a level, in a few words."""
    for label, one in {words(each.label) or each.quantity: each for each in found}.items():
        if one.share:
            yield f"{label} {difference(one)}"


def offer(setting: Setting) -> str:
    """Write which setting reaches an accuracy, or what can be had instead."""
    if setting.in_real_time is None:
        return f"{error(setting.target)}: {_offer(setting.chosen)}"
    return say(
        "{error} is not possible in real time: 1 s takes {cost:.2g} s of computing."
        " Instead: {offer}",
        error=error(setting.target),
        cost=setting.chosen.cost,
        offer=_offer(setting.in_real_time),
    )


def stepping(chosen: Stepping) -> str:
    """Write how time advances: scheme and rate, and what solves contacts if that was chosen."""
    name, rate = scheme(chosen.scheme), chosen.rate
    if chosen.solver:
        return say("{scheme} at {rate:g} Hz, contacts solved directly", scheme=name, rate=rate)
    return say("{scheme} at {rate:g} Hz", scheme=name, rate=rate)


def _offer(found: Offer) -> str:
    return say(
        "{setting}, error {error}, {cost:.3g} ms of computing for 1 s",
        setting=stepping(found.stepping),
        error=error(found.error),
        cost=1e3 * found.cost,
    )


def trusted(found: Trust) -> str:
    """Write how many digits of a quantity hold throughout a run, and how far it is foretold."""
    message = plural("{count} digit holds", "{count} digits hold", found.digits)
    if not found.digits:
        message = say("no digit holds")
    if found.until is None:
        return message
    return say("{digits}; predictable until t = {t}", digits=message, t=seconds(found.until))


def certain(value: float, off: float, unit: str) -> str:
    """Format a number with an error, with the digits that can be trusted."""
    scale = degrees(1) if unit.startswith("rad") else 1.0
    digits = surviving(scale * value, scale * off)
    return quantity(value if digits else 0.0, unit, digits or 1)


def _power(text: str) -> str:
    """Write a power of ten without what says nothing: 2e3, not 2.e+03."""
    mantissa, _, exponent = text.partition("e")
    return f"{mantissa.rstrip('.')}e{int(exponent)}"
