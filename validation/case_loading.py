"""Reads cases from tables, and evaluates their closed forms.

Each phenomenon has a file of tables, `validation/cases/<phenomenon>.toml`;
docs/how-to/add-a-case.md describes their content.
"""

import ast
import builtins
import json
import math
import tomllib
from cmath import rect
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from types import CodeType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from pydantic import TypeAdapter
from scipy.integrate import quad

from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Array, Values
from sandbox.model.level import Instant
from sandbox.model.level_parts import names_in
from sandbox.model.quantities import quantity
from validation.case import FOURTH_ORDER, SECOND_ORDER, Case, Parameters, ends, textbook
from validation.formulas import (
    assorted_mechanics_problems,
    energy,
    kinematics,
    leapfrog_error,
    mechanisms,
    momentum,
    newtons_laws,
    oscillators,
    pulleys,
    rotation,
    textbook_code,
)

FOLDER = Path(__file__).parent / "cases"

MODULES = (
    assorted_mechanics_problems, energy, kinematics, leapfrog_error, mechanisms, momentum,
    newtons_laws, oscillators, pulleys, rotation, textbook_code,
)  # fmt: skip

NAMES: Mapping[str, object] = {
    **{name: value for name, value in vars(math).items() if not name.startswith("_")},
    **{module.__name__.rpartition(".")[2]: module for module in MODULES},
    "np": np,
    "quad": quad,
    "rect": rect,
}
"""The names that a closed form may use, besides Python's built-ins and the table's definitions."""

ORDERS = {2: SECOND_ORDER, 4: FOURTH_ORDER}

TABLE = frozenset({"level", "over", "each", "case"})
NEEDED = ("name", "quantity", "formula", "tolerance", "because")
FREE = ("at", "duration", "misses", "order")

_INSTANT: TypeAdapter[Instant] = TypeAdapter(Instant)


class TableError(SandboxError):
    """A mistake in a table, with its file, its case, and the reason."""


@dataclass(frozen=True, slots=True)
class Formula:
    """An expression in a file of tables."""

    source: str
    code: CodeType = field(init=False, repr=False, compare=False)
    names: frozenset[str] = field(init=False, repr=False, compare=False)
    """The names that it takes from outside; not the arguments of its own functions."""

    def __post_init__(self) -> None:
        tree = ast.parse(self.source.strip(), "formula", "eval")
        parts = list(ast.walk(tree))
        named = [part for part in parts if isinstance(part, ast.Name)]
        own = {part.arg for part in parts if isinstance(part, ast.arg)}
        own |= {name.id for name in named if isinstance(name.ctx, ast.Store)}
        object.__setattr__(self, "code", compile(tree, "formula", "eval"))
        object.__setattr__(self, "names", frozenset(name.id for name in named) - own)


@dataclass(frozen=True, slots=True)
class ClosedForm:
    """A formula in a table, of a level's parameters and of the sampled times, `t` [s]."""

    formula: Formula
    defined: Mapping[str, Formula] = field(repr=False)
    """The definitions that it uses, each after those that it uses itself."""

    def __call__(self, values: Values, t: Array) -> ArrayLike:
        """Return the expected values."""
        scope = {**NAMES, **values, "t": t}
        for name, formula in self.defined.items():
            scope[name] = eval(formula.code, scope)  # written here, not by authors of levels
        found: ArrayLike = eval(self.formula.code, scope)
        return found

    def unknown(self, parameters: Sequence[str]) -> list[str]:
        """Return the unknown names in it, and in the definitions that it uses."""
        used = self.formula.names.union(*(each.names for each in self.defined.values()))
        known = {"t", *NAMES, *self.defined, *parameters, *vars(builtins)}
        return sorted(used - known)


@cache
def read(phenomenon: str) -> tuple[Case, ...]:
    """Return the cases of a phenomenon; raise `TableError` if its file has a mistake."""
    path = FOLDER / f"{phenomenon}.toml"
    try:
        said = tomllib.loads(path.read_text(encoding="utf-8"))
    except tomllib.TOMLDecodeError as error:
        raise TableError(f"{path}: is not TOML: {error}") from error
    if not (tables := said.get("table", ())):
        raise TableError(f"{path}: has no [[table]]")
    let = {name: Formula(source) for name, source in said.get("let", {}).items()}
    return tuple(case for table in tables for case in _expanded(path, let, table))


def _expanded(path: Path, let: Mapping[str, Formula], table: Mapping[str, Any]) -> Iterator[Case]:
    """Yield a case for each row of a table, each choice of parameters, and each of `each`."""
    if odd := set(table) - TABLE - {*NEEDED, *FREE}:
        raise TableError(f"{path}: unknown key in a table: {', '.join(sorted(odd))}")
    if "level" not in table:
        raise TableError(f"{path}: a table needs a level")
    try:
        textbook(table["level"])
    except SandboxError as error:
        raise TableError(f"{path}: {error}") from error
    defaults = {name: table[name] for name in (*NEEDED, *FREE) if name in table}
    choices = _choices(table["level"], table.get("over", [{}]))
    for parameters in choices:
        for item in table.get("each", [{}]):
            for row in table.get("case", ()):
                given = {**defaults, **row}
                said = {name: _filled(value, item) for name, value in given.items()}
                yield _case(path, let, table["level"], parameters, said)


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


def _case(
    path: Path,
    let: Mapping[str, Formula],
    level: str,
    parameters: Parameters,
    said: Mapping[str, Any],
) -> Case:
    where = f"{path}: case '{said.get('name', '?')}'"
    if missing := [name for name in NEEDED if name not in said]:
        raise TableError(f"{where} lacks {', '.join(missing)}")
    if odd := set(said) - {*NEEDED, *FREE}:
        raise TableError(f"{where}: unknown key: {', '.join(sorted(odd))}")
    try:
        quantity(said["quantity"], textbook(level))
    except SandboxError as error:
        raise TableError(f"{where}: {error}") from error
    expected = _closed_form(Formula(said["formula"]), let)
    if unknown := expected.unknown(list(textbook(level).parameters)):
        raise TableError(f"{where}: its formula has an unknown name: {', '.join(unknown)}")
    if twice := sorted(expected.defined.keys() & textbook(level).parameters):
        raise TableError(f"{where}: also the name of a parameter: {', '.join(twice)}")
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


def _closed_form(formula: Formula, let: Mapping[str, Formula]) -> ClosedForm:
    """Return a formula with the definitions that it uses, in the order of the file."""
    used = formula.names
    while more := used.union(*(let[name].names for name in used & let.keys())) - used:
        used |= more
    return ClosedForm(formula, {name: let[name] for name in let if name in used})


@cache
def _instant(text: str) -> Instant:
    return _INSTANT.validate_json(text)


def _number(said: float | str | None) -> float | None:
    """Return a number, which an item of `each` may have given as a text; None for 'none'."""
    return None if said is None or said == "none" else float(said)
