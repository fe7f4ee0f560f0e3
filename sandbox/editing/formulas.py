"""Numbers and formulas, changed so that what was typed can still be read in them."""

import ast

from sandbox.editing.layout import plain
from sandbox.model.expressions import Expression, Values

_LOOSE = (ast.IfExp, ast.Compare, ast.BoolOp, ast.UnaryOp)
"""What is put in brackets before something is added: `not` and comparisons bind less than a sum."""


def shifted(expression: Expression, by: float) -> float | str:
    """Return a number that is larger by so much, or a formula: `r` becomes `r + 0.5`.

    A number that the formula ends with takes it up: `r + 0.5` becomes `r + 0.7`.
    """
    source = expression.source
    if not isinstance(source, str) or not expression.names:
        return plain(expression({}) + by) if by else source
    if not by:
        return source
    base, constant = _apart(source)
    total = plain(constant + by)
    if not total:
        return base
    return f"{base} {'-' if total < 0 else '+'} {_typed(abs(total))}"


def scaled(expression: Expression, by: float) -> float | str:
    """Return a number that is so many times as large, or a formula: `r` becomes `1.5*r`."""
    source = expression.source
    if not isinstance(source, str) or not expression.names:
        return plain(expression({}) * by) if by != 1 else source
    return source if by == 1 else f"{_typed(plain(by))}*({source})"


def towards(expression: Expression, value: float, values: Values) -> float | str:
    """Return a number, or in the place of a formula the formula shifted to it."""
    if not expression.names:
        return plain(value)
    return shifted(expression, value - expression(values))


def _apart(source: str) -> tuple[str, float]:
    """Return a formula without the number that is added to it at its end, and that number."""
    tree = ast.parse(source.strip(), mode="eval").body
    if isinstance(tree, ast.BinOp) and isinstance(tree.op, ast.Add | ast.Sub):
        last = tree.right
        if isinstance(last, ast.Constant) and isinstance(last.value, int | float):
            sign = -1 if isinstance(tree.op, ast.Sub) else 1
            base = ast.get_source_segment(source.strip(), tree.left) or ""
            return base, sign * float(last.value)
    stripped = source.strip()
    return (f"({stripped})" if isinstance(tree, _LOOSE) else stripped), 0.0


def _typed(value: float) -> str:
    return repr(value)
