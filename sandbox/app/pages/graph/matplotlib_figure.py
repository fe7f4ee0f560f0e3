"""The graphs as a matplotlib picture, drawn in another process."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Literal, NamedTuple

from sandbox.app.pages.graph.card import closed_forms, measured, so_far
from sandbox.app.pages.graph.zoom import Graph, Interval
from sandbox.app.runs.session import Session
from sandbox.app.words import level_translation
from sandbox.app.words.formatting import with_unit_in_brackets
from sandbox.app.words.language import say
from sandbox.model.atomic_file_writing import write_atomically
from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Array
from sandbox.model.quantities import TIME
from sandbox.optional_packages import needed_for

WIDTH, HEIGHT = 7.0, 3.2  # inches, of each graph
STYLES = {"run": ("-", 1.6), "closed": ("--", 1.0), "earlier": ("-", 0.8)}
"""The dash patterns and widths of the lines [pt]."""
FAINT = 0.45
"""The opacity of earlier runs."""


class Curve(NamedTuple):
    """A line: its name, its index among the colours of quantities, and its points."""

    label: str
    kind: Literal["run", "closed", "earlier"]
    color: int
    x: Array
    y: Array


class Subplot(NamedTuple):
    """The lines of a unit, and the visible interval of its axis."""

    unit: str
    curves: Sequence[Curve]
    up: Interval


class Figure(NamedTuple):
    """Fields one above the other, and the visible interval of their shared axis."""

    title: str
    across: str
    interval: Interval
    fields: Sequence[Subplot]


def figure(
    session: Session, up: Sequence[str], across: str, graphs: Sequence[Graph]
) -> Figure | None:
    """Return the graphs as in the window; None if there are none."""
    if not graphs:
        return None
    columns, units = so_far(session, list(dict.fromkeys([TIME.name, across, *up])))
    fields = []
    for graph in graphs:
        these = [name for name in up if units[name] == graph.unit]
        curves = [
            *_earlier(session, these, up, across),
            *(Curve(n, "run", list(up).index(n), columns[across], columns[n]) for n in these),
            *(
                Curve(say("{quantity}, closed form", quantity=n), "closed", list(up).index(n), x, y)
                for n, x, y in closed_forms(session, columns, these, across)
            ),
        ]
        fields.append(Subplot(graph.unit, curves, (graph.up.low, graph.up.high)))
    span = graphs[0].across
    label = with_unit_in_brackets(across, units[across])
    title = level_translation.title_of_level(session.original)
    return Figure(title, label, (span.low, span.high), fields)


def _earlier(
    session: Session, these: Sequence[str], up: Sequence[str], across: str
) -> Iterator[Curve]:
    names = list(dict.fromkeys([across, *these]))
    for run in session.earlier:
        columns, _ = measured(run.world, run.history, names)
        label = run.label(session.values)
        for name in these:
            color = list(up).index(name)
            yield Curve(f"{name}, {label}", "earlier", color, columns[across], columns[name])


def saved(found: Figure, path: Path) -> Iterator[str]:
    """Draw a picture and write it, and yield the message about its path or the failure."""
    try:
        with needed_for("a picture of a graph"):
            write_atomically(path, drawn(found))
    except (SandboxError, OSError) as error:
        yield say("no picture: {error}", error=error)
        return
    yield say("saved {path}", path=path)


def drawn(found: Figure) -> bytes:
    """Return a figure as the content of a PNG file."""
    from matplotlib.figure import Figure as Drawing

    from sandbox.reporting.plot_style import COLOURS, style, written

    with style():
        drawing = Drawing((WIDTH, HEIGHT * len(found.fields)), layout="constrained")
        drawing.suptitle(found.title)
        rows = drawing.subplots(len(found.fields), sharex=True, squeeze=False)[:, 0]
        for axes, field in zip(rows, found.fields, strict=True):
            for label, kind, color, x, y in field.curves:
                dashes, width = STYLES[kind]
                own = COLOURS[color % len(COLOURS)]
                axes.plot(
                    x, y, dashes, lw=width, label=label, color="black" if kind == "closed" else own,
                    alpha=FAINT if kind == "earlier" else 1.0,
                )  # fmt: skip
            axes.set(xlim=found.interval, ylim=field.up, ylabel=field.unit)
            axes.grid(visible=True)
            axes.legend()
        rows[-1].set_xlabel(found.across)
    return written(drawing, "png")
