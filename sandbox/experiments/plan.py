"""The plan of an experiment: the level, and the settings of each row."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from math import prod
from typing import NamedTuple, get_args

import numpy as np
from pydantic import ValidationError

from sandbox.experiments import axes, measures
from sandbox.experiments.axes import Axis, AxisError, Drawn, Grid, Listed
from sandbox.experiments.document import Experiment
from sandbox.experiments.measures import Measure, MeasureError
from sandbox.experiments.observables import Observable
from sandbox.experiments.random_points import MOST_IN_A_HYPERCUBE, points
from sandbox.model import effect_variants, parse_messages
from sandbox.model.conditions.condition import Condition
from sandbox.model.conditions.numbers import MAX_STEPS
from sandbox.model.did_you_mean import suggestion
from sandbox.model.errors import SandboxError, brief
from sandbox.model.expressions import Values
from sandbox.model.level import Level, Scheme, Stepping
from sandbox.model.level_parts import Fault
from sandbox.model.loading import choose
from sandbox.model.message import Message, joined
from sandbox.model.rules import depending

MOST_RUNS = 10**9
"""How many runs an experiment may have; at 10,000 runs a second those take a day."""

NONE = "none"
"""What `without` is called where nothing is switched off."""

_NAMED = ("without", "scheme")


class Row(NamedTuple):
    """One run of an experiment."""

    number: int
    """from 0"""
    varied: tuple[float | str, ...]
    """what each axis has there"""


class Variant(NamedTuple):
    """A level with effects less, and what must hold in it for each choice of its parameters."""

    level: Level
    conditions: list[Condition]


@dataclass(frozen=True)
class Plan:
    """An experiment with the level that it runs; made by `make`.

    Attributes
    ----------
    experiment
        As it was written.
    source
        What the level is called.
    level
        As it is in its file.
    """

    experiment: Experiment
    source: str
    level: Level

    @cached_property
    def axes(self) -> dict[str, Axis]:
        """What is varied, by name."""
        return {n: _axis(n, text, self.level) for n, text in self.experiment.vary.items()}

    @cached_property
    def grids(self) -> dict[str, Grid | Listed]:
        """What is varied over a grid, the slowest first."""
        return {n: a for n, a in self.axes.items() if isinstance(a, Grid | Listed)}

    @cached_property
    def drawn(self) -> dict[str, Drawn]:
        """What is drawn."""
        return {n: a for n, a in self.axes.items() if not isinstance(a, Grid | Listed)}

    @cached_property
    def draws(self) -> int:
        """How many rows each point of the grid has."""
        if not self.drawn:
            return 1
        base = self.experiment.draws or 1
        scheme = self.experiment.method == "sobol-indices"
        return base * (len(self.drawn) + 2) if scheme else base

    @cached_property
    def runs(self) -> int:
        """How many runs there are."""
        return prod(axis.count for axis in self.grids.values()) * self.draws

    @cached_property
    def until(self) -> Observable | None:
        """The condition that ends a run."""
        text = self.experiment.until
        return None if text is None else Observable.of(text, self.level)

    @cached_property
    def measures(self) -> tuple[Measure, ...]:
        """What is measured of each run."""
        until = self.experiment.until is not None
        return tuple(measures.parse(m, self.level, until=until) for m in self.experiment.measure)

    @cached_property
    def quantities(self) -> list[str]:
        """What must be recorded of a run."""
        names = [name for measure in self.measures for name in measure.quantities]
        return list(dict.fromkeys(["t", *(self.until.quantities if self.until else ()), *names]))

    def __reduce__(self) -> tuple[type["Plan"], tuple[Experiment, str, Level]]:
        """Send to other processes what it is made of, and not what was made of that."""
        return Plan, (self.experiment, self.source, self.level)

    def rows(self, start: int, stop: int) -> Iterator[Row]:
        """Yield the rows from one to before another."""
        drawn = self._drawn(start, stop)
        for number in range(start, stop):
            rest, found = number // self.draws, dict[str, float | str]()
            for name, axis in reversed(self.grids.items()):
                rest, index = divmod(rest, axis.count)
                found[name] = axis.at(index)
            for name, values in drawn.items():
                found[name] = values[number - start]
            yield Row(number, tuple(found[name] for name in self.axes))

    def _drawn(self, start: int, stop: int) -> dict[str, list[float]]:
        """Return what is drawn for some rows; each point of the grid has the same draws."""
        if not self.drawn:
            return {}
        shares = []
        begin = start
        while begin < stop:
            first = begin % self.draws
            count = min(stop - begin, self.draws - first)
            method, seed = self.experiment.method, self.experiment.seed
            last = first + count
            shares.append(points(method, seed, len(self.drawn), self.draws, first, last))
            begin += count
        columns = np.concatenate(shares).T
        return {
            name: axis.drawn(column).tolist()
            for (name, axis), column in zip(self.drawn.items(), columns, strict=True)
        }

    def setting(self, row: Row) -> tuple[Level, Values, Stepping]:
        """Return what is run in a row: the level with its effects, the parameters, how it steps.

        Raises
        ------
        SandboxError
            If there is no such run.
        """
        varied = dict(zip(self.axes, row.varied, strict=True))
        chosen = {n: float(v) for n, v in varied.items() if n in self.level.parameters}
        others = {n: v for n, v in varied.items() if n not in self.level.parameters}
        level, conditions = self.variant(str(others.get("without", NONE)))
        values = choose(level, {**self.experiment.set, **chosen}, conditions)
        return level, values, self._stepping(others)

    def _stepping(self, varied: Mapping[str, float | str]) -> Stepping:
        own = self.level.stepping
        asked = {"rate": self.experiment.rate, "scheme": self.experiment.scheme, **varied}
        given = {n: v for n, v in asked.items() if n in ("rate", "scheme") and v is not None}
        if not given:
            return own
        return Stepping.model_validate({**own.at(own.rate).model_dump(), **given})

    def variant(self, without: str) -> Variant:
        """Return the level without some effects, whose names are joined by +.

        Raises
        ------
        EffectError
            If it makes no sense without them.
        """
        if without not in self._variants:
            names = [] if without == NONE else [name.strip() for name in without.split("+")]
            level = effect_variants.vary(self.level, names, {})[0]
            self._variants[without] = Variant(level, depending(level))
        return self._variants[without]

    @cached_property
    def _variants(self) -> dict[str, Variant]:
        """The variants that were asked for, by what they are without."""
        return {}


def _axis(name: str, text: str, level: Level) -> Axis:
    named = name in _NAMED and name not in level.parameters
    return axes.parse_names(text) if named else axes.parse(text)


def make(experiment: Experiment, source: str, level: Level) -> tuple[Plan, list[Fault]]:
    """Return the plan of an experiment, and everything that is wrong with it.

    A plan in which something is wrong is not to be run.
    """
    plan = Plan(experiment, source, level)
    faults = [*_faulty_axes(plan), *_faulty_settings(plan), *_faulty_measures(plan)]
    return plan, faults or list(_faulty_runs(plan))


def _faulty_axes(plan: Plan) -> Iterator[Fault]:
    level = plan.level
    known = [*level.parameters, *_NAMED, "rate"]
    if not plan.experiment.vary:
        yield Fault(
            ("vary",), Message("is empty; what can be varied: {known}", known=", ".join(known))
        )
    for name, text in plan.experiment.vary.items():
        path = ("vary", name)
        if name not in known:
            hint = suggestion(name, known, most=len(known))
            yield Fault(
                path,
                Message("'{name}' is no parameter of the level{hint}", name=brief(name), hint=hint),
            )
            continue
        if name in plan.experiment.set:
            yield Fault(path, Message("'{name}' is set and varied, both", name=name))
        try:
            axis = _axis(name, text, level)
        except AxisError as error:
            yield Fault(path, error.message)
            continue
        yield from (Fault(path, rule) for rule in _outside(name, axis, plan))


def _outside(name: str, axis: Axis, plan: Plan) -> Iterator[Message]:
    """Yield what is wrong with an axis that can be read."""
    level = plan.level
    if name in level.parameters:
        parameter = level.parameters[name]
        ends = axis.values if isinstance(axis, Listed) else axis.ends
        outside = (v for v in map(float, ends) if not parameter.min <= v <= parameter.max)
        if (beyond := next(outside, None)) is not None:
            yield Message(
                "goes to {beyond:g}{unit}, but the level has '{name}' from {least:g} to"
                " {most:g}{unit}",
                beyond=beyond,
                unit=f" {parameter.unit}" if parameter.unit else "",
                name=name,
                least=parameter.min,
                most=parameter.max,
            )
    elif isinstance(axis, Listed):
        yield from _unknown_names(name, [str(v) for v in axis.values], plan)


def _unknown_names(name: str, values: list[str], plan: Plan) -> Iterator[Message]:
    for value in values:
        try:
            if name == "without":
                plan.variant(value)
            elif name == "scheme" and value not in get_args(Scheme):
                hint = suggestion(value, get_args(Scheme))
                yield Message("'{name}' is no scheme{hint}", name=brief(value), hint=hint)
            elif name == "rate":
                plan._stepping({"rate": float(value)})  # noqa: SLF001 (its own module)
        except (SandboxError, ValidationError) as error:
            yield _said(error)


def _said(error: SandboxError | ValidationError) -> Message:
    if isinstance(error, ValidationError):
        detail = error.errors(include_url=False)[0]
        return parse_messages.rule(detail)
    return error.message


def _faulty_settings(plan: Plan) -> Iterator[Fault]:
    experiment, level = plan.experiment, plan.level
    try:
        choose(level, experiment.set)
    except SandboxError as error:
        yield Fault(("set",), error.message)
    try:
        stepping = plan._stepping({})  # noqa: SLF001 (its own module)
    except ValidationError as error:
        yield Fault(("scheme",), _said(error))
    else:
        duration = experiment.duration or 0.0
        if duration * stepping.rate > MAX_STEPS:
            message = Message(
                "that takes {steps:.1g} steps; {most:,} are allowed",
                steps=duration * stepping.rate,
                most=MAX_STEPS,
            )
            yield Fault(("duration",), message)
        if level.stepping.accuracy is not None and stepping.accuracy is not None:
            message = Message(
                "the level asks for an accuracy; say at which 'rate' the experiment runs it"
            )
            yield Fault(("rate",), message)


def _faulty_measures(plan: Plan) -> Iterator[Fault]:
    try:
        _ = plan.until
    except SandboxError as error:
        yield Fault(("until",), error.message)
    seen = set[str]()
    for i, text in enumerate(plan.experiment.measure):
        path = ("measure", i)
        try:
            found = measures.parse(text, plan.level, until=plan.experiment.until is not None)
        except MeasureError as error:
            yield Fault(path, error.message)
            continue
        if found.text in seen:
            yield Fault(path, Message("'{text}' is measured twice", text=brief(found.text)))
        seen.add(found.text)


def _faulty_runs(plan: Plan) -> Iterator[Fault]:
    """Yield what is wrong with the number of runs, once everything can be read."""
    if plan.drawn and plan.experiment.draws is None:
        name = next(iter(plan.drawn))
        yield Fault(
            ("draws",), Message("is missing: '{name}' is drawn, but how many times?", name=name)
        )
    if not plan.drawn and plan.experiment.draws is not None:
        yield Fault(("draws",), Message("nothing is drawn: no axis is LOW..HIGH or MEAN±SD"))
    if plan.runs > MOST_RUNS:
        parts = [Message("{count:,}", count=axis.count) for axis in plan.grids.values()]
        if plan.drawn:
            parts.append(Message("{count:,} draws", count=plan.draws))
        yield Fault(
            ("vary",),
            Message(
                "makes {product} = {runs:,} runs; {most:,} are the most",
                product=joined(parts, " × "),
                runs=plan.runs,
                most=MOST_RUNS,
            ),
        )
    yield from _faulty_draws(plan)


def _faulty_draws(plan: Plan) -> Iterator[Fault]:
    """Yield what the way of drawing does not allow."""
    method, base = plan.experiment.method, plan.experiment.draws or 1
    if method == "latin-hypercube" and base > MOST_IN_A_HYPERCUBE:
        message = Message(
            "{count:,} draws; a Latin hypercube has at most {most:,}; 'sobol' has no such bound",
            count=base,
            most=MOST_IN_A_HYPERCUBE,
        )
        yield Fault(("draws",), message)
    if method == "sobol-indices":
        if plan.grids:
            yield Fault(
                ("method",), Message("Sobol's indices need everything that is varied to be drawn")
            )
        if base < 2 or base & (base - 1):
            yield Fault(
                ("draws",),
                Message("{base:,}: of Sobol's indices it must be a power of two", base=base),
            )
