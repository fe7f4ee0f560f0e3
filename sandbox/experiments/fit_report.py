"""The report of a fit: its parameters, and the run compared with the data."""

import json
from dataclasses import asdict
from math import floor, log10
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from sandbox.experiments.measured_data import Data
from sandbox.experiments.parameter_estimation import Fit, Fitted
from sandbox.model.atomic_file_writing import write_atomically
from sandbox.model.level import Level
from sandbox.model.quantities import column_heading, quantity
from sandbox.reporting.html_pages import environment, inline
from sandbox.reporting.plot_style import COLOURS, legend_below, style

PAGE, NUMBERS = "report.html", "fit.json"


def write(level: Level, source: str, data: Data, found: Fit, folder: Path) -> Path:
    """Write the report and the numbers of a fit into a folder, and return the path of the page.

    Raises `SandboxError` if they cannot be written.
    """
    pictures = [
        (inline(_picture(level, data, found, name), caption), caption)
        for name in data.columns
        for caption in (f"{name}: the data, the run that comes closest, and what is left over.",)
    ]
    html = environment("sandbox.experiments").get_template("fit.html")
    numbers = {
        "level": source,
        "parameters": [asdict(parameter) for parameter in found.parameters],
        "correlation": found.correlation.tolist(),
        "numbers": found.count,
        "scatter": found.scatter if data.uncertainties else None,
    }
    write_atomically(folder / NUMBERS, json.dumps(numbers, indent=2, ensure_ascii=False) + "\n")
    page = html.render(
        level=level, source=source, data=data, found=found, said=with_uncertainty, pictures=pictures
    )
    write_atomically(folder / PAGE, page)
    return folder / PAGE


def with_uncertainty(parameter: Fitted) -> str:
    """Return a parameter with its uncertainty to two digits: 9.813 ± 0.024 m/s²."""
    digits = max(1 - floor(log10(parameter.uncertainty)), 0) if parameter.uncertainty else 6
    unit = f" {parameter.unit}" if parameter.unit else ""
    return f"{parameter.value:.{digits}f} ± {parameter.uncertainty:.{digits}f}{unit}"


def _picture(level: Level, data: Data, found: Fit, name: str) -> Figure:
    order = np.argsort(data.t)
    measured, model = data.columns[name], found.model[name]
    uncertainty = data.uncertainties.get(name)
    with style():
        figure = Figure(figsize=(6.4, 5), layout="constrained")
        above, below = figure.subplots(2, sharex=True, height_ratios=(2, 1))
        above.plot(data.t[order], model[order], "-", color=COLOURS[1], label="run")
        for axes, values in ((above, measured), (below, measured - model)):
            axes.errorbar(
                data.t, values, uncertainty, fmt="o", markersize=3, color=COLOURS[0], label="data"
            )
            axes.grid(visible=True)
        unit = quantity(name, level).unit
        above.set_ylabel(column_heading(name, unit))
        below.set_ylabel(column_heading("left over", unit))
        below.set_xlabel("t [s]")
        legend_below(figure, above)
    return figure
