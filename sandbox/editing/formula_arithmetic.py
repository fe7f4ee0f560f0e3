"""Changes of numbers and formulas that keep them readable."""

import ast
import re
from collections.abc import Mapping
from math import degrees

from sandbox.editing.inserted_value_layout import Json, plain
from sandbox.model.expressions import Expression, Values

_LOOSE = (ast.IfExp, ast.Compare, ast.BoolOp, ast.UnaryOp)
"""Nodes that need brackets before something is added, as they bind less tightly than a sum."""

_TIGHT = (ast.Name, ast.Call, ast.Constant)
"""Nodes that never need brackets."""

ROUND = 10
"""Decimals of an angle in degrees, which round it by 2e-12 rad."""

DIGITS = 12
"""Significant digits of a computed length or angle; those beyond are rounding errors."""


def shifted(expression: Expression, by: float) -> float | str:
    """Return a number or formula plus a constant: `r` becomes `r + 0.5`.

    If a number is added at the end of a formula, it changes: `r + 0.5` becomes `r + 0.7`.
    """
    source = expression.source
    if not by:
        return source
    if not isinstance(source, str) or not expression.names:
        return plain(expression({}) + by)
    base, constant = _apart(source.strip())
    total = plain(constant + by)
    return f"{base} {'-' if total < 0 else '+'} {abs(total)!r}" if total else base


def scaled(expression: Expression, by: float) -> float | str:
    """Return a number or formula times a factor: `r` becomes `1.5*r`."""
    source = expression.source
    if by == 1:
        return source
    if not isinstance(source, str) or not expression.names:
        return plain(expression({}) * by)
    return f"{plain(by)!r}*{_bracketed(source.strip())}"


def negative(expression: Expression) -> float | str:
    """Return the negative of a number or formula: `-g` becomes `g`, and `-a*deg` `a*deg`."""
    source = expression.source
    if not isinstance(source, str):
        return plain(-source)
    tree = _tree(source.strip())
    if isinstance(tree, ast.UnaryOp) and isinstance(tree.op, ast.USub):
        return _unbracketed(source.strip()[1:].strip())
    if source.strip().startswith("-") and _is_negative(tree):
        return source.strip()[1:].strip()
    return f"-{_bracketed(source.strip())}"


def rounded(value: float) -> float:
    """Return a length or an angle without the digits that are rounding errors."""
    return float(f"{value:.{DIGITS}g}") if abs(value) > 10.0**-DIGITS else 0.0


def sum_of(parts: Mapping[str, float]) -> Json:
    """Return a linear combination of functions as a formula; `""` stands for the constant 1."""
    terms = ""
    for function, factor in parts.items():
        if size := plain(abs(rounded(factor))):
            sign = ("-" if factor < 0 else "") if not terms else (" - " if factor < 0 else " + ")
            number = repr(size) if not function or size != 1 else ""
            terms += sign + "*".join(filter(None, (number, function)))
    return terms or 0


def _is_negative(tree: ast.expr) -> bool:
    """Return whether the first factor of a product has a minus sign, as that of `-a*b`."""
    while isinstance(tree, ast.BinOp) and isinstance(tree.op, ast.Mult | ast.Div):
        tree = tree.left
    return isinstance(tree, ast.UnaryOp) and isinstance(tree.op, ast.USub)


def towards(expression: Expression, value: float, values: Values) -> float | str:
    """Return a new value for an expression; a formula is shifted by a constant to this value."""
    if not expression.names:
        return plain(value)
    return shifted(expression, value - expression(values))


def rotated(angle: Expression, by: float) -> float | str:
    """Return an angle plus a constant [rad]; a number becomes a formula in degrees."""
    if angle.names:
        return shifted(angle, by)
    number = plain(round(degrees(angle({}) + by), ROUND))
    return f"{number!r}*deg" if number else 0


def renamed(source: str, name: str, new: str) -> str:
    """Return a formula in which a parameter is renamed."""
    return re.sub(rf"(?<![\w.]){re.escape(name)}(?!\w)", new, source)


def _apart(source: str) -> tuple[str, float]:
    """Split a formula into that without the number added at its end, and this number."""
    tree = _tree(source)
    if isinstance(tree, ast.BinOp) and isinstance(last := tree.right, ast.Constant):
        before, behind = source[: last.col_offset].rstrip(), source[last.end_col_offset :]
        if before.endswith(("+", "-")) and not behind.strip():  # neither operand is in brackets
            sign = -1 if isinstance(tree.op, ast.Sub) else 1
            return before[:-1].rstrip(), sign * float(str(last.value))
    return (f"({source})" if isinstance(tree, _LOOSE) else source), 0.0


def _tree(source: str) -> ast.expr:
    return ast.parse(source, mode="eval").body


def _bracketed(source: str) -> str:
    return source if isinstance(_tree(source), _TIGHT) else f"({source})"


def _unbracketed(source: str) -> str:
    """Return a formula without brackets around the whole."""
    inner = source[1:-1]
    if source.startswith("(") and source.endswith(")"):
        try:
            same = ast.dump(_tree(inner)) == ast.dump(_tree(source))
        except SyntaxError:
            same = False
        return inner if same else source
    return source
