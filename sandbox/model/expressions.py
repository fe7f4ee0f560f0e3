"""Numbers that may be written as formulas in a level's parameters."""

from collections.abc import Mapping
from math import isfinite
from types import CodeType
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from sandbox.model.errors import brief
from sandbox.model.expression_compiler import MAX_LENGTH, ExpressionError, compiled, evaluated
from sandbox.model.translatable_message import NOTHING, Message

Array = NDArray[np.float64]
Values = Mapping[str, float]


class Expression:
    """A finite number, or a formula for one.

    A formula is arithmetic with parameters, ``pi``, ``deg`` and the functions of `FUNCTIONS`.
    Raises `ExpressionError` if the source is anything else.
    """

    _code: CodeType | None
    _constant: float | None
    _defined: "Definitions"

    rule: ClassVar[Message] = NOTHING
    """The condition on a value, in words; empty if any finite number is valid."""
    bounds: ClassVar[Mapping[str, float]] = {}
    """The condition on a literal number, as JSON Schema keywords."""
    least: ClassVar[float] = 0.0
    most: ClassVar[float] = 1e100
    """The least and the largest absolute value: within these bounds, and the tighter ones of
    `sandbox.model.number_bounds`, the results of a run stay within the range of a float."""
    unit: ClassVar[str] = ""
    """The SI unit of the value."""
    variables: ClassVar[tuple[str, ...]] = ()
    """The variables in addition to the parameters, such as the time ``t``."""

    source: float | str
    names_written: frozenset[str]
    """The names in its text."""
    names: frozenset[str]
    """The parameters and variables that its value depends on, with constants resolved."""

    def __init_subclass__(cls, **facts: object) -> None:
        """Set class attributes, such as `most`, that are given with the bases."""
        super().__init_subclass__()
        for name, value in facts.items():
            setattr(cls, name, value)

    def __init__(self, source: float | str) -> None:
        self.source = source if isinstance(source, str) else _number(source)
        self._defined = ()
        if isinstance(self.source, str):
            self._code, self.names_written = compiled(self.source)
            self.names = self.names_written
            self._constant = None if self.names_written else self._finite(self._evaluate({}))
        else:
            self._code, self.names_written, self.names = None, frozenset(), frozenset()
            self._constant = self._finite(self.source)

    def define(self, constants: Mapping[str, "Expression"]) -> None:
        """Define names in its text as constants, each after those that it uses."""
        names, used = set(self.names_written), list[tuple[str, Expression]]()
        for name, constant in reversed([*constants.items()]):
            if name in names:
                names |= constant.names_written
                used.append((name, constant))
        self.with_constants(tuple(reversed(used)))

    def with_constants(self, constants: "Definitions") -> Self:
        """Return itself, with the values of constants computed before its own."""
        names = self.names_written.union(*(constant.names_written for _, constant in constants))
        self.names = names.difference(name for name, _ in constants)
        self._defined = constants
        return self

    def __call__(self, values: Values) -> float:
        """Return the value; raise `ExpressionError` if it is not finite or breaks the rule."""
        if self._constant is not None:
            return self._constant
        return self._finite(self._evaluate(values))

    def _evaluate(self, values: Mapping[str, Any]) -> Any:  # noqa: ANN401 (a float or an array)
        scope = {name: _scalar(values[name]) for name in self.names}
        try:
            with np.errstate(all="ignore"):
                for name, constant in self._defined:
                    scope[name] = constant.within(scope)
                return self.within(scope)
        except ZeroDivisionError:
            raise ExpressionError("{shown}divides by zero", shown=self._shown) from None

    def within(self, scope: Mapping[str, Any]) -> Any:  # noqa: ANN401 (a float or an array)
        """Return the value, finite or not, in a scope that has every name in its text."""
        if self._code is None:
            return self._constant
        return evaluated(self._code, scope)

    @property
    def _shown(self) -> str:
        return f"'{brief(self.source)}' " if isinstance(self.source, str) else ""

    def _finite(self, result: Any) -> float:  # noqa: ANN401 (a float or an array)
        value = float(result)
        if not isfinite(value):
            text = Message("is {value:g}, not a finite number", value=value)
        elif not self._holds(value):
            text = Message("is {value:g}, but must be {rule}", value=value, rule=self.rule)
        elif fault := self.range_fault(value):
            shown_value = f"{value:g}{self._unit}"
            text = Message("is {given}, {beyond}", given=shown_value, beyond=fault)
        else:
            return value
        raise ExpressionError("{shown}{told}", shown=self._shown, told=text)

    @classmethod
    def range_fault(cls, value: float) -> Message:
        """Say that a value is too large or too small for computation; empty if it is not."""
        unit = f" {cls.unit}" if cls.unit else ""
        if not abs(value) <= cls.most:
            bound = Message("at most {most:g}{unit}", most=cls.most, unit=unit)
            if value < 0:
                bound = Message("at least {least:g}{unit}", least=-cls.most, unit=unit)
            return Message(
                "but must be {bound}; numbers beyond that overflow in computations", bound=bound
            )
        if abs(value) < cls.least:
            bound = Message("at least {least:g}{unit}", least=cls.least, unit=unit)
            return Message(
                "but must be {bound}; smaller numbers underflow in computations", bound=bound
            )
        return NOTHING

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
            raise PydanticCustomError(
                "expression", "{reason}", {"reason": Message("must be a number or an expression")}
            )
        try:
            return cls(source)
        except ExpressionError as error:
            raise PydanticCustomError("expression", "{reason}", {"reason": error.message}) from None

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
        formula = f"a formula in the parameters and {', '.join(cls.variables)}"
        what = formula if cls.variables else "an expression"
        return {
            "type": ["number", "string"],
            "maxLength": MAX_LENGTH,
            **cls._limits(),
            "$comment": f"A number or {what}{', ' + cls.rule if cls.rule else ''}.",
        }

    @classmethod
    def _limits(cls) -> dict[str, float]:
        """Return the conditions on a literal number, as JSON Schema keywords."""
        said = {"maximum": cls.most, **cls.bounds}
        if cls.least or not cls.bounds:
            said["minimum"] = cls.least or -cls.most
        return said


Definitions = tuple[tuple[str, Expression], ...]
"""Constants by their names, each after those that it uses."""


def _restored(kind: type[Expression], source: str, defined: Definitions) -> Expression:
    """Return an unpickled expression, with its constants."""
    return kind(source).with_constants(defined)


class Positive(Expression):
    """An expression whose value must be greater than zero."""

    rule = Message("greater than 0")
    bounds: ClassVar = {"exclusiveMinimum": 0}

    @staticmethod
    def _holds(value: float) -> bool:
        return value > 0


class NonNegative(Expression):
    """An expression whose value must not be negative."""

    rule = Message("at least 0")
    bounds: ClassVar = {"minimum": 0}

    @staticmethod
    def _holds(value: float) -> bool:
        return value >= 0


class Fraction(Expression):
    """An expression whose value must lie between zero and one."""

    rule = Message("between 0 and 1")
    bounds: ClassVar = {"minimum": 0, "maximum": 1}

    @staticmethod
    def _holds(value: float) -> bool:
        return 0 <= value <= 1


def _scalar(value: Any) -> Any:  # noqa: ANN401 (a float or an array)
    """Return a number as a NumPy scalar, which divides by zero silently; an array as it is."""
    return np.float64(value) if isinstance(value, float) else np.asarray(value, dtype=float)[()]


def _number(source: float) -> float:
    try:
        return float(source)
    except OverflowError:
        raise ExpressionError("is too large a number") from None
