"""The plan of an experiment: the level, and the settings of each row."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from math import prod
from typing import NamedTuple

import numpy as np

from sandbox.experiments import measures, parameter_axes
from sandbox.experiments.experiment_file import Experiment
from sandbox.experiments.measures import Measure
from sandbox.experiments.observables import Observable
from sandbox.experiments.parameter_axes import Axis, Drawn, Grid, Listed
from sandbox.experiments.random_points import points
from sandbox.model import levels_with_changed_effects
from sandbox.model.expressions import Values
from sandbox.model.level import Level, Stepping
from sandbox.model.loading import choose
from sandbox.model.rules.conditions.condition import Condition
from sandbox.model.rules.level_validation import depending

NONE = "none"
"""The value of `without` that switches off nothing."""

NAMED = ("without", "scheme")
"""The axes whose values are names instead of numbers."""


class Row(NamedTuple):
    """One run of an experiment."""

    number: int
    """from 0"""
    varied: tuple[float | str, ...]
    """the value of each axis"""


class Variant(NamedTuple):
    """A level without some effects, and the requirements on its parameters."""

    level: Level
    conditions: list[Condition]


@dataclass(frozen=True)
class Plan:
    """An experiment together with its level; made by `make`."""

    experiment: Experiment
    """The experiment as it was written."""
    source: str
    """The name of the level."""
    level: Level
    """The level as in its file."""

    @cached_property
    def axes(self) -> dict[str, Axis]:
        """The axes by name."""
        return {n: axis_of(n, text, self.level) for n, text in self.experiment.vary.items()}

    @cached_property
    def grids(self) -> dict[str, Grid | Listed]:
        """The axes of the grid, the slowest first."""
        return {n: a for n, a in self.axes.items() if isinstance(a, Grid | Listed)}

    @cached_property
    def random_axes(self) -> dict[str, Drawn]:
        """The random axes."""
        return {n: a for n, a in self.axes.items() if not isinstance(a, Grid | Listed)}

    @cached_property
    def draws(self) -> int:
        """The number of rows per point of the grid."""
        if not self.random_axes:
            return 1
        base = self.experiment.draws or 1
        scheme = self.experiment.method == "sobol-indices"
        return base * (len(self.random_axes) + 2) if scheme else base

    @cached_property
    def runs(self) -> int:
        """The number of runs."""
        return prod(axis.count for axis in self.grids.values()) * self.draws

    @cached_property
    def until(self) -> Observable | None:
        """The condition that ends a run."""
        text = self.experiment.until
        return None if text is None else Observable.of(text, self.level)

    @cached_property
    def measures(self) -> tuple[Measure, ...]:
        """The measures of each run."""
        until = self.experiment.until is not None
        return tuple(measures.parse(m, self.level, until=until) for m in self.experiment.measure)

    @cached_property
    def quantities(self) -> list[str]:
        """The quantities to record in each run."""
        names = [name for measure in self.measures for name in measure.quantities]
        return list(dict.fromkeys(["t", *(self.until.quantities if self.until else ()), *names]))

    def __reduce__(self) -> tuple[type["Plan"], tuple[Experiment, str, Level]]:
        """Pickle only what the plan was made from; the rest is rebuilt."""
        return Plan, (self.experiment, self.source, self.level)

    def rows(self, start: int, stop: int) -> Iterator[Row]:
        """Yield the rows `start` to `stop` − 1."""
        drawn = self._random_values(start, stop)
        for number in range(start, stop):
            rest, found = number // self.draws, dict[str, float | str]()
            for name, axis in reversed(self.grids.items()):
                rest, index = divmod(rest, axis.count)
                found[name] = axis.at(index)
            for name, values in drawn.items():
                found[name] = values[number - start]
            yield Row(number, tuple(found[name] for name in self.axes))

    def _random_values(self, start: int, stop: int) -> dict[str, list[float]]:
        """Return the random values of some rows; each point of the grid has the same draws."""
        if not self.random_axes:
            return {}
        shares = []
        begin = start
        while begin < stop:
            first = begin % self.draws
            count = min(stop - begin, self.draws - first)
            method, seed = self.experiment.method, self.experiment.seed
            last = first + count
            shares.append(points(method, seed, len(self.random_axes), self.draws, first, last))
            begin += count
        columns = np.concatenate(shares).T
        return {
            name: axis.quantiles(column).tolist()
            for (name, axis), column in zip(self.random_axes.items(), columns, strict=True)
        }

    def setting(self, row: Row) -> tuple[Level, Values, Stepping]:
        """Return the level of a row with its effects, the parameters, and the stepping.

        Raises `SandboxError` if the row cannot be run.
        """
        varied = dict(zip(self.axes, row.varied, strict=True))
        chosen = {n: float(v) for n, v in varied.items() if n in self.level.parameters}
        others = {n: v for n, v in varied.items() if n not in self.level.parameters}
        level, conditions = self.variant(str(others.get("without", NONE)))
        values = choose(level, {**self.experiment.set, **chosen}, conditions)
        return level, values, self.stepping(others)

    def stepping(self, varied: Mapping[str, float | str]) -> Stepping:
        """Return the stepping, with some of its settings replaced by name.

        Raises `ValidationError` if a value is not valid.
        """
        own = self.level.stepping
        settings = {"rate": self.experiment.rate, "scheme": self.experiment.scheme, **varied}
        changes = {n: v for n, v in settings.items() if n in ("rate", "scheme") and v is not None}
        if not changes:
            return own
        return Stepping.model_validate({**own.at(own.rate).model_dump(), **changes})

    def variant(self, without: str) -> Variant:
        """Return the level without some effects, given by their names, joined by +.

        Raises `EffectError` if it is not valid without them.
        """
        if without not in self._variants:
            names = [] if without == NONE else [name.strip() for name in without.split("+")]
            level = levels_with_changed_effects.vary(self.level, names, {})[0]
            self._variants[without] = Variant(level, depending(level))
        return self._variants[without]

    @cached_property
    def _variants(self) -> dict[str, Variant]:
        """The variants made so far, by the effects they lack."""
        return {}


def axis_of(name: str, text: str, level: Level) -> Axis:
    """Return the axis of a name, as written in a text; raise `AxisError` if it cannot be read."""
    named = name in NAMED and name not in level.parameters
    return parameter_axes.parse_names(text) if named else parameter_axes.parse(text)
