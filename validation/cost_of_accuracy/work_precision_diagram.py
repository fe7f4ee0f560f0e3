"""Work-precision diagrams: error against seconds, both logarithmic."""

from itertools import groupby
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from sandbox.model.atomic_file_writing import write_atomically
from sandbox.reporting import plot_style
from validation.cost_of_accuracy.report import LEAST
from validation.cost_of_accuracy.scheme_and_rate_sweep import Point, Sweep

LOOKS = {
    "leapfrog": ("#0072b2", "o", "-", "leapfrog (ours)"),
    "fourth-order": ("#009e73", "d", "-.", "fourth order"),
    "sixth-order": ("#cc79a7", "v", "-.", "sixth order"),
    "eighth-order": ("#e69f00", "p", "-.", "eighth order"),
    "symplectic-euler": ("#d55e00", "s", "--", "symplectic Euler (stock pymunk)"),
    "explicit-euler": ("#7f7f7f", "^", ":", "explicit Euler"),
}
"""Okabe and Ito's colours, which colour-blind people can tell apart; markers and dashes for print.
"""


def draw(sweep: Sweep, folder: Path) -> Path:
    """Draw a level's diagram as a PNG, and return its path; raise `SandboxError` if that fails."""
    path = folder / f"{sweep.level.replace('/', '-')}.png"
    write_atomically(path, plot_style.written(diagram(sweep), "png"))
    return path


def diagram(sweep: Sweep) -> Figure:
    """Return the diagram of a level."""
    with plot_style.style():
        figure = Figure(figsize=(5.2, 3.9), layout="constrained")
        figure.suptitle(sweep.level, fontsize=10)
        axes = figure.subplots()
        for setting, points in groupby(sweep.points, lambda p: (p.scheme, p.iterations)):
            _line(axes, *setting, [p for p in points if p.error < float("inf")])
        _own(axes, sweep)
        plot_style.logarithmic(axes)
        axes.set(
            xlabel="ms of computing for a second of the scene", ylabel="largest error of the run"
        )
        plot_style.legend_below(figure, axes, columns=2)
    return figure


def _own(axes: Axes, sweep: Sweep) -> None:
    """Mark the settings that the level uses by default."""
    own = [p for p in sweep.points if p.scheme == "leapfrog" and p.rate == sweep.own_rate]
    for point in own[:1]:
        axes.plot(
            point.seconds_per_second * 1e3, max(point.error, LEAST), "o",
            markersize=11, markerfacecolor="none", markeredgecolor="black",
            label=f"the level's own {sweep.own_rate:g} Hz",
        )  # fmt: skip


def _line(axes: Axes, scheme: str, iterations: int, points: list[Point]) -> None:
    color, marker, dashes, label = LOOKS[scheme]
    faint = iterations != 10
    axes.plot(
        [p.seconds_per_second * 1e3 for p in points], [max(p.error, LEAST) for p in points],
        color=color, marker=marker, linestyle=dashes, markersize=4, linewidth=1.2,
        alpha=0.4 if faint else 1, label="faint: 4 and 40 iterations" if faint else label,
    )  # fmt: skip
