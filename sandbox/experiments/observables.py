"""Observables of a run: a quantity of its level, or arithmetic over several."""

import re
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from sandbox.model.did_you_mean import suggestion
from sandbox.model.errors import brief
from sandbox.model.expression_compiler import ExpressionError
from sandbox.model.expressions import Array, Values
from sandbox.model.functions_of_one_variable import Formula
from sandbox.model.level import Level
from sandbox.model.quantities import quantity

_QUANTITY = re.compile(r"\b[A-Za-z]\w*(?:\.[A-Za-z]\w*)+")
"""A name that contains a dot, unlike any other name in an expression."""


@dataclass(frozen=True, slots=True)
class Observable:
    """Arithmetic over quantities, parameters and the time; a condition is 1 or 0."""

    text: str
    unit: str
    """Its SI unit; empty for arithmetic with several quantities."""
    quantities: tuple[str, ...]
    """The names of the quantities it is computed from."""
    _formula: Formula | None

    @classmethod
    def of(cls, text: str, level: Level) -> "Observable":
        """Return the observable of a text, such as `ball.speed` or `a.position.x - b.position.x`.

        Raises `ExpressionError` if the text is not valid arithmetic. Raises `QuantityError` if the
        level has no such quantity.
        """
        text = text.strip()
        if text == "t" or _QUANTITY.fullmatch(text):
            found = quantity(text, level)
            return cls(found.name, found.unit, (found.name,), None)
        names = tuple(dict.fromkeys(_QUANTITY.findall(text)))
        for name in names:
            quantity(name, level)
        standing = {name: f"q{i}_" for i, name in enumerate(names)}
        formula = Formula(_QUANTITY.sub(lambda found: standing[found[0]], text))
        known_names = {*standing.values(), *level.parameters, "t"}
        if unknown := next(iter(sorted(formula.names - known_names)), None):
            hint = suggestion(unknown, {*level.parameters, "t"})
            raise ExpressionError(
                "'{unknown}' is not a parameter of the level{hint}",
                unknown=brief(unknown),
                hint=hint,
            )
        if not names and "t" not in formula.names:
            raise ExpressionError(
                "'{text}' names no quantity that a run could change", text=brief(text)
            )
        return cls(text, "", names, formula)

    def over(self, columns: Mapping[str, Array], t: Array, values: Values) -> Array:
        """Return its value at every instant: (T,)."""
        if self._formula is None:
            return t if self.text == "t" else columns[self.text]
        measured = {f"q{i}_": columns[name] for i, name in enumerate(self.quantities)}
        # expressions work on arrays as well
        return self._formula.over({**values, **measured}, t)  # type: ignore[dict-item]


def holds_at(
    condition: Observable, columns: Mapping[str, Array], t: Array, values: Values
) -> int | None:
    """Return the first instant at which a condition holds; None if it never does."""
    holds = np.nan_to_num(condition.over(columns, t, values)) != 0
    return int(np.argmax(holds)) if holds.any() else None
