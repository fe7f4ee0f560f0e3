"""A challenge fits its level."""

from collections.abc import Iterator

from sandbox.model.did_you_mean import suggestion
from sandbox.model.errors import brief
from sandbox.model.expression_compiler import ExpressionError
from sandbox.model.level import Level
from sandbox.model.level_parts import Fault
from sandbox.model.rules.consistency.references_by_name import named_parameters
from sandbox.model.translatable_message import Message


def known_parameters(level: Level) -> Iterator[Fault]:
    """Free parameters exist and are listed once; a solution changes no others."""
    if level.challenge is None:
        return
    for path, name in named_parameters(level):
        if name not in level.parameters:
            hint = suggestion(name, level.parameters)
            yield Fault(path, "unknown parameter '{name}'{hint}", name=brief(name), hint=hint)
    free = level.challenge.free
    for index, name in enumerate(free):
        if name in level.parameters and name in free[:index]:
            yield Fault(("challenge", "free", index), "'{name}' is named twice", name=name)
    for name in level.challenge.solution:
        if name not in free:
            rule = Message(
                "'{name}' is not one of the 'free' parameters{hint}",
                name=brief(name),
                hint=suggestion(name, free),
            )
            yield Fault(("challenge", "solution", name), rule)


def solution_within_ranges(level: Level) -> Iterator[Fault]:
    """Solutions lie within the ranges of the parameters, so that a person can choose them."""
    solution = level.challenge.solution if level.challenge else {}
    for name, value in solution.items():
        parameter = level.parameters.get(name)
        if parameter and not parameter.min <= value <= parameter.max:
            rule = Message(
                "is {value:g}, but must lie between 'min', {least:g}, and 'max', {most:g}",
                value=value,
                least=parameter.min,
                most=parameter.max,
            )
            yield Fault(("challenge", "solution", name), rule)


def goals_are_bounded(level: Level) -> Iterator[Fault]:
    """Goals have bounds for their quantity."""
    for kind in ("goals", "stars"):
        for index, goal in enumerate(getattr(level.challenge, kind, ())):
            if goal.above is None and goal.below is None:
                yield Fault(("challenge", kind, index), "needs 'above', 'below', or both")


def goals_can_be_met(level: Level) -> Iterator[Fault]:
    """At the values of the solution, the bounds of no goal contradict each other."""
    if level.challenge is None:
        return
    values = {**level.defaults, **level.challenge.solution}
    for kind in ("goals", "stars"):
        for index, goal in enumerate(getattr(level.challenge, kind)):
            if goal.above is None or goal.below is None:
                continue
            if not goal.above.names | goal.below.names <= values.keys():
                continue  # unknown parameters and missing values are reported elsewhere
            try:
                lower, upper = goal.above(values), goal.below(values)
            except ExpressionError:
                continue
            if lower > upper:
                rule = Message(
                    "is {least:g}, but 'below' is {most:g}: no value can meet both",
                    least=lower,
                    most=upper,
                )
                yield Fault(("challenge", kind, index, "above"), rule)
