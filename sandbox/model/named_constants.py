"""Named constants: formulas of the parameters and of each other, which other formulas may use."""

from collections.abc import Iterable, Mapping
from graphlib import CycleError, TopologicalSorter

from sandbox.model.base import Model
from sandbox.model.contained_expressions import expressions
from sandbox.model.expressions import Expression


def define(part: Model, constants: Mapping[str, Expression]) -> None:
    """Let the formulas of a part of a level use its constants, unless these form a cycle."""
    let_use((expression for _, expression in expressions(part)), constants)


def let_use(formulas: Iterable[Expression], constants: Mapping[str, Expression]) -> None:
    """Let formulas use constants, unless these form a cycle."""
    if not constants or circle(constants):
        return
    ordered = {name: constants[name] for name in _ordered(constants)}
    for expression in formulas:
        if expression.names_written:
            expression.define(ordered)


def circle(constants: Mapping[str, Expression]) -> list[str]:
    """Return constants that use each other in a cycle; empty if there is none."""
    try:
        _ordered(constants)
    except CycleError as error:
        found: list[str] = error.args[1]
        return found[::-1]  # each constant before those that use it
    return []


def _ordered(constants: Mapping[str, Expression]) -> list[str]:
    """Return the names in an order in which each uses only those before it."""
    uses = {name: sorted(c.names_written & constants.keys()) for name, c in constants.items()}
    return list(TopologicalSorter(uses).static_order())
