"""Reads cases from tables, and evaluates their closed forms.

Each phenomenon has a file of tables, `validation/cases/<phenomenon>.toml`;
docs/how-to/add-a-case.md describes their content.
"""

import builtins
import json
import math
import tomllib
from cmath import rect
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from types import CodeType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from pydantic import TypeAdapter

from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Array, Values
from sandbox.model.level import Instant
from sandbox.model.level_parts import names_in
from validation.case import FOURTH_ORDER, SECOND_ORDER, Case, Parameters, ends, textbook
from validation.formulas import (
    chapter_code,
    energy,
    kinematics,
    lagrange,
    leapfrog,
    machines,
    mechanisms,
    momentum,
    newton,
    pulleys,
    rotation,
)

FOLDER = Path(__file__).parent / "cases"

MODULES = (
    chapter_code, energy, kinematics, lagrange, leapfrog, machines, mechanisms, momentum, newton,
    pulleys, rotation,
)  # fmt: skip

NAMES: Mapping[str, object] = {
    **{name: value for name, value in vars(math).items() if not name.startswith("_")},
    **{module.__name__.rpartition(".")[2]: module for module in MODULES},
    "np": np,
    "rect": rect,
}
"""The names that a closed form may use, besides Python's built-ins and `own`."""

ORDERS = {2: SECOND_ORDER, 4: FOURTH_ORDER}

TABLE = frozenset({"level", "over", "each", "case"})
NEEDED = ("name", "quantity", "formula", "tolerance", "because")
FREE = ("at", "duration", "misses", "order")

_INSTANT: TypeAdapter[Instant] = TypeAdapter(Instant)


class TableError(SandboxError):
    """A mistake in a table, with its file, its case, and the reason."""


@dataclass(frozen=True, slots=True)
class ClosedForm:
    """A formula in a table, of a level's parameters and of the sampled times, `t` [s].

    `p` is the mapping of all parameters, for functions of `own` that take it.
    """

    source: str
    names: Mapping[str, object] = field(repr=False)
    code: CodeType = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "code", compile(self.source, "formula", "eval"))

    def __call__(self, values: Values, t: Array) -> ArrayLike:
        """Return the expected values."""
        scope = {**self.names, **values, "p": values, "t": t}
        found: ArrayLike = eval(self.code, scope)  # written here, not by authors of levels
        return found

    def unknown(self, parameters: Sequence[str]) -> list[str]:
        """Return the unknown names in it."""
        local = set(self.code.co_names) - {"p", "t", *self.names, *parameters, *vars(builtins)}
        return sorted(name for name in local if f".{name}" not in self.source)


@cache
def read(phenomenon: str) -> tuple[Case, ...]:
    """Return the cases of a phenomenon; raise `TableError` if its file has a mistake."""
    path = FOLDER / f"{phenomenon}.toml"
    try:
        tables = tomllib.loads(path.read_text(encoding="utf-8")).get("table", ())
    except tomllib.TOMLDecodeError as error:
        raise TableError(f"{path}: is not TOML: {error}") from error
    if not tables:
        raise TableError(f"{path}: has no [[table]]")
    return tuple(case for table in tables for case in _expanded(path, table))


@cache
def _names(phenomenon: str) -> Mapping[str, object]:
    """Return the names for the formulas of a phenomenon, including its own module."""
    name = f"validation.cases.functions.{phenomenon}"
    return {**NAMES, "own": import_module(name)} if find_spec(name) else NAMES


def _expanded(path: Path, table: Mapping[str, Any]) -> Iterator[Case]:
    """Yield a case for each row of a table, each choice of parameters, and each of `each`."""
    if odd := set(table) - TABLE - {*NEEDED, *FREE}:
        raise TableError(f"{path}: unknown key in a table: {', '.join(sorted(odd))}")
    if "level" not in table:
        raise TableError(f"{path}: a table needs a level")
    defaults = {name: table[name] for name in (*NEEDED, *FREE) if name in table}
    choices = _choices(table["level"], table.get("over", [{}]))
    for parameters in choices:
        for item in table.get("each", [{}]):
            for row in table.get("case", ()):
                given = {**defaults, **row}
                said = {name: _filled(value, item) for name, value in given.items()}
                yield _case(path, table["level"], parameters, said)


def _choices(level: str, over: Sequence[Mapping[str, Any]]) -> Iterator[Parameters]:
    for choice in over:
        if "ends" in choice:
            yield from ends(level, *choice["ends"])
        else:
            yield choice


def _filled(said: object, item: Mapping[str, object]) -> object:
    """Replace names in braces by the values of an item of `each`."""
    match said:
        case str() if item:
            return said.format(**item)
        case dict():
            return {name: _filled(value, item) for name, value in said.items()}
        case list():
            return [_filled(value, item) for value in said]
        case _:
            return said


def _case(path: Path, level: str, parameters: Parameters, said: Mapping[str, Any]) -> Case:
    where = f"{path}: case '{said.get('name', '?')}'"
    if missing := [name for name in NEEDED if name not in said]:
        raise TableError(f"{where} lacks {', '.join(missing)}")
    if odd := set(said) - {*NEEDED, *FREE}:
        raise TableError(f"{where}: unknown key: {', '.join(sorted(odd))}")
    expected, unknown = _formula(path.stem, level, said["formula"])
    if unknown:
        raise TableError(f"{where}: its formula has an unknown name: {', '.join(unknown)}")
    at = _instant(json.dumps(said["at"])) if "at" in said else None
    if strange := names_in(at) - set(textbook(level).parameters):
        names = ", ".join(sorted(strange))
        raise TableError(f"{where}: its 'at' has an unknown parameter: {names}")
    order = _number(said.get("order"))
    return Case(
        name=said["name"],
        level=level,
        quantity=said["quantity"],
        expected=expected,
        tolerance=float(said["tolerance"]),
        because=said["because"],
        parameters=parameters,
        at=at,
        duration=said.get("duration"),
        naive_misses=_number(said.get("misses")),
        order=None if order is None else ORDERS[int(order)],
    )


@cache
def _formula(phenomenon: str, level: str, source: str) -> tuple[ClosedForm, list[str]]:
    """Return a formula, and the unknown names in it."""
    formula = ClosedForm(source, _names(phenomenon))
    return formula, formula.unknown(list(textbook(level).parameters))


@cache
def _instant(text: str) -> Instant:
    return _INSTANT.validate_json(text)


def _number(said: float | str | None) -> float | None:
    """Return a number, which an item of `each` may have given as a text; None for 'none'."""
    return None if said is None or said == "none" else float(said)
