"""The finished table of an experiment, read back as far as a picture needs it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from sandbox.experiments.table import FAILURE, NUMBER
from sandbox.model.expressions import Array

MOST = 250_000
"""How many rows are read; of more, evenly spaced ones."""


@dataclass(frozen=True, slots=True)
class Results:
    """Rows of the table.

    Attributes
    ----------
    runs
        How many there are in the file.
    numbers
        (R,), which of them these are.
    columns
        (R,) each, the numbers, or names, by the names of their columns; not a number where a run
        has none.
    failures
        Why runs failed, and how many for that reason, in the whole file; the most frequent first.
    """

    runs: int
    numbers: Array
    columns: Mapping[str, Any]
    failures: Sequence[tuple[str, int]]

    def number(self, name: str) -> Array:
        """Return a column of numbers."""
        found: Array = self.columns[name]
        return found


def read(path: Path, names: Sequence[str]) -> Results:
    """Return some columns of a table, from at most a number of rows."""
    import pyarrow.parquet as pq

    file = pq.ParquetFile(path)
    every, begin, failures = -(-file.metadata.num_rows // MOST), 0, dict[str, int]()
    parts: dict[str, list[Any]] = {name: [] for name in (NUMBER, *names)}
    for batch in file.iter_batches(columns=[*parts, FAILURE]):
        for reason in batch.column(FAILURE).drop_null().to_pylist():
            failures[reason] = failures.get(reason, 0) + 1
        first = -begin % every
        for name, found in parts.items():
            found.append(batch.column(name).to_numpy(zero_copy_only=False)[first::every])
        begin += len(batch)
    columns = {name: np.concatenate(found) for name, found in parts.items()}
    reasons = sorted(failures.items(), key=lambda pair: (-pair[1], pair[0]))
    return Results(begin, columns.pop(NUMBER), columns, reasons)
