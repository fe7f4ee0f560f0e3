"""Comparison of two runs of a level, such as with and without an effect."""

from dataclasses import dataclass

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.level import Check, Instant, Level
from sandbox.physics.measuring.grading import ZERO, samples
from sandbox.physics.measuring.recording import Trace, needed


@dataclass(frozen=True, slots=True)
class Difference:
    """The difference of a quantity between two runs."""

    label: str
    """A short description."""
    quantity: str
    unit: str
    """The quantity and its unit."""
    at: Instant | None
    """The instant of the comparison; None for the time at which the runs differ most."""
    t: tuple[float | None, float | None]
    """The time of the instant in the first run and in the second [s]; None if it never came."""
    first: float | None
    second: float | None
    """The quantity in the first run and in the second; None if the instant never came."""
    scale: float
    """The largest magnitude in the first run; at an instant, the magnitude there."""
    fraction: float
    """The difference over the largest magnitude in both runs, from 0 to 2; infinite if the instant
    came in only one of them."""

    @property
    def relative(self) -> float | None:
        """The difference over the scale; None if that is zero or a value is missing."""
        if self.first is None or self.second is None or self.scale <= ZERO:
            return None
        return (self.second - self.first) / self.scale


def compared_quantities(level: Level) -> list[str]:
    """Return the quantities by which runs are compared: those of checks, and positions."""
    dynamic = [name for name, body in level.bodies.items() if body.type == "dynamic"]
    parts = ["position.x", "position.y", *(["angle"] if level.effects.rotation else [])]
    positions = [f"{name}.{part}" for name in dynamic for part in parts]
    return list(dict.fromkeys([*needed(level), *positions]))


def differences(before: Trace, after: Trace, *, positions: bool = False) -> tuple[Difference, ...]:
    """Return the differences of two runs in the quantities of the first one's checks.

    With `positions`, all other quantities that both recorded are compared, too.
    """
    end = min(before.t[-1], after.t[-1])
    before, after = before.until(float(end)), after.until(float(end))
    scales = _scales(before, after)
    asked: dict[tuple[str, Instant | None], Check | None] = {}
    for check in before.level.checks:
        asked.setdefault((check.quantity, check.at), check)
    if positions:
        asked.update({(name, None): asked.get((name, None)) for name in before.columns})
    return tuple(
        _difference(before, after, name, at, check.label if check else "", scales)
        for (name, at), check in asked.items()
        if name in after.columns and (name != "t" or at is not None)
    )


def _scales(before: Trace, after: Trace) -> dict[str, float]:
    """Return the largest magnitude of each unit, against which rounding is judged."""
    scales: dict[str, float] = {}
    for trace in (before, after):
        for name, unit in trace.units.items():
            scales[unit] = max(scales.get(unit, 0.0), _largest(trace.columns[name]))
    return scales


def _largest(column: Array) -> float:
    finite = column[np.isfinite(column)]
    return float(np.abs(finite).max(initial=0.0))


def _difference(
    before: Trace, after: Trace, name: str, at: Instant | None, label: str, scales: dict[str, float]
) -> Difference:
    unit = before.units[name]
    found = samples(before, name, at), samples(after, name, at)
    (t0, first_values), (t1, second_values) = (
        f or (np.full(1, np.nan), np.full(1, np.nan)) for f in found
    )
    length = min(len(first_values), len(second_values))
    separation = np.nan_to_num(np.abs(second_values[:length] - first_values[:length]), nan=-1.0)
    worst = int(np.argmax(separation))
    first, second = _number(first_values[worst]), _number(second_values[worst])
    largest = max(_largest(first_values), _largest(second_values))
    fraction = (
        float(separation[worst]) / largest if separation[worst] > ZERO * scales[unit] else 0.0
    )
    if (first is None) is not (second is None):
        fraction = np.inf
    times = _number(t0[worst]), _number(t1[worst])
    scale = _largest(first_values)
    return Difference(label, name, unit, at, times, first, second, scale, fraction)


def _number(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None
