"""Arguments of the command line: reading and validation."""

from collections.abc import Sequence
from math import isfinite

from sandbox.model import level_catalog
from sandbox.model.errors import MisuseError, brief
from sandbox.model.level import Level, Stepping
from sandbox.model.loading import load
from sandbox.model.rules.conditions.numbers_and_shapes import MAX_STEPS
from sandbox.model.translatable_message import Message


class UsageError(MisuseError):
    """An invalid argument of the command line; its message is English only."""

    def __init__(self, message: str) -> None:
        super().__init__(Message("{message}", message=message))

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (str(self),)


def open_level(argument: str) -> tuple[str, Level]:
    """Return a level and its name or path; raise `LevelError` if it cannot be used."""
    path = level_catalog.find(argument)
    level = load(path)
    if path.parent.parent == level_catalog.root():
        return f"{path.parent.name}/{path.stem}", level
    return argument, level


def settings(pairs: Sequence[str]) -> dict[str, float]:
    """Return the parameters given as NAME=VALUE, each at most once."""
    found: dict[str, float] = {}
    for pair in pairs:
        name, equals, value = pair.partition("=")
        name = name.strip()
        if not equals or not name:
            raise UsageError(f"--set {brief(pair)}: must be NAME=VALUE, such as m1=2.5")
        if name in found:
            raise UsageError(f"--set {brief(pair)}: '{brief(name)}' is set twice")
        found[name] = _number(value, f"--set {brief(pair)}")
    return found


def _number(text: str, place: str) -> float:
    try:
        return float(text)
    except ValueError:
        hint = "; a decimal point is written ., not a comma" if "," in text else ""
        raise UsageError(f"{place}: '{brief(text)}' is not a number{hint}") from None


def positive(value: float, option: str) -> None:
    """Refuse the value of an option unless it is finite and greater than 0."""
    if not (isfinite(value) and value > 0):
        raise UsageError(f"{option} {value:g}: must be a finite number greater than 0")


def payable(seconds: float, stepping: Stepping, option: str) -> None:
    """Refuse an option value for which a run would practically never end."""
    if (steps := seconds * stepping.rate) > MAX_STEPS:
        rule = f"that takes {steps:.1g} steps at {stepping.rate:g} Hz; {MAX_STEPS:,} are allowed"
        raise UsageError(f"{option} {seconds:g}: {rule}")


def levels(count: int) -> str:
    """Return a number of levels in words."""
    return f"{count} level" if count == 1 else f"{count} levels"
