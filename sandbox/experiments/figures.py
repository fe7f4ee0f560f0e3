"""The figures of an experiment: curves, families of curves, heat maps, histograms and shares."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from sandbox.experiments.measures import Measure
from sandbox.experiments.parameter_axes import Grid, Listed, Uniform
from sandbox.experiments.plan import Plan
from sandbox.experiments.read_results import Results
from sandbox.experiments.result_statistics import Sensitivity
from sandbox.experiments.results_table import axis_unit, closed_form
from sandbox.model.expressions import Array
from sandbox.model.quantities import column_heading
from sandbox.reporting.plot_style import COLOURS, FRAME, MARKERS, legend_below, style

FAMILY = 8
"""The most curves in one figure; more become a heat map."""

MARKED = 120
"""The most points of a curve that has a marker at each."""

BINS = 60
CLOUD = 4000
"""The number of points that are drawn of a scatter plot."""


@dataclass(frozen=True, slots=True)
class Picture:
    """A figure, with a description of what it shows."""

    name: str
    """The name of its file, without the ending."""
    figure: Figure
    caption: str


def pictures(plan: Plan, found: Results) -> Iterator[Picture]:
    """Yield a figure of each measure."""
    grids = [name for name, axis in plan.grids.items() if axis.count > 1]
    for i, measure in enumerate(plan.measures, 1):
        drawn = _drawn(plan, found, measure, grids)
        if drawn:
            caption, figure = drawn
            yield Picture(f"measure-{i}", figure, caption)


def _drawn(
    plan: Plan, found: Results, measure: Measure, grids: Sequence[str]
) -> tuple[str, Figure] | None:
    if not np.isfinite(found.number(measure.text)).any():
        return None
    if not grids:
        return f"How often {measure.text} came out so large.", _histogram(plan, found, measure)
    along, others = _roles(plan, grids)
    selected = _first_of(plan, found, others[1:])
    if not others:
        return f"{measure.text} against {along}.", _curves(
            plan, found, measure, along, None, selected
        )
    if plan.grids[others[0]].count <= FAMILY:
        caption = f"{measure.text} against {along}, a curve for each {others[0]}."
        return caption, _curves(plan, found, measure, along, others[0], selected)
    caption = f"{measure.text} over {along} and {others[0]}."
    return caption, _heat_map(plan, found, measure, (along, others[0]), selected)


def _roles(plan: Plan, grids: Sequence[str]) -> tuple[str, list[str]]:
    """Return the axis along which to plot, the numeric one with most values, and the other axes."""

    def weight(name: str) -> tuple[bool, int]:
        axis = plan.grids[name]
        return not (isinstance(axis, Listed) and isinstance(axis.values[0], str)), axis.count

    ordered = sorted(grids, key=weight, reverse=True)
    return ordered[0], ordered[1:]


def _first_of(plan: Plan, found: Results, names: Sequence[str]) -> Array:
    """Return the rows with the first value of each of some axes: (R,)."""
    selected = np.ones(len(found.numbers), dtype=bool)
    for name in names:
        selected &= found.columns[name] == plan.grids[name].at(0)
    return selected


def _curves(
    plan: Plan, found: Results, measure: Measure, along: str, family: str | None, selected: Array
) -> Figure:
    with style():
        figure = Figure(figsize=(6.4, 4), layout="constrained")
        axes = figure.subplots()
        axis = plan.grids[family] if family else None
        for i in range(axis.count if axis else 1):
            value = axis.at(i) if axis else None
            rows = selected & (found.columns[family] == value) if family else selected
            label = _named(plan, family, value) if family and value is not None else "measured"
            _curve(axes, plan, found, measure, along, rows, i, label)
        axes.set_xlabel(column_heading(along, axis_unit(plan, along)))
        axes.set_ylabel(column_heading(measure.text, measure.unit))
        if isinstance(grid := plan.grids[along], Grid) and grid.scale == "log":
            axes.set_xscale("log")
            if measure.reduction == "error":
                axes.set_yscale("log")
        axes.grid(visible=True)
        if family or closed_form(measure.text) in found.columns:
            legend_below(figure, axes)
    return figure


def _curve(
    axes: Axes, plan: Plan, found: Results, measure: Measure, along: str, rows: Array, i: int,
    label: str,
) -> None:  # fmt: skip
    x, y = found.columns[along][rows], found.number(measure.text)[rows]
    colour = COLOURS[i % len(COLOURS)]
    expected = closed_form(measure.text) in found.columns
    if expected and not plan.random_axes:
        form = found.number(closed_form(measure.text))[rows]
        if np.isfinite(form).any():
            name = "closed form" if not i else None
            axes.plot(x, form, "-", color=colour, linewidth=1, label=name)
    marks = MARKERS[i % len(MARKERS)] if len(x) <= MARKED or plan.random_axes else ","
    line = "none" if expected or plan.random_axes else "-"
    axes.plot(x, y, marks, color=colour, linestyle=line, markersize=3, linewidth=1, label=label)


def _heat_map(
    plan: Plan, found: Results, measure: Measure, names: tuple[str, str], selected: Array
) -> Figure:
    x, y = (np.unique(found.columns[name][selected]) for name in names)
    at = tuple(
        np.searchsorted(values, found.columns[name][selected])
        for name, values in ((names[1], y), (names[0], x))
    )
    cells = _cells(found.number(measure.text)[selected], at, (len(y), len(x)))
    with style():
        figure = Figure(figsize=(6.4, 5), layout="constrained")
        axes = figure.subplots()
        words = [i for i, v in enumerate((x, y)) if v.dtype.kind not in "fi"]
        axes_values = [np.arange(len(v)) if i in words else v for i, v in enumerate((x, y))]
        drawn = axes.pcolormesh(
            *axes_values, cells, shading="nearest", cmap="viridis", rasterized=True
        )
        _scales(axes, plan, names)
        if 1 in words:
            axes.set_yticks(np.arange(len(y)), [str(v) for v in y])
        axes.set_xlabel(column_heading(names[0], axis_unit(plan, names[0])))
        axes.set_ylabel(column_heading(names[1], axis_unit(plan, names[1])))
        bar = figure.colorbar(drawn, ax=axes)
        bar.set_label(column_heading(measure.text, measure.unit))
        if (form := found.columns.get(closed_form(measure.text))) is not None and not words:
            _contours(axes, axes_values, _cells(form[selected], at, cells.shape), bar.get_ticks())
    return figure


def _cells(value: Array, at: Sequence[NDArray[np.intp]], shape: tuple[int, ...]) -> Array:
    """Return the mean of each cell: (Y, X); NaN for empty cells."""
    finite = np.isfinite(value)
    where = at[0][finite], at[1][finite]
    sums, counts = np.zeros(shape), np.zeros(shape)
    np.add.at(sums, where, value[finite])
    np.add.at(counts, where, 1)
    return np.divide(sums, counts, out=np.full(shape, np.nan), where=counts > 0)


def _contours(
    axes: Axes, axes_values: Sequence[Array | NDArray[np.intp]], form: Array, levels: Array
) -> None:
    """Draw contours of the closed form at the ticks of the colour bar."""
    finite = form[np.isfinite(form)]
    inside = [level for level in levels if (finite > level).any() and (finite < level).any()]
    if inside:
        axes.contour(*axes_values, form, inside, colors=FRAME, linewidths=1)
        axes.set_title("lines: the closed form, at the marks of the scale", loc="left")


def _scales(axes: Axes, plan: Plan, names: tuple[str, str]) -> None:
    for name, scale in zip(names, (axes.set_xscale, axes.set_yscale), strict=True):
        axis = plan.grids[name]
        if isinstance(axis, Grid) and axis.scale == "log":
            scale("log")


def _histogram(plan: Plan, found: Results, measure: Measure) -> Figure:
    column = found.number(measure.text)
    finite = column[np.isfinite(column)]
    single = next(iter(plan.random_axes)) if len(plan.random_axes) == 1 else None
    with style():
        figure = Figure(figsize=(6.4, 3.6) if single is None else (6.4, 6), layout="constrained")
        first, *second = figure.subplots(1 if single is None else 2, squeeze=False).ravel()
        form = found.columns.get(closed_form(measure.text), finite[:0])
        form = form[np.isfinite(form)]
        count = min(BINS, max(len(finite) // 8, 8))
        edges = np.histogram_bin_edges(np.concatenate((finite, form)), count)
        first.hist(finite, edges, color=COLOURS[0], alpha=0.8, label="measured")
        if len(form):
            first.hist(form, edges, histtype="step", color="black", label="closed form")
            legend_below(figure, first)
        first.set_xlabel(column_heading(measure.text, measure.unit))
        first.set_ylabel("runs")
        first.grid(visible=True)
        if single is not None:
            every = -(-len(column) // CLOUD)
            x = found.columns[single][::every]
            second[0].plot(x, column[::every], ".", markersize=2, color=COLOURS[0])
            second[0].set_xlabel(column_heading(single, axis_unit(plan, single)))
            second[0].set_ylabel(column_heading(measure.text, measure.unit))
            second[0].grid(visible=True)
            if isinstance(axis := plan.random_axes[single], Uniform) and axis.scale == "log":
                second[0].set_xscale("log")
    return figure


def shares(found: Sensitivity) -> Picture:
    """Return a figure of an outcome's sensitivities."""
    with style():
        figure = Figure(figsize=(6.4, 3.2), layout="constrained")
        axes = figure.subplots()
        positions = np.arange(len(found.names))
        for shift, values, errors, name, colour in (
            (-0.2, found.first, found.first_error, "by itself", COLOURS[0]),
            (0.2, found.total, found.total_error, "with all others", COLOURS[1]),
        ):
            axes.bar(positions + shift, values, 0.38, yerr=errors, label=name, color=colour)
        axes.set_xticks(positions, found.names)
        axes.set_ylabel("share of the variance")
        axes.grid(visible=True, axis="y")
        legend_below(figure, axes)
    caption = f"How much of the variance of {found.measure} comes from what is drawn."
    return Picture("sensitivity", figure, caption)


def _named(plan: Plan, name: str, value: float | str) -> str:
    if isinstance(value, str):
        return value if name == "scheme" else f"{name} {value}"
    unit = axis_unit(plan, name)
    return f"{name} = {value:.4g}" + (f" {unit}" if unit else "")
