"""The derivative of an expression, as an expression: exact, by the rules of calculus.

Functions with jumps or corners (`where`, `abs`, `max`, ...) are differentiated piecewise; where two
pieces meet, the derivative is that of one of them.
"""

import ast
from collections.abc import Mapping
from functools import cache

RULES: Mapping[str, str] = {
    "abs": "sign(u)*du",
    "acos": "-du/sqrt(1 - u**2)",
    "asin": "du/sqrt(1 - u**2)",
    "atan": "du/(1 + u**2)",
    "atan2": "(v*du - u*dv)/(u**2 + v**2)",
    "ceil": "0",
    "cos": "-sin(u)*du",
    "cosh": "sinh(u)*du",
    "exp": "exp(u)*du",
    "floor": "0",
    "hypot": "(u*du + v*dv)/hypot(u, v)",
    "log": "du/u",
    "max": "where(u >= v, du, dv)",
    "min": "where(u <= v, du, dv)",
    "sign": "0",
    "sin": "cos(u)*du",
    "sinh": "cosh(u)*du",
    "sqrt": "du/(2*sqrt(u))",
    "tan": "(1 + tan(u)**2)*du",
    "tanh": "(1 - tanh(u)**2)*du",
    "where": "where(u, dv, dw)",
    "Add": "du + dv",
    "Sub": "du - dv",
    "Mult": "du*v + u*dv",
    "Div": "du/v - u*dv/v**2",
    "Mod": "du - floor(u/v)*dv",
    "UAdd": "du",
    "USub": "-du",
    "power of a constant": "u**v*log(u)*dv",
    "power to a constant": "v*u**(v - 1)*du",
    "power": "u**v*(dv*log(u) + v*du/u)",
}
"""The derivative of each function and operator of u, v and w, in terms of du, dv, dw."""

CORNERS = frozenset({"abs", "ceil", "floor", "max", "min", "sign", "where"})
"""The functions with jumps or corners."""

_ARGUMENTS = ("u", "v", "w")
_CORNERS = (ast.Mod, ast.IfExp, ast.Compare, ast.BoolOp, ast.Not)


def derivative(source: str, variable: str) -> str:
    """Return the derivative of an expression that is allowed, with respect to one of its names.

    Raises `RecursionError` if the expression is nested too deeply.
    """
    tree = ast.parse(source.strip(), mode="eval")
    return ast.unparse(_derived(tree.body, variable))


def is_smooth(source: str) -> bool:
    """Whether an expression uses no functions with jumps or corners."""
    nodes = list(ast.walk(ast.parse(source.strip(), mode="eval")))
    names = {node.id for node in nodes if isinstance(node, ast.Name)}
    return not (names & CORNERS or any(isinstance(node, _CORNERS) for node in nodes))


def _derived(node: ast.expr, variable: str) -> ast.expr:
    match node:
        case ast.Name(id=name):
            return _number(float(name == variable))
        case ast.IfExp(test=test, body=body, orelse=other):
            return _by_rule("where", (test, body, other), variable)
        case ast.Call(func=ast.Name(id=name), args=arguments):
            return _by_rule(name, arguments, variable)
        case ast.BinOp(op=ast.Pow(), left=base, right=exponent):
            return _by_rule(_kind_of_power(base, exponent, variable), (base, exponent), variable)
        case ast.BinOp(op=operator, left=left, right=right):
            return _by_rule(type(operator).__name__, (left, right), variable)
        case ast.UnaryOp(op=ast.UAdd() | ast.USub() as sign, operand=operand):
            return _by_rule(type(sign).__name__, (operand,), variable)
    return _number(0.0)  # a constant, or a condition


def _kind_of_power(base: ast.expr, exponent: ast.expr, variable: str) -> str:
    if not _uses(exponent, variable):
        return "power to a constant"
    return "power" if _uses(base, variable) else "power of a constant"


def _uses(node: ast.expr, variable: str) -> bool:
    return any(isinstance(part, ast.Name) and part.id == variable for part in ast.walk(node))


def _by_rule(rule: str, arguments: list[ast.expr] | tuple[ast.expr, ...], name: str) -> ast.expr:
    given = dict(zip(_ARGUMENTS, arguments, strict=False))
    slopes = {f"d{letter}": _derived(part, name) for letter, part in given.items()}
    if all(map(_is_zero, slopes.values())):
        return _number(0.0)
    return _Filled({**given, **slopes}).made(_template(rule))


@cache
def _template(rule: str) -> ast.expr:
    return ast.parse(RULES[rule], mode="eval").body


def _number(value: float) -> ast.Constant:
    return ast.Constant(value)


def _is_zero(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and node.value == 0


class _Filled:
    """Substitutes expressions into a rule, and leaves out terms that are multiplied by zero."""

    def __init__(self, letters: Mapping[str, ast.expr]) -> None:
        self._letters = letters

    def made(self, node: ast.expr) -> ast.expr:
        """Return a rule with its letters replaced by expressions."""
        match node:
            case ast.Name(id=name):
                return self._letters.get(name, node)
            case ast.Call(func=function, args=arguments):
                return ast.Call(function, [self.made(part) for part in arguments], [])
            case ast.Compare(left=left, ops=ops, comparators=[right]):
                return ast.Compare(self.made(left), ops, [self.made(right)])
            case ast.UnaryOp(op=sign, operand=operand):
                return ast.UnaryOp(sign, self.made(operand))
            case ast.BinOp(left=left, op=operator, right=right):
                return _joined(self.made(left), operator, self.made(right))
        return node


def _joined(left: ast.expr, operator: ast.operator, right: ast.expr) -> ast.expr:
    """Combine two expressions, leaving out factors of one, and terms and factors of zero."""
    match operator:
        case ast.Mult() if _is_zero(left) or _is_zero(right):
            return _number(0.0)
        case ast.Mult() if _is_one(right):
            return left
        case ast.Mult() if _is_one(left):
            return right
        case ast.Div() if _is_zero(left):
            return left
        case ast.Add() if _is_zero(left):
            return right
        case ast.Add() | ast.Sub() if _is_zero(right):
            return left
    return ast.BinOp(left, operator, right)


def _is_one(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and node.value == 1
