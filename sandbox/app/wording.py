"""How numbers and moments are put for a person to read."""

from math import degrees, floor, isclose, isfinite, log10

from sandbox.model.level import ApexEvent, Check, ContactEvent, CrossingEvent, LandingEvent

MINUS = "−"


def number(value: float, digits: int = 5) -> str:
    """Write a number with that many significant digits, with a power of ten where it needs one."""
    if not isfinite(value):
        return "–" if value != value else ("∞" if value > 0 else f"{MINUS}∞")
    if value == 0:
        return "0"
    if 1e-3 <= abs(value) < 1e5:
        text = f"{value:#.{digits}g}".rstrip(".")
    else:
        text = _power(f"{value:.{digits - 3}e}")
    return text.replace("-", MINUS)


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


def measured(value: float, expected: float, unit: str) -> str:
    """Write what was measured; what differs by rounding alone is not rounded another way."""
    return quantity(expected if isclose(value, expected, rel_tol=1e-9) else value, unit)


def with_unit(text: str, unit: str) -> str:
    """Put a unit behind a number; a degree is written ° and close to it."""
    return f"{text}°" if unit == "deg" else f"{text} {unit}".rstrip()


def setting(value: float) -> str:
    """Write a parameter as a person would type it."""
    return f"{value:.7g}"


def seconds(value: float) -> str:
    """Write a time with two decimals."""
    return f"{value:.2f} s"


def nice(value: float) -> float:
    """Return the largest of …, 0.1, 0.2, 0.5, 1, 2, 5, … that is not above a positive value."""
    power = 10.0 ** floor(log10(value))
    return next(m * power for m in (5.0, 2.0, 1.0, 0.5) if m * power <= value * (1 + 1e-12))


def moment(check: Check) -> str:
    """Name the moment at which a check can be made for the first time."""
    match check.at:
        case None:
            return "the first step"
        case ApexEvent(body=body):
            return f"the apex of {body}"
        case LandingEvent(body=body):
            return f"the landing of {body}"
        case ContactEvent(bodies=(a, b)):
            return f"{a} to meet {b}"
        case CrossingEvent(quantity=name, value=value):
            return f"{name} to cross {value.source}"
        case time:
            return f"t = {time.source} s"


def occasion(check: Check) -> str:
    """Name in a word or two what a check waits for."""
    match check.at:
        case ApexEvent():
            return "at apex"
        case LandingEvent():
            return "landing"
        case ContactEvent():
            return "contact"
        case CrossingEvent():
            return "crossing"
        case _:
            return "later"


def _power(text: str) -> str:
    mantissa, _, exponent = text.partition("e")
    return f"{mantissa}e{int(exponent)}"
