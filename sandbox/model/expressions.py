"""Numbers that may be written as formulas over a level's parameters.

An expression is Python's arithmetic and nothing else: no attributes, no subscripts, no calls but
the listed functions. Every literal is a float, so nothing can grow beyond a float's range, and the
length of the source is bounded, so nothing can take long. A condition is 1 where it holds, else 0.
"""

import ast
import re
import warnings
from collections.abc import Callable, Mapping
from functools import lru_cache
from types import CodeType
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from sandbox.model.errors import SandboxError, brief
from sandbox.model.suggest import suggestion

Array = NDArray[np.float64]
Values = Mapping[str, float]

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

_PRODUCT = re.compile(r"[\d)]\s*[A-Za-z(]")  # as it is written on paper
_ARGUMENTS = {"atan2": 2, "hypot": 2, "max": 2, "min": 2, "where": 3}
_OPERATORS = (ast.Add, ast.Sub, ast.Mult, ast.Div, ast.Mod, ast.Pow)
_COMPARISONS = (ast.Lt, ast.LtE, ast.Gt, ast.GtE, ast.Eq, ast.NotEq)
_REFUSED: Mapping[str, str] = {
    "Attribute": "a dot may stand in a number only",
    "List": "one number is needed, not a list",
    "Set": "one number is needed, not a list",
    "Starred": "* needs a number on both sides",
    "Subscript": "square brackets have no meaning here",
    "Tuple": "one number is needed; a decimal point is written ., not a comma",
}
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


class Expression:
    """A finite number, or a formula for one.

    Parameters
    ----------
    source
        A number, or arithmetic over parameters, ``pi``, ``deg`` and the functions of `FUNCTIONS`.

    Raises
    ------
    ExpressionError
        If the source is anything else.
    """

    __slots__ = ("_code", "_constant", "_defined", "names", "source", "written")

    _code: CodeType | None
    _constant: float | None
    _defined: "Definitions"

    rule: ClassVar[str] = ""
    """What a value must satisfy, in words; empty if any finite number will do."""
    bounds: ClassVar[Mapping[str, float]] = {}
    """The rule for a literal number, in the words of JSON Schema."""
    least: ClassVar[float] = 0.0
    most: ClassVar[float] = 1e100
    """How small and how large a value may be, whatever its sign: within these bounds, and the
    tighter ones of `sandbox.model.bounds`, what a run computes from it stays within a float's."""
    unit: ClassVar[str] = ""
    """SI, of the value."""
    variable: ClassVar[str] = ""
    """What the expression may use beside the parameters, such as the time ``t``."""

    source: float | str
    written: frozenset[str]
    """The names in its text."""
    names: frozenset[str]
    """The names on whose values its own depends: as they are written, but for constants."""

    def __init__(self, source: float | str) -> None:
        self.source = source if isinstance(source, str) else _number(source)
        self._defined = ()
        if isinstance(self.source, str):
            self._code, self.written = _compiled(self.source)
            self.names = self.written
            self._constant = None if self.written else self._finite(self._evaluate({}))
        else:
            self._code, self.written, self.names = None, frozenset(), frozenset()
            self._constant = self._finite(self.source)

    def define(self, constants: Mapping[str, "Expression"]) -> None:
        """Let names in its text stand for constants.

        Parameters
        ----------
        constants
            By name, in such an order that each uses only those before it.
        """
        names, used = set(self.written), list[tuple[str, Expression]]()
        for name, constant in reversed([*constants.items()]):
            if name in names:
                names |= constant.written
                used.append((name, constant))
        self.taking(tuple(reversed(used)))

    def taking(self, defined: "Definitions") -> Self:
        """Return itself, with the values of its constants computed before its own."""
        names = self.written.union(*(constant.written for _, constant in defined))
        self.names = names.difference(name for name, _ in defined)
        self._defined = defined
        return self

    def __call__(self, values: Values) -> float:
        """Return the value for the given parameters.

        Raises
        ------
        ExpressionError
            If the value is not finite or breaks the expression's rule.
        """
        if self._constant is not None:
            return self._constant
        return self._finite(self._evaluate(values))

    def _evaluate(self, values: Mapping[str, Any]) -> Any:  # noqa: ANN401 (a float or an array)
        scope = {name: np.asarray(values[name], dtype=float)[()] for name in self.names}
        try:
            with np.errstate(all="ignore"):
                for name, constant in self._defined:
                    scope[name] = constant.within(scope)
                return self.within(scope)
        except ZeroDivisionError:
            raise ExpressionError(f"{self._shown}divides by zero") from None

    def within(self, scope: Mapping[str, Any]) -> Any:  # noqa: ANN401 (a float or an array)
        """Return the value, finite or not, where every name in its text has one."""
        if self._code is None:
            return self._constant
        return eval(self._code, _NAMESPACE, scope)  # the tree has passed _parse

    @property
    def _shown(self) -> str:
        return f"'{brief(self.source)}' " if isinstance(self.source, str) else ""

    def _finite(self, result: Any) -> float:  # noqa: ANN401 (a float or an array)
        value = float(result)
        if not np.isfinite(value):
            raise ExpressionError(f"{self._shown}is {value:g}, not a finite number")
        if not self._holds(value):
            raise ExpressionError(f"{self._shown}is {value:g}, but must be {self.rule}")
        if beyond := self.beyond(value):
            raise ExpressionError(f"{self._shown}is {value:g}{self._unit}, {beyond}")
        return value

    @classmethod
    def beyond(cls, value: float) -> str:
        """Say that a value is too large or too small to be computed with; empty if it is not."""
        unit = f" {cls.unit}" if cls.unit else ""
        if not abs(value) <= cls.most:
            bound = f"at least {-cls.most:g}" if value < 0 else f"at most {cls.most:g}"
            return f"but must be {bound}{unit}; what is computed from numbers beyond overflows"
        if abs(value) < cls.least:
            bound = f"at least {cls.least:g}{unit}"
            return f"but must be {bound}; what is computed from smaller numbers underflows"
        return ""

    @property
    def _unit(self) -> str:
        return f" {self.unit}" if self.unit else ""

    @staticmethod
    def _holds(value: float) -> bool:  # noqa: ARG004 (subclasses look at it)
        return True

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Expression):
            return NotImplemented
        return (type(self), self.source) == (type(other), other.source)

    def __hash__(self) -> int:
        return hash((type(self), self.source))

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.source!r})"

    def __reduce__(self) -> tuple[Any, ...]:
        if self._defined:
            return _restored, (type(self), self.source, self._defined)
        return type(self), (self.source,)  # code cannot be pickled

    @classmethod
    def _validate(cls, source: object) -> Self:
        if isinstance(source, cls):
            return source
        if isinstance(source, bool) or not isinstance(source, int | float | str):
            raise PydanticCustomError("expression", "must be a number or an expression")
        try:
            return cls(source)
        except ExpressionError as error:
            raise PydanticCustomError("expression", "{reason}", {"reason": str(error)}) from None

    @classmethod
    def __get_pydantic_core_schema__(cls, _: Any, __: GetCoreSchemaHandler) -> CoreSchema:  # noqa: ANN401
        return core_schema.no_info_plain_validator_function(
            cls._validate,
            serialization=core_schema.plain_serializer_function_ser_schema(lambda e: e.source),
        )

    @classmethod
    def __get_pydantic_json_schema__(
        cls, _: CoreSchema, __: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        over = f"a formula over the parameters and {cls.variable}"
        what = over if cls.variable else "an expression"
        return {
            "type": ["number", "string"],
            "maxLength": MAX_LENGTH,
            **cls._limits(),
            "$comment": f"A number or {what}{', ' + cls.rule if cls.rule else ''}.",
        }

    @classmethod
    def _limits(cls) -> dict[str, float]:
        """Return what a literal number must satisfy, in the words of JSON Schema."""
        said = {"maximum": cls.most, **cls.bounds}
        if cls.least or not cls.bounds:
            said["minimum"] = cls.least or -cls.most
        return said


Definitions = tuple[tuple[str, Expression], ...]
"""Constants by their names, each after those that it uses."""


def _restored(kind: type[Expression], source: str, defined: Definitions) -> Expression:
    """Return an expression that has been pickled together with its constants."""
    return kind(source).taking(defined)


class Positive(Expression):
    """An expression whose value must be greater than zero."""

    __slots__ = ()
    rule = "greater than 0"
    bounds: ClassVar = {"exclusiveMinimum": 0}

    @staticmethod
    def _holds(value: float) -> bool:
        return value > 0


class NonNegative(Expression):
    """An expression whose value must not be negative."""

    __slots__ = ()
    rule = "at least 0"
    bounds: ClassVar = {"minimum": 0}

    @staticmethod
    def _holds(value: float) -> bool:
        return value >= 0


class Fraction(Expression):
    """An expression whose value must lie between zero and one."""

    __slots__ = ()
    rule = "between 0 and 1"
    bounds: ClassVar = {"minimum": 0, "maximum": 1}

    @staticmethod
    def _holds(value: float) -> bool:
        return 0 <= value <= 1


class Formula(Expression):
    """An expression that may also use the time ``t``, at one instant or over many at once."""

    __slots__ = ()
    variable = "t"

    def over(self, values: Values, t: Array) -> Array:
        """Return the value at each time; where there is none, it is not finite.

        Parameters
        ----------
        values
            The level's parameters.
        t
            Times [s], any shape; the result has the same.
        """
        result = self._evaluate({**values, self.variable: t}) if self._code else self._constant
        found = np.asarray(result, dtype=float)
        return found if found.shape == np.shape(t) else np.broadcast_to(found, np.shape(t))


class Curve(Formula):
    """A coordinate of a curve: a formula over ``s``, which runs along it, instead of the time."""

    __slots__ = ()
    variable = "s"


class Profile(Formula):
    """A formula over a place ``x`` [m] instead of the time."""

    __slots__ = ()
    variable = "x"


VARIABLES = frozenset(kind.variable for kind in (Formula, Curve, Profile))
"""What some formulas may use beside the parameters."""


def _number(source: float) -> float:
    try:
        return float(source)
    except OverflowError:
        raise ExpressionError("is too large a number") from None


@lru_cache(maxsize=2000)
def _compiled(source: str) -> tuple[CodeType, frozenset[str]]:
    """Return the code of an expression that has been checked, and the names that it uses."""
    if len(source) > MAX_LENGTH:
        raise ExpressionError(f"is longer than {MAX_LENGTH} characters")
    rewrite = _Rewrite()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # what Python only warns of is no arithmetic either
            tree = rewrite.visit(ast.parse(source.strip(), mode="eval"))
            code = compile(ast.fix_missing_locations(tree), "<expression>", "eval")
    except ExpressionError as error:
        raise ExpressionError(f"'{brief(source)}': {error}") from None
    except (SyntaxError, ValueError):
        hint = "; a product is written 2*m, not 2m" if _PRODUCT.search(source) else ""
        raise ExpressionError(f"'{brief(source)}' is not arithmetic{hint}") from None
    except (RecursionError, MemoryError):
        raise ExpressionError(f"'{brief(source)}' is nested too deeply") from None
    return code, frozenset(rewrite.names)


class _Rewrite(ast.NodeTransformer):
    """Refuses what is not arithmetic, and makes the rest work on floats and on arrays alike."""

    def __init__(self) -> None:
        self.names: set[str] = set()

    def generic_visit(self, node: ast.AST) -> ast.AST:
        allowed = (ast.Expression, ast.operator, ast.unaryop, ast.cmpop, ast.expr_context)
        if not isinstance(node, allowed):
            raise ExpressionError(_REFUSED.get(type(node).__name__, "only arithmetic is allowed"))
        return super().generic_visit(node)

    def visit_Constant(self, node: ast.Constant) -> ast.AST:
        if isinstance(node.value, bool) or not isinstance(node.value, int | float):
            raise ExpressionError(f"{brief(repr(node.value))} is not a number")
        try:
            return ast.Constant(float(node.value))
        except OverflowError:
            raise ExpressionError("a number is too large") from None

    def visit_Name(self, node: ast.Name) -> ast.AST:
        if node.id in FUNCTIONS:
            raise ExpressionError(f"the function '{node.id}' needs its arguments in brackets")
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
        return _truth(ast.Compare(left, node.ops, [right]))

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
            raise ExpressionError(f"'{name}' is not a function here{suggestion(name, FUNCTIONS)}")
        name, count = node.func.id, _ARGUMENTS.get(node.func.id, 1)
        if node.keywords or len(node.args) != count:
            raise ExpressionError(f"{name}() takes {count} argument{'s' if count > 1 else ''}")
        return _call(name, [self.visit(argument) for argument in node.args])


def _call(name: str, arguments: list[ast.expr]) -> ast.Call:
    return ast.Call(ast.Name(name, ast.Load()), arguments, [])


def _truth(condition: ast.expr) -> ast.BinOp:
    """Make 1 or 0 of a condition: numpy's own truth values neither subtract nor add up."""
    return ast.BinOp(condition, ast.Mult(), ast.Constant(1.0))
