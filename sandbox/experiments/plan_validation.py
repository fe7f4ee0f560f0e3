"""Planning an experiment: its plan, and all its mistakes."""

from collections.abc import Iterator
from typing import get_args

from pydantic import ValidationError

from sandbox.experiments import measures
from sandbox.experiments.experiment_file import Experiment
from sandbox.experiments.measures import MeasureError
from sandbox.experiments.parameter_axes import Axis, AxisError, Listed
from sandbox.experiments.plan import NAMED, Plan, axis_of
from sandbox.experiments.random_points import MOST_IN_A_HYPERCUBE
from sandbox.model import parser_error_messages
from sandbox.model.did_you_mean import suggestion
from sandbox.model.errors import SandboxError, brief
from sandbox.model.level import Level, Scheme
from sandbox.model.level_parts import Fault
from sandbox.model.loading import choose
from sandbox.model.rules.conditions.numbers_and_shapes import MAX_STEPS
from sandbox.model.translatable_message import Message, joined

MOST_RUNS = 10**9
"""The most runs in an experiment; at 10,000 runs a second they take a day."""


def make(experiment: Experiment, source: str, level: Level) -> tuple[Plan, list[Fault]]:
    """Return the plan of an experiment, and all its mistakes, with which it must not be run."""
    plan = Plan(experiment, source, level)
    faults = [*_faulty_axes(plan), *_faulty_settings(plan), *_faulty_measures(plan)]
    return plan, faults or list(_faulty_runs(plan))


def _faulty_axes(plan: Plan) -> Iterator[Fault]:
    level = plan.level
    names = [*level.parameters, *NAMED, "rate"]
    if not plan.experiment.vary:
        yield Fault(("vary",), "is empty; what can be varied: {known}", known=", ".join(names))
    for name, text in plan.experiment.vary.items():
        path = ("vary", name)
        if name not in names:
            hint = suggestion(name, names, longest=len(names))
            yield Fault(
                path, "'{name}' is not a parameter of the level{hint}", name=brief(name), hint=hint
            )
            continue
        if name in plan.experiment.set:
            yield Fault(path, "'{name}' is both set and varied", name=name)
        try:
            axis = axis_of(name, text, level)
        except AxisError as error:
            yield Fault(path, error.message)
            continue
        yield from (Fault(path, rule) for rule in _outside(name, axis, plan))


def _outside(name: str, axis: Axis, plan: Plan) -> Iterator[Message]:
    """Say which values of an axis the level does not allow."""
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
                yield Message("'{name}' is not a scheme{hint}", name=brief(value), hint=hint)
            elif name == "rate":
                plan.stepping({"rate": float(value)})
        except (SandboxError, ValidationError) as error:
            yield _in_words(error)


def _in_words(error: SandboxError | ValidationError) -> Message:
    if isinstance(error, ValidationError):
        detail = error.errors(include_url=False)[0]
        return parser_error_messages.rule(detail)
    return error.message


def _faulty_settings(plan: Plan) -> Iterator[Fault]:
    experiment, level = plan.experiment, plan.level
    try:
        choose(level, experiment.set)
    except SandboxError as error:
        yield Fault(("set",), error.message)
    try:
        stepping = plan.stepping({})
    except ValidationError as error:
        yield Fault(("scheme",), _in_words(error))
    else:
        duration = experiment.duration or 0.0
        if duration * stepping.rate > MAX_STEPS:
            message = Message(
                "that takes {steps:.1g} steps; at most {most:,} are allowed",
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
            yield Fault(path, "'{text}' is measured twice", text=brief(found.text))
        seen.add(found.text)


def _faulty_runs(plan: Plan) -> Iterator[Fault]:
    """Yield the faults of the number of runs and draws, once all axes can be read."""
    if plan.random_axes and plan.experiment.draws is None:
        name = next(iter(plan.random_axes))
        yield Fault(("draws",), "is missing: '{name}' is drawn, but how many times?", name=name)
    if not plan.random_axes and plan.experiment.draws is not None:
        yield Fault(("draws",), "nothing is drawn: no axis is LOW..HIGH or MEAN±SD")
    if plan.runs > MOST_RUNS:
        parts = [Message("{count:,}", count=axis.count) for axis in plan.grids.values()]
        if plan.random_axes:
            parts.append(Message("{count:,} draws", count=plan.draws))
        yield Fault(
            ("vary",),
            "makes {product} = {runs:,} runs; at most {most:,} are allowed",
            product=joined(parts, " × "),
            runs=plan.runs,
            most=MOST_RUNS,
        )
    yield from _faulty_draws(plan)


def _faulty_draws(plan: Plan) -> Iterator[Fault]:
    """Yield the faults of the sampling method."""
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
            yield Fault(("method",), "for Sobol indices, everything that is varied must be drawn")
        if base < 2 or base & (base - 1):
            yield Fault(
                ("draws",), "{base:,}: for Sobol indices it must be a power of two", base=base
            )
