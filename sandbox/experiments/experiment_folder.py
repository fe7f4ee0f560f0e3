"""The folder of an experiment: results are stored as they arrive, each file atomically.

experiment.json    the experiment, its level, and the versions that it was made with
parts/             finished rows, a file for each batch, while the experiment runs
results.parquet    all rows in their order, once they are finished
report.html        the report
"""

import json
import platform
import shutil
from collections.abc import Iterator, Sequence
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING

from sandbox.experiments.plan import Plan
from sandbox.experiments.results_table import Cell, schema
from sandbox.model.atomic_file_writing import (
    folder_of_files,
    make_folder,
    without_links,
    write_atomically,
)
from sandbox.model.errors import SandboxError, brief
from sandbox.model.file_reading import read_ordinary
from sandbox.model.translatable_message import Message
from sandbox.version import __version__

if TYPE_CHECKING:
    import pyarrow as pa

GROUP = 65_536
"""The number of rows in each row group of the finished file, whatever the batches were."""

LARGEST = 10_000_000
"""The largest description that is read [bytes]."""

RESULTS, DESCRIPTION, PARTS = "results.parquet", "experiment.json", "parts"


class Store:
    """The folder of an experiment, made if missing, which stores the results of its plan.

    Raises `SandboxError` if it cannot be written, or belongs to another experiment.
    """

    def __init__(self, folder: Path, plan: Plan) -> None:
        self._folder, self._plan = folder, plan
        self.results = folder / RESULTS
        self._parts = folder / PARTS
        with folder_of_files(folder):
            self._claim(json.dumps(description(plan), indent=2, ensure_ascii=False) + "\n")
        if not self.complete:
            make_folder(self._parts)

    def _claim(self, text: str) -> None:
        place = self._folder / DESCRIPTION
        if not place.exists():
            write_atomically(place, text)
            return
        try:
            existing = read_ordinary(without_links(place), LARGEST)
        except OSError as error:
            raise SandboxError(
                "cannot read {place}: {error}", place=place, error=str(error)
            ) from error
        if existing != text.encode():
            changed = _difference(existing or b"", text)
            raise SandboxError(
                "{folder} holds another experiment ({changed}): name another folder, or remove"
                " this one",
                folder=self._folder,
                changed=changed,
            )

    @property
    def complete(self) -> bool:
        """Whether the finished table is there."""
        import pyarrow as pa
        import pyarrow.parquet as pq

        if not self.results.is_file():
            return False
        try:
            return bool(pq.read_metadata(self.results).num_rows == self._plan.runs)
        except (OSError, pa.ArrowInvalid) as error:
            raise _unreadable(self.results, str(error)) from error

    def missing(self) -> Iterator[tuple[int, int]]:
        """Yield the ranges of missing rows: the first, and the one after the last."""
        begin = 0
        for start, stop, _ in self._done():
            if start > begin:
                yield begin, start
            begin = max(begin, stop)
        if begin < self._plan.runs:
            yield begin, self._plan.runs

    def add(self, start: int, stop: int, columns: Sequence[Sequence[Cell]]) -> None:
        """Store the columns of some rows; raise `SandboxError` if there is not enough space."""
        import pyarrow as pa
        import pyarrow.parquet as pq

        layout = schema(self._plan)
        arrays = [pa.array(c, f.type) for c, f in zip(columns, layout, strict=True)]
        sink = pa.BufferOutputStream()
        pq.write_table(pa.Table.from_arrays(arrays, schema=layout), sink)
        write_atomically(self._parts / f"{start}-{stop}.parquet", sink.getvalue().to_pybytes())

    def finish(self) -> None:
        """Write all rows to one table, in their order and in groups of the same size.

        Raises `SandboxError` if there is not enough space, or a part is damaged; the parts are
        kept.
        """
        import pyarrow.parquet as pq

        beside = self._folder / f".{RESULTS}.part"
        try:
            with pq.ParquetWriter(beside, schema(self._plan)) as writer:
                for table in self._grouped():
                    writer.write_table(table, row_group_size=GROUP)
            beside.replace(self.results)
            shutil.rmtree(self._parts)
        except OSError as error:
            raise SandboxError(
                "cannot write {results}: {reason}; what was done is kept",
                results=self.results,
                reason=error.strerror or error,
            ) from error
        finally:
            beside.unlink(missing_ok=True)

    def _grouped(self) -> "Iterator[pa.Table]":
        """Yield all rows in groups, of which only one is in memory at a time."""
        import pyarrow as pa

        table, begin = schema(self._plan).empty_table(), 0
        for start, stop, path in self._done():
            part = _part(path, table.schema)
            table = pa.concat_tables([table, part.slice(max(begin - start, 0))])
            begin = max(begin, stop)
            while len(table) >= GROUP:
                yield table.slice(0, GROUP).combine_chunks()
                table = table.slice(GROUP).combine_chunks()
        if len(table):
            yield table.combine_chunks()

    def _done(self) -> list[tuple[int, int, Path]]:
        """Return the stored parts, in the order of their rows."""
        found = []
        for path in self._parts.glob("*-*.parquet"):
            start, _, stop = path.stem.partition("-")
            if start.isdecimal() and stop.isdecimal():
                found.append((int(start), int(stop), path))
        return sorted(found)


def _part(path: Path, layout: "pa.Schema") -> "pa.Table":
    """Return the rows of a part, which must have the columns of the whole."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    try:
        part = pq.ParquetFile(path).read()
    except (OSError, pa.ArrowInvalid) as error:
        raise _unreadable(path, str(error)) from error
    if part.schema != layout:
        raise _unreadable(path, Message("it has other columns"))
    return part


def _unreadable(path: Path, reason: str) -> SandboxError:
    return SandboxError("cannot read {path}: {reason}; remove it", path=path, reason=reason)


def description(plan: Plan) -> dict[str, object]:
    """Return all that is needed to repeat an experiment with identical results."""
    written = plan.experiment.model_dump(mode="json", exclude_none=True, exclude={"schema_"})
    return {
        "experiment": {**written, "level": plan.source},
        "runs": plan.runs,
        "level": plan.level.model_dump(mode="json", exclude_none=True, exclude={"schema_"}),
        "made with": {
            "sandbox": __version__,
            "python": platform.python_version(),
            **{package: version(package) for package in ("numpy", "pymunk", "scipy")},
            "machine": platform.machine(),
        },
    }


def _difference(existing: bytes, text: str) -> str:
    """Return where two descriptions differ."""
    try:
        before, now = json.loads(existing), json.loads(text)
        pairs = [(before[part], now[part], part) for part in ("experiment", "made with")]
        for old, new, part in pairs:
            for key in {**old, **new}:
                if old.get(key) != new.get(key):
                    was = brief(json.dumps(old.get(key), ensure_ascii=False))
                    return (
                        f"its {key} is {was}" if part == "experiment" else f"made with {key} {was}"
                    )
    except (ValueError, LookupError, TypeError, AttributeError, RecursionError):
        return f"its {DESCRIPTION} cannot be read"
    return "its level says something else"
