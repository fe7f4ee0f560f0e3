"""The style of figures in reports: readable in print and by colour-blind people."""

from contextlib import AbstractContextManager
from io import BytesIO
from math import ceil, floor, log10
from typing import Literal

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator

COLOURS = (
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f7f7f", "#aa4499",
    "#117733",
)  # fmt: skip
"""Okabe and Ito's colours, which colour-blind people can tell apart, and a few more that remain
distinguishable from them."""

Form = Literal["png", "svg"]
FORMS: tuple[Form, ...] = ("png", "svg")

MARKERS = "os^dvP*Xh"
DASHES = ("-", "--", ":", "-.")
FRAME = "#808080"  # between the ink and the paper of either a light or a dark page

ROOM = 0.12  # decades beyond the last tick, so that no marker is cut

_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def style() -> AbstractContextManager[None]:
    """Return the settings under which figures are made and written."""
    return mpl.rc_context(
        {
            "font.size": 9,
            "axes.titlesize": 9,
            "axes.edgecolor": FRAME,
            "xtick.color": FRAME,
            "ytick.color": FRAME,
            "xtick.labelcolor": "black",
            "ytick.labelcolor": "black",
            "legend.fontsize": 7.5,
            "legend.frameon": False,
            "grid.color": FRAME,
            "grid.alpha": 0.25,
            "svg.fonttype": "none",
        }
    )


def logarithmic(axes: Axes) -> None:
    """Make both axes logarithmic, and end them at the powers of ten around what is drawn."""
    axes.set(xscale="log", yscale="log")
    limits = axes.dataLim
    for axis, (low, high), limit in (
        (axes.xaxis, limits.intervalx, axes.set_xlim),
        (axes.yaxis, limits.intervaly, axes.set_ylim),
    ):
        if low <= high:  # something is drawn
            limit(10 ** (floor(log10(low)) - ROOM), 10 ** (ceil(log10(high)) + ROOM))
        axis.set_major_locator(LogLocator(numticks=9))
        axis.set_major_formatter(FuncFormatter(power))
    axes.minorticks_off()
    axes.grid(visible=True)


def legend_below(figure: Figure, axes: Axes, columns: int = 4) -> None:
    """Add a legend of some axes below the figure, each label once, if there are any labels.

    The figure needs a constrained layout, so that the legend covers no curve.
    """
    handles, labels = axes.get_legend_handles_labels()
    unique = dict(zip(labels, handles, strict=True))
    if unique:
        figure.legend(
            list(unique.values()), list(unique), loc="outside lower center", ncols=columns
        )


def power(value: float, _: object = None) -> str:
    """Return a power of ten as text, such as 10⁻³; numbers near 1 are written out."""
    exponent = round(log10(value))
    return f"{value:g}" if -2 <= exponent <= 3 else "10" + superscript(exponent)


def superscript(exponent: int) -> str:
    """Return an exponent in superscript digits."""
    return str(exponent).translate(_SUPERSCRIPTS)


def written(figure: Figure, form: Form) -> bytes:
    """Return a figure as the content of a file, identical for identical figures."""
    image = BytesIO()
    salt = figure.get_suptitle() or "figure"
    with style(), mpl.rc_context({"svg.hashsalt": salt}):
        figure.savefig(
            image, format=form, dpi=150, metadata={"Date": None} if form == "svg" else {}
        )
    return image.getvalue()
