"""The graphs of the chosen quantities: one for each unit, with the closed form and earlier runs."""

from collections.abc import Iterator, Mapping, Sequence
from math import inf
from typing import NamedTuple

import numpy as np
import pygame

from sandbox.app.cards.text_column import GAP, TextColumn
from sandbox.app.drawing import line_styles, theme
from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color
from sandbox.app.observing.earlier_runs import have_same_bodies
from sandbox.app.observing.thinned_history import ThinnedHistory
from sandbox.app.pages.graph.zoom import WHOLE, Graph, Zoom
from sandbox.app.runs.session import Session
from sandbox.app.widgets import plot
from sandbox.app.widgets.plot import Scale, Series
from sandbox.app.words import formatting
from sandbox.app.words.language import later, say
from sandbox.model.expression_compiler import ExpressionError
from sandbox.model.expressions import Array
from sandbox.model.quantities import TIME
from sandbox.physics.accuracy.trusted_digits import Trust
from sandbox.physics.measuring.grading import applies
from sandbox.physics.quantities.meter import Meter
from sandbox.physics.stepping.world import World

HEIGHTS = 80, 150  # px, the least and the largest height of a graph
ROOM = 295  # px, of a page for what stands around a graph

NOT_KNOWN: Mapping[str, Trust] = {}
NOTHING = later("Choose a quantity below; several are drawn together.")


class Graphs(NamedTuple):
    """A picture, and the graphs in it."""

    picture: pygame.Surface
    graphs: Sequence[Graph]


def graphs(
    pen: Pen, width: int, session: Session, up: Sequence[str], across: str, cursor: float | None,
    trust: Mapping[str, Trust] = NOT_KNOWN, zoom: Zoom = WHOLE, page: float = inf,
) -> Graphs:  # fmt: skip
    """Draw quantities of the run so far against another; the known future is fainter.

    Their values are written at the cursor, a value of the quantity `across`; None is the present.
    The graphs leave room on a `page` of some height [px].
    """
    card = TextColumn(pen, width)
    if not up:
        card.text(say(NOTHING), 14, theme.DIM)
        return Graphs(card.drawn(), ())
    found: list[Graph] = []
    names = list(dict.fromkeys([TIME.name, across, *up]))
    columns, units = so_far(session, names)
    earlier, later = _other_runs(session, names)
    shown = later if later and cursor and cursor > columns[across].max() else columns
    span = zoom.visible_scale(span_of(pen, width, session, across))
    mark = float(columns[across][-1]) if later and cursor is None else cursor
    for unit in dict.fromkeys(units[name] for name in up):
        these = [name for name in up if units[name] == unit]
        _values(card, shown, these, up, units, across, cursor, trust)
        others = [*_earlier_lines(earlier, these, across), *_later_lines(later, these, up, across)]
        closed = _closed_form_lines(session, columns, these, up, across)
        series = [*others, *closed, *_own_lines(columns, these, up, across)]
        found.append(_put(card, series, span, mark, (units[across], unit), zoom, page))
    message = say(
        "against {quantity}", quantity=formatting.with_unit_in_brackets(across, units[across])
    )
    card.text(message, 12, theme.DIM)
    return Graphs(card.drawn(), found)


def _put(
    card: TextColumn, series: Sequence[Series], span: Scale, mark: float | None,
    units: tuple[str, str], zoom: Zoom, page: float,
) -> Graph:  # fmt: skip
    """Draw the visible part of the lines of one unit, and return their graph."""
    pen, (least, most) = card.pen, map(card.pen.px, HEIGHTS)
    size = card.width, int(min(max(page - pen.px(ROOM), least), most))
    rise = zoom.visible_scale(
        plot.vertical_scale(pen, size[1], [each.y for each in series]), units[1]
    )
    graph = Graph(units[1], pygame.Rect((0, card.y), size), span, rise)
    card.put(plot.draw(pen, size, series, span, mark, rise, units), 0)
    card.y += size[1] + GAP
    return graph


def _other_runs(
    session: Session, names: Sequence[str]
) -> tuple[Sequence[Mapping[str, Array]], Mapping[str, Array] | None]:
    """Return the quantities of earlier runs, and of the known future of the present one."""
    earlier = [measured(run.world, run.history, names)[0] for run in session.earlier]
    run = session.later
    return earlier, measured(run.world, run.history, names)[0] if run else None


def span_of(pen: Pen, width: int, session: Session, across: str) -> Scale:
    """Return the horizontal scale of graphs with a width [px], with room for other runs."""
    runs = [(run.world, run.history) for run in session.earlier]
    runs += [(run.world, run.history) for run in (session.later,) if run]
    others = [measured(*run, [across])[0][across] for run in runs]
    return plot.horizontal_scale(pen, width, [so_far(session, [across])[0][across], *others])


def so_far(session: Session, names: Sequence[str]) -> tuple[Mapping[str, Array], Mapping[str, str]]:
    """Return quantities up to the shown state, (k,) each, and their units."""
    run = session.recalled
    if run is None or not have_same_bodies(run.world, session.world):
        return measured(session.world, session.history, names)
    columns, units = measured(run.world, run.history, names)
    count = np.searchsorted(run.history.snapshots.t, float(run.world.snapshot.t), side="right")
    return {name: column[:count] for name, column in columns.items()}, units


def measured(
    world: World, history: ThinnedHistory, names: Sequence[str]
) -> tuple[Mapping[str, Array], Mapping[str, str]]:
    """Return quantities of a run at all instants, (k,) each, and their units."""
    meter = Meter(world, names)
    return meter(history.snapshots), {n: q.unit for n, q in meter.quantities.items()}


def _color(name: str, up: Sequence[str]) -> Color:
    return theme.BODIES[list(up).index(name) % len(theme.BODIES)]


def _sign(name: str, up: Sequence[str]) -> int | None:
    """Return the index of the sign of a line; None for a single line."""
    return list(up).index(name) if len(up) > 1 else None


def _values(
    card: TextColumn, columns: Mapping[str, Array], these: Sequence[str],
    up: Sequence[str], units: Mapping[str, str], across: str, cursor: float | None,
    trust: Mapping[str, Trust],
) -> None:  # fmt: skip
    """Write the name of each line, and its value at the cursor or now."""
    indent = card.pen.px(16) if len(up) > 1 else 0
    row = -1 if cursor is None else int(np.argmin(np.abs(columns[across] - cursor)))
    for name in these:
        value = formatting.quantity(value_at(columns[name], row), units[name], 4)
        right = card.pen.write(value, 13, theme.TEXT)
        left = card.pen.write(
            card.pen.shorten(name, card.width - right.width - 12 - indent, 13), 13, _color(name, up)
        )
        if (sign := _sign(name, up)) is not None:
            mark = pygame.Surface((indent, left.height), pygame.SRCALPHA)
            line_styles.marker(mark, sign, _color(name, up), (indent / 2 - 2, left.height / 2), 4)
            card.put(mark, 0)
        card.put(left, indent)
        card.put(right, card.width - right.width)
        card.y += left.height
        if name in trust:
            card.text(formatting.trusted(trust[name]), 12, theme.DIM)
            if price := formatting.next_digit(trust[name]):
                card.text(price, 12, theme.DIM)
    at = formatting.quantity(float(columns[across][row]), units[across], 4)
    message = say("at {quantity} = {value}", quantity=across, value=at)
    card.text(message, 12, theme.DIM if cursor is None else theme.NOTICE)


def value_at(column: Array, row: int) -> float:
    """Return a value of a quantity, or 0 if it is a rounding error where the graph is drawn as one.

    That is relative to the largest value, or to 1 if that is larger.
    """
    largest = np.abs(column[np.isfinite(column)]).max(initial=1.0)
    return formatting.without_rounding(float(column[row]), float(largest))


def _own_lines(
    columns: Mapping[str, Array], these: Sequence[str], up: Sequence[str], across: str
) -> Iterator[Series]:
    """Yield the lines of the shown run."""
    for name in these:
        yield Series(_color(name, up), columns[across], columns[name], marker=_sign(name, up))


def _earlier_lines(
    earlier: Sequence[Mapping[str, Array]], these: Sequence[str], across: str
) -> Iterator[Series]:
    """Yield the lines of earlier runs."""
    for index, columns in enumerate(earlier):
        color = theme.faded(theme.LANES[index % len(theme.LANES)], 0.6)
        yield from (Series(color, columns[across], columns[name]) for name in these)


def _later_lines(
    later: Mapping[str, Array] | None, these: Sequence[str], up: Sequence[str], across: str
) -> Iterator[Series]:
    """Yield the lines of the run after the shown step, as far as known."""
    for name in these if later else ():
        assert later is not None
        yield Series(theme.faded(_color(name, up), 0.5), later[across], later[name])


def _closed_form_lines(
    session: Session, columns: Mapping[str, Array], these: Sequence[str], up: Sequence[str],
    across: str,
) -> Iterator[Series]:  # fmt: skip
    """Yield the lines of closed forms."""
    for name, x, y in closed_forms(session, columns, these, across):
        yield Series(theme.mix(_color(name, up), theme.TEXT, 0.5), x, y, dashed=True)


def closed_forms(
    session: Session, columns: Mapping[str, Array], these: Sequence[str], across: str
) -> Iterator[tuple[str, Array, Array]]:
    """Yield the closed forms of checks at every step, if they still describe the run.

    Each consists of the name of its quantity, the horizontal values, and its own: (k,). The columns
    must contain the time.
    """
    if session.changes or session.world.disturbed:
        return
    t = columns[TIME.name]
    for check in session.original.checks:
        if check.quantity not in these or check.at or not applies(check, session.chosen):
            continue
        try:
            formula = check.formula.over(session.chosen, t)
        except ExpressionError:
            continue
        yield check.quantity, formula if across == check.quantity else columns[across], formula
