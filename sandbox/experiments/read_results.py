"""The finished table of an experiment, read back as far as a figure needs it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from sandbox.experiments.results_table import FAILURE, NUMBER
from sandbox.model.expressions import Array

MOST = 250_000
"""The most rows that are read; of a longer table, evenly spaced ones."""


@dataclass(frozen=True, slots=True)
class Results:
    """Some rows of a table."""

    runs: int
    """The number of rows in the file."""
    numbers: Array
    """(R,), the numbers of these rows."""
    columns: Mapping[str, Any]
    """(R,) each, the values by column name, numbers or names; NaN where a run has no number."""
    failures: Sequence[tuple[str, int]]
    """The reasons of failed runs with their counts, in the whole file, the most frequent first."""

    def number(self, name: str) -> Array:
        """Return a column of numbers."""
        return self.columns[name]


def read(path: Path, names: Sequence[str]) -> Results:
    """Read some columns of a table, with at most `MOST` rows."""
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
