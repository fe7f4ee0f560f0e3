"""Statistics over an experiment's rows: distributions, errors, and sensitivities."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from sandbox.experiments import read_results
from sandbox.experiments.plan import Plan
from sandbox.experiments.read_results import Results
from sandbox.experiments.results_table import error
from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Array

QUANTILES = (0.025, 0.5, 0.975)


@dataclass(frozen=True, slots=True)
class Summary:
    """The distribution of an outcome over the rows that were read."""

    measure: str
    unit: str
    """The outcome and its unit."""
    count: int
    missing: int
    """The number of rows with a value, and of those without one."""
    mean: float
    deviation: float
    least: float
    most: float
    """Statistics of the values; NaN if there are none."""
    quantiles: tuple[float, ...]
    """The 2.5 %, 50 % and 97.5 % quantiles."""
    error: float | None
    """The largest error relative to the closed form; None if there is no closed form."""


@dataclass(frozen=True, slots=True)
class Sensitivity:
    """Sobol's indices of an outcome: the shares of its variance due to each random input."""

    measure: str
    """The outcome."""
    names: tuple[str, ...]
    """(d,), the random inputs."""
    first: Array
    total: Array
    """(d,), the effect of each input alone, and including its interactions with the others."""
    first_error: Array
    total_error: Array
    """(d,), their standard errors, by bootstrapping the rows."""


def summaries(plan: Plan, found: Results) -> list[Summary]:
    """Return the distribution of each measure."""
    return [_summary(found, m.text, m.unit) for m in plan.measures]


def _summary(found: Results, measure: str, unit: str) -> Summary:
    column = found.number(measure)
    finite = column[np.isfinite(column)]
    quantiles = tuple(np.quantile(finite, QUANTILES).tolist()) if len(finite) else (np.nan,) * 3
    worst = None
    if error(measure) in found.columns:
        errors = found.number(error(measure))
        errors = errors[np.isfinite(errors)]
        worst = float(errors.max()) if len(errors) else None
    numbers = (
        (finite.mean(), finite.std(ddof=1), finite.min(), finite.max()) if len(finite) > 1 else ()
    )
    mean, deviation, least, most = map(
        float, numbers or (finite.sum() if len(finite) else np.nan,) * 4
    )
    missing = len(column) - len(finite)
    return Summary(
        measure, unit, len(finite), missing, mean, deviation if numbers else np.nan, least, most,
        quantiles, worst,
    )  # fmt: skip


def sensitivities(plan: Plan, path: Path) -> list[Sensitivity]:
    """Return Sobol's indices of each measure, from rows in Saltelli's scheme.

    Raises `SandboxError` if a row has no value: the indices need all of them.
    """
    names = tuple(plan.random_axes)
    texts = [measure.text for measure in plan.measures]
    found = read_results.read(path, texts)
    if found.runs != len(found.numbers):
        raise SandboxError(
            "Sobol indices are computed from at most {most:,} runs", most=read_results.MOST
        )
    return [sensitivity(text, found.number(text), names) for text in texts]


def sensitivity(measure: str, column: Array, names: Sequence[str]) -> Sensitivity:
    """Return Sobol's indices of an outcome, (R,), from rows in Saltelli's scheme.

    Raises `SandboxError` if a row has no value, or all values are equal.
    """
    from scipy.stats import sobol_indices

    if missing := int((~np.isfinite(column)).sum()):
        raise SandboxError(
            "'{measure}' has no number in {missing:,} runs: no indices without it",
            measure=measure,
            missing=missing,
        )
    rows = column.reshape(-1, len(names) + 2)
    if not rows.std():
        raise SandboxError(
            "'{measure}' is the same in all runs: nothing to attribute", measure=measure
        )
    parts = {"f_A": rows[:, :1].T, "f_B": rows[:, 1:2].T, "f_AB": rows[:, 2:].T[:, None]}
    indices = sobol_indices(func=parts, n=len(rows), rng=np.random.default_rng(0))
    spread = indices.bootstrap(confidence_level=0.95, n_resamples=200)
    errors = (
        np.ravel(order.confidence_interval.high - order.confidence_interval.low) / (2 * 1.96)
        for order in (spread.first_order, spread.total_order)
    )
    first, total = np.ravel(indices.first_order), np.ravel(indices.total_order)
    return Sensitivity(measure, tuple(names), first, total, *errors)
