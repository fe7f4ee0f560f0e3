"""The runs of a curve, made in another process, from coarse to fine."""

from collections.abc import Iterator, Sequence
from math import ceil, floor
from typing import NamedTuple

from sandbox.experiments.experiment_file import parsed
from sandbox.experiments.plan import Plan
from sandbox.experiments.plan_validation import make
from sandbox.experiments.row_runs import measured
from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Values
from sandbox.model.level import Level
from sandbox.model.level_parts import Fault
from sandbox.model.translatable_message import Message, joined
from sandbox.model.whole_number_parameters import acts_as_whole_number

COUNT = 65
"""The number of values of a parameter: the ends, and the points of repeated bisection."""


class Point(NamedTuple):
    """The result of one run."""

    at: float
    """the value of the parameter"""
    measured: float | None
    expected: float | None
    """the value of the closed form of the level's check; None if there is none"""
    failure: str | None


class SamplingRefusal(NamedTuple):
    """The reason why there are no runs."""

    reason: Message


def sample(
    level: Level, values: Values, parameter: str, measure: str
) -> Iterator[Point | SamplingRefusal]:
    """Yield the points of a curve over the range of a parameter, from coarse to fine.

    The parameter and the measure have the form of an experiment's file.
    """
    try:
        plan = _plan(level, values, parameter, measure)
    except SandboxError as error:
        yield SamplingRefusal(error.message)
        return
    count = count_values(level, parameter)
    for index in coarse_first(count) if count == COUNT else range(count):
        (cells,) = measured(plan, index, index + 1)
        _, at, value, *closed, failure = cells
        expected = closed[0] if closed else None
        yield Point(_number(at) or 0.0, _number(value), _number(expected), _text(failure))


def count_values(level: Level, parameter: str) -> int:
    """Return the number of values that a parameter takes in a curve."""
    return len(_whole_values(level, parameter)) or COUNT


def _whole_values(level: Level, parameter: str) -> Sequence[int]:
    """Return the values of a parameter that acts as a whole number, if there are few."""
    limits = level.parameters[parameter]
    values = range(ceil(limits.min), floor(limits.max) + 1)
    return values if len(values) < COUNT and acts_as_whole_number(level, parameter) else ()


def coarse_first(count: int) -> list[int]:
    """Return the numbers from 0 to a power of two in the order of repeated bisection."""
    last, order = count - 1, [0, count - 1]
    step = last // 2
    while step:
        order += range(step, last, 2 * step)
        step //= 2
    return order


def _plan(level: Level, values: Values, parameter: str, measure: str) -> Plan:
    limits, whole = level.parameters[parameter], _whole_values(level, parameter)
    request = {
        "level": level.title,
        "vary": {parameter: ", ".join(map(str, whole)) or f"{limits.min!r}:{limits.max!r}:{COUNT}"},
        "measure": [measure],
        "set": {name: value for name, value in values.items() if name != parameter},
    }
    experiment, faults = parsed(request)
    if experiment is not None:
        plan, faults = make(experiment, level.title, level)
        if not faults:
            return plan
    raise SandboxError(joined(map(_message, faults), "; "))


def _message(fault: Fault) -> Message:
    if not fault.path:
        return fault.rule
    return Message("{field}: {rule}", field=fault.path[-1], rule=fault.rule)


def _number(cell: object) -> float | None:
    return cell if isinstance(cell, float) else None


def _text(cell: object) -> str | None:
    return cell if isinstance(cell, str) else None
