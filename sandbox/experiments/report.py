"""The report of an experiment: its results in figures and tables, in one file."""

import json
from collections.abc import Callable, Mapping
from math import isfinite
from pathlib import Path
from typing import NamedTuple

from sandbox.experiments import figures, read_results, result_statistics
from sandbox.experiments.experiment_folder import DESCRIPTION, RESULTS, description
from sandbox.experiments.plan import Plan
from sandbox.experiments.random_points import Method
from sandbox.experiments.results_table import axis_unit, closed_form, error
from sandbox.model.atomic_file_writing import write_atomically
from sandbox.model.errors import SandboxError
from sandbox.reporting.html_pages import environment, inline

PAGE = "report.html"

METHODS: Mapping[Method, str] = {
    "random": "drawn independently",
    "latin-hypercube": "drawn as a Latin hypercube",
    "sobol": "drawn from Sobol's sequence",
    "sobol-indices": "drawn in Saltelli's scheme for Sobol's indices",
}
"""The names of the sampling methods on a page."""

SHOWN = 5
"""The most reasons of failures that the report names."""


class Page(NamedTuple):
    """A report that was written."""

    path: Path
    remarks: list[str]
    """remarks to be printed at once"""


def write(plan: Plan, path: Path, folder: Path) -> Page:
    """Write the report of a finished table into a folder; raise `SandboxError` if that fails."""
    forms = [
        name(m.text) for m in plan.measures if m.of and m.check for name in (closed_form, error)
    ]
    found = read_results.read(path, [*plan.axes, *(m.text for m in plan.measures), *forms])
    summaries = result_statistics.summaries(plan, found)
    sensitivities, remarks = _sensitivities(plan, path)
    drawn = [*figures.pictures(plan, found), *map(figures.shares, sensitivities)]
    failed = sum(count for _, count in found.failures)
    templates = environment("sandbox.experiments")
    templates.filters.update(_FILTERS)
    html = templates.get_template("experiment.html").render(
        plan=plan,
        title=plan.experiment.title or f"{plan.level.title}: an experiment",
        found=found,
        failed=failed,
        failures=found.failures[:SHOWN],
        summaries=summaries,
        sensitivities=sensitivities,
        remarks=remarks,
        pictures=[(inline(p.figure, p.caption), p) for p in drawn],
        axes=[(name, axis.described(axis_unit(plan, name))) for name, axis in plan.axes.items()],
        method=METHODS[plan.experiment.method],
        compared=any(summary.error is not None for summary in summaries),
        description=json.dumps(description(plan)["experiment"], indent=2, ensure_ascii=False),
        made=description(plan)["made with"],
        files=(RESULTS, DESCRIPTION),
    )
    write_atomically(folder / PAGE, html)
    if failed:
        reason = found.failures[0][0]
        remarks = [f"{failed:,} runs have failed, most of them so: {reason}", *remarks]
    return Page(folder / PAGE, remarks)


def _sensitivities(plan: Plan, path: Path) -> tuple[list[result_statistics.Sensitivity], list[str]]:
    """Return Sobol's indices, and the reasons why any are missing."""
    if plan.experiment.method != "sobol-indices":
        return [], []
    try:
        return result_statistics.sensitivities(plan, path), []
    except SandboxError as reason:
        return [], [str(reason)]


def _number(value: float | None) -> str:
    if value is None or not isfinite(value):
        return "–"
    return f"{value:.6g}".replace("-", "−")


def _error(value: float | None) -> str:
    return "–" if value is None else f"{value:.1e}".replace("-", "−")


_FILTERS: Mapping[str, Callable[..., str]] = {
    "number": _number,
    "error": _error,
    "count": lambda value: f"{value:,}",
}
