"""A condition that a level must satisfy for all values of its parameters."""

from collections.abc import Callable
from typing import NamedTuple

from sandbox.model.expression_compiler import ExpressionError
from sandbox.model.expressions import Values
from sandbox.model.json_positions import Path
from sandbox.model.translatable_message import Message


class Condition(NamedTuple):
    """A condition that must hold for all values of the parameters."""

    path: Path
    names: frozenset[str]
    """The parameters that it depends on."""
    broken: Callable[[Values], Message | None]
    """A function that returns what is wrong for given parameters; None if nothing is."""
    work: float = 10.0
    """The work of checking it, about [µs], by which the time for a whole level is bounded."""

    def fault(self, values: Values) -> Message | None:
        """Return what is wrong; an expression without a value has a condition of its own."""
        try:
            return self.broken(values)
        except ExpressionError:
            return None
