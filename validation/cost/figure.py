"""Work-precision diagrams: error against seconds, both logarithmic."""

from io import BytesIO
from itertools import groupby
from pathlib import Path

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from sandbox.model.files import write_atomically
from validation.cost.summary import LEAST
from validation.cost.sweep import Point, Sweep

LOOKS = {
    "leapfrog": ("#0072b2", "o", "-", "leapfrog (ours)"),
    "symplectic-euler": ("#d55e00", "s", "--", "symplectic Euler (pymunk as it comes)"),
    "explicit-euler": ("#7f7f7f", "^", ":", "explicit Euler"),
}
"""Colours of Okabe and Ito, which all can tell apart; shapes and dashes for print."""


def draw(sweep: Sweep, folder: Path) -> Path:
    """Draw a level's diagram as a PNG in a folder, and return its path.

    Raises
    ------
    SandboxError
        If it cannot be written.
    """
    path = folder / f"{sweep.level.replace('/', '-')}.png"
    image = BytesIO()
    with mpl.rc_context({"font.size": 9}):
        diagram(sweep).savefig(image, format="png", dpi=150)
    write_atomically(path, image.getvalue())
    return path


def diagram(sweep: Sweep) -> Figure:
    """Return the diagram of a level."""
    figure = Figure(figsize=(5.2, 3.6), layout="constrained")
    axes = figure.subplots()
    for (scheme, iterations), points in groupby(sweep.points, lambda p: (p.scheme, p.iterations)):
        _line(axes, scheme, iterations, [p for p in points if p.error < float("inf")])
    own = [p for p in sweep.points if p.scheme == "leapfrog" and p.rate == sweep.own_rate]
    for point in own[:1]:
        axes.plot(
            point.seconds_per_second * 1e3, max(point.error, LEAST), "o",
            markersize=11, markerfacecolor="none", markeredgecolor="black",
            label=f"the level's own {sweep.own_rate:g} Hz",
        )  # fmt: skip
    axes.set(
        xscale="log", yscale="log", title=sweep.level,
        xlabel="ms of computing for a second of the scene", ylabel="largest error of the run",
    )  # fmt: skip
    axes.grid(visible=True, which="major", alpha=0.3)
    handles, labels = axes.get_legend_handles_labels()
    unique = dict(zip(labels, handles, strict=True))
    if unique:
        axes.legend(list(unique.values()), list(unique), fontsize=7)
    return figure


def _line(axes: Axes, scheme: str, iterations: int, points: list[Point]) -> None:
    color, marker, dashes, label = LOOKS.get(scheme, ("#009e73", "d", "-.", scheme))
    faint = 1.0 if iterations == 10 else 0.4
    axes.plot(
        [p.seconds_per_second * 1e3 for p in points], [max(p.error, LEAST) for p in points],
        color=color, marker=marker, linestyle=dashes, markersize=4, linewidth=1.2, alpha=faint,
        label=label if faint == 1 else f"{label}, {iterations} iterations",
    )  # fmt: skip
