"""Measured data from a file: a CSV table of quantities over time."""

import csv
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import isfinite
from pathlib import Path

import numpy as np

from sandbox.model.errors import SandboxError, brief
from sandbox.model.expressions import Array
from sandbox.model.file_reading import UnreadableError, read_named
from sandbox.model.level import Level
from sandbox.model.quantities import QuantityError, quantity

MAX_BYTES = 10_000_000
SIGN = "±"


class DataError(SandboxError):
    """A data file that cannot be used."""


@dataclass(frozen=True, slots=True)
class Data:
    """Measured quantities; N times."""

    t: Array
    """(N,), the times [s]."""
    columns: Mapping[str, Array]
    """(N,) each, the measured values in SI units; NaN where there is none."""
    uncertainties: Mapping[str, Array]
    """(N,) each, their standard uncertainties, where they are known."""

    @property
    def count(self) -> int:
        """The number of measured values."""
        return sum(int(np.isfinite(column).sum()) for column in self.columns.values())


def read(path: Path, level: Level) -> Data:
    """Read a CSV file with a column `t`, and columns named after quantities of a level.

    A column named after a quantity and ± holds its standard uncertainties. Lines that begin with #
    are comments. Raises `DataError` if the file cannot be used; the message says where and why.
    """
    lines = enumerate(_lines(path), 1)
    numbered = [(i, line) for i, line in lines if line.strip() and line[0] != "#"]
    if len(numbered) < 2:
        raise DataError(
            "{path}: holds no rows below a header, such as t,ball.position.y", path=path
        )
    where = f"{path}:{numbered[0][0]}"
    names = [name.strip() for name in _cells(numbered[0][1], where)]
    _check_names(names, level, where)
    rows = np.array(list(_rows(numbered[1:], names, str(path))))
    columns = dict(zip(names, rows.T, strict=True))
    t = columns.pop("t")
    if not np.isfinite(t).all() or t.min() < 0 or not t.max() > 0:
        raise DataError(
            "{path}: times are in seconds from the start of the run: 0 and later", path=path
        )
    return Data(
        t,
        {name: column for name, column in columns.items() if not name.endswith(SIGN)},
        {n.removesuffix(SIGN).strip(): c for n, c in columns.items() if n.endswith(SIGN)},
    )


def _lines(path: Path) -> list[str]:
    try:
        return read_named(path, MAX_BYTES).decode("utf-8-sig").splitlines()
    except UnreadableError as error:
        raise DataError("{path}: {reason}", path=path, reason=error.message) from error
    except UnicodeDecodeError as error:
        raise DataError("{path}: is not UTF-8 text", path=path) from error


def _check_names(names: list[str], level: Level, where: str) -> None:
    if "t" not in names:
        raise DataError("{where}: no column is called 't', the time in seconds", where=where)
    if len(set(names)) < len(names):
        raise DataError("{where}: two columns have the same name", where=where)
    measured = [name.removesuffix(SIGN).strip() for name in names if name != "t"]
    for name in measured:
        try:
            quantity(name, level)
        except QuantityError as error:
            raise DataError("{where}: {error}", where=where, error=error.message) from error
        if name not in names:
            raise DataError(
                "{where}: there are uncertainties of '{name}', but no '{name}'",
                where=where,
                name=name,
            )
    if not measured:
        raise DataError("{where}: no column holds a quantity of the level", where=where)


def _rows(lines: list[tuple[int, str]], names: list[str], source: str) -> Iterator[list[float]]:
    for number, line in lines:
        cells = _cells(line, f"{source}:{number}")
        if len(cells) != len(names):
            raise DataError(
                "{source}:{number}: has {cells} cells, but the header {names}",
                source=source,
                number=number,
                cells=len(cells),
                names=len(names),
            )
        yield [_number(c, n, f"{source}:{number}") for c, n in zip(cells, names, strict=True)]


def _cells(line: str, where: str) -> list[str]:
    try:
        return next(csv.reader([line]))
    except csv.Error as error:  # a cell of more than 100,000 letters
        raise DataError("{where}: {error}", where=where, error=str(error)) from error


def _number(cell: str, name: str, where: str) -> float:
    if not cell.strip() and name != "t":
        return float("nan")
    try:
        value = float(cell)
    except ValueError:
        raise DataError(
            "{where}: '{cell}' is not a number", where=where, cell=brief(cell)
        ) from None
    if not isfinite(value):
        raise DataError("{where}: '{cell}' is not a finite number", where=where, cell=brief(cell))
    if name.endswith(SIGN) and value <= 0:
        raise DataError(
            "{where}: an uncertainty of {value:g}; it must be above 0", where=where, value=value
        )
    return value
