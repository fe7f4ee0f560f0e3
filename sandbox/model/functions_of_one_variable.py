"""Expressions in variables of their own, such as the time: their values and derivatives."""

from collections.abc import Mapping

import numpy as np

from sandbox.model.expression_compiler import differentiated
from sandbox.model.expressions import Array, Expression, Values
from sandbox.model.symbolic_derivatives import is_smooth


class Function(Expression):
    """An expression in variables of its own, in addition to the parameters."""

    def at(self, values: Values, variables: Mapping[str, Array]) -> Array:
        """Return the value for given variables; not finite where it has none.

        The variables are arrays that broadcast to the shape of the result.
        """
        result = self._evaluate({**values, **variables}) if self._code else self._constant
        return np.asarray(result, dtype=float)

    def slope(self, variable: str) -> "Function":
        """Return the derivative by a variable; raise `ExpressionError` if nested too deeply."""
        derived = object.__new__(Function)
        derived.source, derived._constant = f"d({self.source})/d{variable}", None
        derived._code, derived.names_written = differentiated(str(self.source), variable)
        return derived.with_constants(self._defined)

    @property
    def is_smooth(self) -> bool:
        """Whether it uses no functions with jumps or corners."""
        return is_smooth(str(self.source))


class Formula(Function):
    """An expression that may also use the time ``t``, at one instant or over many at once."""

    variables = ("t",)

    @property
    def variable(self) -> str:
        """Its variable: the time by default."""
        return self.variables[0]

    def over(self, values: Values, t: Array) -> Array:
        """Return the value at each time [s], in its shape; not finite where it has none."""
        found = self.at(values, {self.variable: t})
        return found if found.shape == np.shape(t) else np.broadcast_to(found, np.shape(t))


class Curve(Formula):
    """A coordinate of a curve: a formula in ``s``, the parameter along the curve."""

    variables = ("s",)


class Profile(Formula):
    """A formula in a position ``x`` [m] instead of the time."""

    variables = ("x",)


VARIABLES = frozenset(name for kind in (Formula, Curve, Profile) for name in kind.variables)
"""The variables that some formulas may use in addition to the parameters."""
