"""The axes of an experiment: the values of a grid, or a distribution to draw from.

0:90:91          a grid: from, to, and the number of values
1:1000:31:log    the same with equal ratios
1, 2, 5          a list of values
0..1             random, with a uniform distribution
1..100:log       random, with a uniform distribution of the logarithm
1.00±0.01        random, with a normal distribution: mean and standard deviation (or 1.00+-0.01)
"""

import re
from dataclasses import dataclass
from math import exp, isfinite, log
from typing import Literal, TypeVar

import numpy as np

from sandbox.model.errors import SandboxError, brief
from sandbox.model.expressions import Array
from sandbox.model.translatable_message import Message

MOST_LISTED = 10_000
"""The most values in a list."""

SPELT = 20
"""The most listed values that are written out in messages."""

FORMS = Message(
    "must be FROM:TO:COUNT, FROM:TO:COUNT:log, a list with commas, LOW..HIGH, LOW..HIGH:log or"
    " MEAN±SD"
)

Scale = Literal["linear", "log"]


class AxisError(SandboxError):
    """A text that describes no values; the message is fit to be shown."""


@dataclass(frozen=True, slots=True)
class Grid:
    """Values from a first to a last, at equal distances or in equal ratios."""

    low: float
    high: float
    count: int
    scale: Scale = "linear"

    def at(self, index: int) -> float:
        """Return the value of an index, from 0."""
        if index in (0, self.count - 1):
            return self.high if index else self.low
        probability = index / (self.count - 1)
        if self.scale == "log":
            return self.low * (self.high / self.low) ** probability
        return self.low + (self.high - self.low) * probability

    @property
    def ends(self) -> tuple[float, float]:
        """The first and the last value."""
        return self.low, self.high

    def described(self, unit: str) -> str:
        """Return a description of the values."""
        values = "one value" if self.count == 1 else f"{self.count:,} values"
        ratios = ", with equal ratios" if self.scale == "log" else ""
        return f"{self.low:g} to {self.high:g}{_in(unit)}, {values}{ratios}"


@dataclass(frozen=True, slots=True)
class Listed:
    """A list of values: numbers or names."""

    values: tuple[float, ...] | tuple[str, ...]

    @property
    def count(self) -> int:
        """The number of values."""
        return len(self.values)

    def at(self, index: int) -> float | str:
        """Return the value of an index, from 0."""
        return self.values[index]

    def described(self, unit: str) -> str:
        """Return a description of the values; of many only the first and the last."""
        named = [v if isinstance(v, str) else f"{v:g}" for v in self.values]
        if len(named) > SPELT:
            named = [named[0], named[1], "…", f"{named[-1]}{_in(unit)}"]
            return f"{', '.join(named)}, {self.count:,} values"
        return f"{', '.join(named)}{_in(unit)}"


@dataclass(frozen=True, slots=True)
class Uniform:
    """Random values with a uniform distribution, of themselves or of their logarithms."""

    low: float
    high: float
    scale: Scale = "linear"

    def quantiles(self, probability: Array) -> Array:
        """Return the quantiles of given probabilities."""
        if self.scale == "log":
            low, high = log(self.low), log(self.high)
            return np.array([exp(low + (high - low) * s) for s in probability.tolist()])
        return self.low + (self.high - self.low) * probability

    @property
    def ends(self) -> tuple[float, float]:
        """The smallest and the largest value."""
        return self.low, self.high

    def described(self, unit: str) -> str:
        """Return a description of the distribution."""
        likely = "logarithm" if self.scale == "log" else "value"
        return (
            f"drawn from {self.low:g} to {self.high:g}{_in(unit)}, each {likely} as likely as any"
            " other"
        )


@dataclass(frozen=True, slots=True)
class Normal:
    """Random values with a normal distribution, as of a measured value with its uncertainty."""

    mean: float
    deviation: float

    def quantiles(self, probability: Array) -> Array:
        """Return the quantiles of given probabilities."""
        from scipy.special import ndtri

        return np.asarray(self.mean + self.deviation * ndtri(probability))

    @property
    def ends(self) -> tuple[float, float]:
        """The ends of the range of likely values: one standard deviation about the mean."""
        return self.mean - self.deviation, self.mean + self.deviation

    def described(self, unit: str) -> str:
        """Return a description of the distribution."""
        spread = f"{self.mean:g} ± {self.deviation:g}"
        return f"drawn from a normal distribution, {f'({spread}) {unit}' if unit else spread}"


def _in(unit: str) -> str:
    """Return a unit as it is written after a number."""
    return f" {unit}" if unit else ""


Drawn = Uniform | Normal
Axis = Grid | Listed | Drawn
Range = TypeVar("Range", Grid, Uniform)


def parse(text: str) -> Axis:
    """Return the numeric axis that a text describes; raise `AxisError` if it describes none."""
    text = text.strip()
    for sign in ("±", "+-"):
        if sign in text:
            mean, _, deviation = text.partition(sign)
            return _normal(_number(mean), _number(deviation))
    if ".." in text:
        ends, _, scale = text.partition(":")
        low, _, high = ends.partition("..")
        return _checked(Uniform(_number(low), _number(high), _scale(scale)))
    if ":" in text:
        return _grid(text.split(":"))
    return Listed(tuple(map(_number, _items(text))))


def parse_names(text: str) -> Listed:
    """Return the names that a text lists; raise `AxisError` if it lists none."""
    return Listed(tuple(_items(text)))


def _items(text: str) -> list[str]:
    items = [item.strip() for item in text.split(",")]
    if not all(items):
        empty = Message("is an empty grid: {forms}", forms=FORMS)
        raise AxisError(Message("has nothing before a comma") if text else empty)
    if len(items) > MOST_LISTED:
        raise AxisError(
            "lists {count:,} values; at most {most:,} are allowed",
            count=len(items),
            most=MOST_LISTED,
        )
    if twice := next((item for item in items if items.count(item) > 1), None):
        raise AxisError("lists '{twice}' twice", twice=brief(twice))
    return items


def _grid(parts: list[str]) -> Grid:
    if len(parts) not in (3, 4):
        raise AxisError(FORMS)
    low, high, count = (_number(part) for part in parts[:3])
    if count != int(count):
        raise AxisError("{count:g} is not a number of values", count=count)
    if count < 1:
        raise AxisError("is an empty grid: {count:g} values", count=count)
    if count == 1 and low != high:
        raise AxisError("has only one value, but two ends")
    if count > 1 and low == high:
        raise AxisError("has {count:g} values, which are all {low:g}", count=count, low=low)
    return _checked(Grid(low, high, int(count), _scale(parts[3] if len(parts) > 3 else "")))


def _checked(axis: Range) -> Range:
    if axis.scale == "log" and min(axis.low, axis.high) <= 0:
        raise AxisError("a logarithmic range begins and ends above 0")
    if isinstance(axis, Uniform) and not axis.low < axis.high:
        raise AxisError("must begin below its end")
    return axis


def _normal(mean: float, deviation: float) -> Normal:
    if deviation <= 0:
        raise AxisError(
            "has the standard deviation {deviation:g}, which must be above 0", deviation=deviation
        )
    return Normal(mean, deviation)


def _scale(text: str) -> Scale:
    if text.strip() in ("", "linear"):
        return "linear"
    if text.strip() == "log":
        return "log"
    raise AxisError("'{text}' is not a scale; known: linear, log", text=brief(text))


def _number(text: str) -> float:
    if not re.fullmatch(r"\s*[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?\s*", text):
        raise AxisError("'{text}' is not a number; {forms}", text=brief(text.strip()), forms=FORMS)
    value = float(text)
    if not isfinite(value):
        raise AxisError("'{text}' is too large a number", text=brief(text.strip()))
    return value
