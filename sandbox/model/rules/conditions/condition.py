"""A condition: what must hold in a level for every choice of its parameters."""

from collections.abc import Callable
from typing import NamedTuple

from sandbox.model.arithmetic import ExpressionError
from sandbox.model.expressions import Values
from sandbox.model.json_positions import Path
from sandbox.model.message import Message


class Condition(NamedTuple):
    """What must hold for every choice of the parameters."""

    path: Path
    names: frozenset[str]
    """The parameters that it depends on."""
    broken: Callable[[Values], Message | None]
    """Say what is wrong for the given parameters, if anything is."""
    work: float = 10.0
    """µs, about what it takes to look: so that what a whole level takes can be bounded."""

    def fault(self, values: Values) -> Message | None:
        """Return what is wrong; expressions without a value are reported by their own condition."""
        try:
            return self.broken(values)
        except ExpressionError:
            return None
