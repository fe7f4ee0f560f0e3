"""`python -m validation cost`."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import nullcontext
from functools import partial
from itertools import groupby
from pathlib import Path

import typer

from sandbox import progress_bar
from sandbox.model import level_catalog
from sandbox.model.atomic_file_writing import folder_of_files
from sandbox.optional_packages import needed_for
from sandbox.parallel_processes import spread
from validation import output
from validation.cost_of_accuracy.report import as_json, asked, asked_table, failed, summed, table
from validation.cost_of_accuracy.scheme_and_rate_sweep import QUICK, Budget, Sweep, errors, timed

EACH = 6
"""A quick sweep takes one in this many levels of each chapter."""


def measure(
    names: Sequence[str], json_file: Path | None, folder: Path | None, *, quick: bool
) -> list[str]:
    """Sweep levels, print the table, write the requested files, and return the failed levels.

    Without names it sweeps all levels or, if `quick`, a sample of them. Raises `SandboxError` if
    there is no such level, or a file cannot be written.
    """
    with folder_of_files(folder) if folder else nullcontext():
        draw = _drawer() if folder else None
        for name in names:
            level_catalog.find(name)
        every = level_catalog.textbook()
        found = sweep_all(list(names) or (sample(every) if quick else every), quick=quick)
        with output.written(content(found), json_file):
            _show(found)
        if folder and draw:
            for sweep in found:
                draw(sweep, folder)
            typer.echo(f"Drawn in {folder}.")
    wrong = failed(found)
    output.complain(wrong)
    return wrong


def _show(found: Sequence[Sweep]) -> None:
    output.show(table(found))
    if any(sweep.requests for sweep in found):
        output.show(asked_table(found))
        typer.echo(summed(found))


def sample(levels: Iterable[str]) -> list[str]:
    """Return the first of each `EACH` levels of every chapter, from names chapter by chapter."""
    chapters = groupby(levels, lambda level: level.partition("/")[0])
    return [level for _, chapter in chapters for level in list(chapter)[::EACH]]


def _drawer() -> Callable[[Sweep, Path], Path]:
    """Return the function that draws diagrams; importing matplotlib is slow."""
    with needed_for("a diagram"):
        from validation.cost_of_accuracy.work_precision_diagram import draw
    return draw


def content(found: Sequence[Sweep]) -> dict[str, object]:
    """Return sweeps as the content of the JSON file."""
    return output.content(levels=[as_json(sweep) for sweep in found], requests=asked(found))


def sweep_all(names: Sequence[str], *, quick: bool) -> list[Sweep]:
    """Sweep levels, with progress on a terminal."""
    found = sweeps(names, QUICK if quick else Budget())
    return progress_bar.consume(found, "Measuring what accuracy costs", len(names))


def sweeps(names: Sequence[str], budget: Budget) -> Iterator[Sweep]:
    """Yield the sweep of each level, in their order.

    All errors are computed first, on all cores. Then the costs are timed, one run after another,
    since runs that share the machine take longer.
    """
    found = dict(spread(partial(errors, budget=budget), names))
    for number in range(len(names)):
        yield timed(found[number])
