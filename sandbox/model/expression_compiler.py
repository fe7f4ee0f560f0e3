"""The arithmetic of expressions: the subset of Python that they may use, and its compilation.

An expression is Python's arithmetic and nothing else: no attributes, no subscripts, and no calls
except of the listed functions. Every literal is a float, so that no value exceeds a float's range,
and the length of the source is bounded, which bounds the time. A condition is 1 if true, else 0.
"""

import ast
import re
import warnings
from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from types import CodeType
from typing import Any

import numpy as np

from sandbox.model.did_you_mean import suggestion
from sandbox.model.errors import SandboxError, brief
from sandbox.model.symbolic_derivatives import derivative
from sandbox.model.translatable_message import NOTHING, Message

MAX_LENGTH = 500  # characters

CONSTANTS: Mapping[str, float] = {"pi": np.pi, "deg": np.pi / 180}

FUNCTIONS: Mapping[str, Callable[..., Any]] = {
    "abs": np.abs,
    "acos": np.arccos,
    "asin": np.arcsin,
    "atan": np.arctan,
    "atan2": np.arctan2,
    "ceil": np.ceil,
    "cos": np.cos,
    "cosh": np.cosh,
    "exp": np.exp,
    "floor": np.floor,
    "hypot": np.hypot,
    "log": np.log,
    "max": np.maximum,
    "min": np.minimum,
    "sign": np.sign,
    "sin": np.sin,
    "sinh": np.sinh,
    "sqrt": np.sqrt,
    "tan": np.tan,
    "tanh": np.tanh,
    "where": np.where,
}

RESERVED = frozenset({"t", *CONSTANTS, *FUNCTIONS})

_ARGUMENTS = {"atan2": 2, "hypot": 2, "max": 2, "min": 2, "where": 3}
_OPERATORS = (ast.Add, ast.Sub, ast.Mult, ast.Div, ast.Mod, ast.Pow)
_COMPARISONS = (ast.Lt, ast.LtE, ast.Gt, ast.GtE, ast.Eq, ast.NotEq)
_REFUSED: Mapping[str, Message] = {
    "Attribute": Message("a dot is allowed only in a number"),
    "List": Message("one number is needed, not a list"),
    "Set": Message("one number is needed, not a list"),
    "Starred": Message("* needs a number on both sides"),
    "Subscript": Message("square brackets have no meaning here"),
    "Tuple": Message("one number is needed; a decimal point is written ., not a comma"),
}
ONLY_ARITHMETIC = Message("only arithmetic is allowed")
_SLIPS: Sequence[tuple[re.Pattern[str], Message]] = (
    (re.compile("°"), Message("; an angle in degrees is written 30*deg")),
    (re.compile(r"(?<![<>=!])=(?!=)"), Message("; write only what is right of the =")),
    (
        re.compile(r"^[\d.]+(\s*(kg|[ckm]m|ms|Hz|rad|N/m|m/s.*|kg.*)|\s+[JNsW])$"),
        Message("; write no unit, all numbers are in SI units"),
    ),
    (re.compile(r"[\d)]\s*[A-Za-z(]"), Message("; a product is written 2*m, not 2m")),
)
"""How formulas look that are written as on paper, and what to write instead."""

_NAMESPACE = {
    "__builtins__": {},
    **CONSTANTS,
    **FUNCTIONS,
    " and": np.logical_and,  # a name that no source can spell
    " or": np.logical_or,
    " not": np.logical_not,
    " power": np.power,  # not finite where Python's ** turns complex or raises
}


class ExpressionError(SandboxError, ValueError):
    """An expression that is not allowed, or has no finite value."""


def evaluated(code: CodeType, scope: Mapping[str, Any]) -> Any:  # noqa: ANN401 (a float or an array)
    """Return the value of a compiled expression, finite or not; the scope has all of its names."""
    return eval(code, _NAMESPACE, scope)  # the tree has passed `_Rewrite`


@lru_cache(maxsize=2000)
def compiled(source: str) -> tuple[CodeType, frozenset[str]]:
    """Return the code of an expression that has been checked, and the names in it."""
    if len(source) > MAX_LENGTH:
        raise ExpressionError("is longer than {most} characters", most=MAX_LENGTH)
    return _made(source)


@lru_cache(maxsize=2000)
def differentiated(source: str, variable: str) -> tuple[CodeType, frozenset[str]]:
    """Return the code of the derivative of an expression, and the names in it."""
    try:
        return _made(derivative(source, variable))
    except (RecursionError, ExpressionError):
        raise ExpressionError(
            "'{source}' is nested too deeply to be differentiated", source=brief(source)
        ) from None


def _made(source: str) -> tuple[CodeType, frozenset[str]]:
    rewrite = _Rewrite()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # Python's warnings are errors here
            tree = rewrite.visit(ast.parse(source.strip(), mode="eval"))
            code = compile(tree, "<expression>", "eval")
    except ExpressionError as error:
        raise ExpressionError(
            "'{source}': {error}", source=brief(source), error=error.message
        ) from None
    except (SyntaxError, ValueError):
        hint = next((hint for form, hint in _SLIPS if form.search(source)), NOTHING)
        raise ExpressionError(
            "'{source}' is not arithmetic{hint}", source=brief(source), hint=hint
        ) from None
    except (RecursionError, MemoryError):
        raise ExpressionError("'{source}' is nested too deeply", source=brief(source)) from None
    return code, frozenset(rewrite.names)


class _Rewrite(ast.NodeTransformer):
    """Refuses anything but arithmetic, and makes it work on floats and on arrays alike."""

    def __init__(self) -> None:
        self.names: set[str] = set()

    def generic_visit(self, node: ast.AST) -> ast.AST:
        allowed = (ast.Expression, ast.operator, ast.unaryop, ast.cmpop, ast.expr_context)
        if not isinstance(node, allowed):
            raise ExpressionError(_REFUSED.get(type(node).__name__, ONLY_ARITHMETIC))
        return super().generic_visit(node)

    def visit_Constant(self, node: ast.Constant) -> ast.AST:
        if isinstance(node.value, bool) or not isinstance(node.value, int | float):
            raise ExpressionError("{value} is not a number", value=brief(repr(node.value)))
        try:
            return ast.Constant(float(node.value), lineno=1, col_offset=0)
        except OverflowError:
            raise ExpressionError("a number is too large") from None

    def visit_Name(self, node: ast.Name) -> ast.AST:
        if node.id in FUNCTIONS:
            raise ExpressionError(
                "the function '{name}' needs its arguments in brackets", name=node.id
            )
        if node.id not in CONSTANTS:
            self.names.add(node.id)
        return node

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        if isinstance(node.op, ast.BitXor):
            raise ExpressionError("a power is written **, not ^")
        if not isinstance(node.op, _OPERATORS):
            raise ExpressionError("only +, -, *, /, % and ** join numbers")
        if isinstance(node.op, ast.Pow):
            return _call(" power", [self.visit(node.left), self.visit(node.right)])
        return super().generic_visit(node)

    def visit_UnaryOp(self, node: ast.UnaryOp) -> ast.AST:
        if isinstance(node.op, ast.Not):
            return _truth(_call(" not", [self.visit(node.operand)]))
        if not isinstance(node.op, ast.UAdd | ast.USub):
            raise ExpressionError("only +, - and not may stand before a number")
        return super().generic_visit(node)

    def visit_Compare(self, node: ast.Compare) -> ast.AST:
        if len(node.ops) > 1:
            raise ExpressionError("write 'a < b and b < c' instead of 'a < b < c'")
        if not isinstance(node.ops[0], _COMPARISONS):
            raise ExpressionError("only <, <=, >, >=, == and != compare numbers")
        left, right = self.visit(node.left), self.visit(node.comparators[0])
        return _truth(ast.Compare(left, node.ops, [right], lineno=1, col_offset=0))

    def visit_BoolOp(self, node: ast.BoolOp) -> ast.AST:
        name = " and" if isinstance(node.op, ast.And) else " or"
        first: ast.expr = self.visit(node.values[0])
        rest = [self.visit(value) for value in node.values[1:]]
        for value in rest:
            first = _truth(_call(name, [first, value]))
        return first

    def visit_IfExp(self, node: ast.IfExp) -> ast.AST:
        return _call("where", [self.visit(part) for part in (node.test, node.body, node.orelse)])

    def visit_Call(self, node: ast.Call) -> ast.AST:
        if not isinstance(node.func, ast.Name) or node.func.id not in FUNCTIONS:
            name = brief(ast.unparse(node.func))
            raise ExpressionError(
                "'{name}' is not a function here{hint}", name=name, hint=suggestion(name, FUNCTIONS)
            )
        name, count = node.func.id, _ARGUMENTS.get(node.func.id, 1)
        if node.keywords or len(node.args) != count:
            takes = Message("{name}() takes {count} arguments", name=name, count=count)
            raise ExpressionError(
                takes if count > 1 else Message("{name}() takes 1 argument", name=name)
            )
        return _call(name, [self.visit(argument) for argument in node.args])


def _call(name: str, arguments: list[ast.expr]) -> ast.Call:
    function = ast.Name(name, ast.Load(), lineno=1, col_offset=0)
    return ast.Call(function, arguments, [], lineno=1, col_offset=0)


def _truth(condition: ast.expr) -> ast.BinOp:
    """Make a condition 1 or 0: numpy's own booleans neither subtract nor add up."""
    one = ast.Constant(1.0, lineno=1, col_offset=0)
    return ast.BinOp(condition, ast.Mult(), one, lineno=1, col_offset=0)
