"""The card with the curve of an experiment, as far as computed."""

from collections.abc import Iterator, Sequence
from functools import lru_cache

import numpy as np
import pygame

from sandbox.app.cards.text_column import GAP, TextColumn
from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.pages.experiment.background_parameter_sweep import Point
from sandbox.app.pages.experiment.parameter_curve import CurveChoice, CurveWorker
from sandbox.app.runs.session import Session
from sandbox.app.widgets import plot
from sandbox.app.widgets.plot import Scale, Series
from sandbox.app.words import formatting, level_translation
from sandbox.app.words.language import later, plural, say
from sandbox.experiments.measures import MeasureError, parse
from sandbox.experiments.suggested_measures import of_check
from sandbox.model.level import Level

HEIGHT = 190  # px, of the curve
DIGITS = 5
"""The digits of a result that are written."""
EQUAL = 10.0**-DIGITS / 2
"""Results whose relative differences are at most this are drawn level: no written digit differs."""
NOTHING = later("This level has no parameter to vary.")
DID_NOT_HAPPEN = later("that did not happen in this run")
HINT = later("Click on the curve to run with that value.")


def curve(
    pen: Pen, width: int, session: Session, exploring: CurveWorker, mouse: Point | None
) -> tuple[pygame.Surface, pygame.Rect]:
    """Draw a curve with its description, and return also the place of the curve on the card.

    `mouse` is the point to describe and mark; None to mark the run that is played.
    """
    card = TextColumn(pen, width)
    card.heading(say("Experiment"))
    chosen = exploring.chosen(session)
    if chosen is None:
        card.text(say(NOTHING), 14, theme.DIM)
        return card.drawn(), pygame.Rect(0, 0, 0, 0)
    title = shown_as(session.original, chosen.measure)
    unit = unit_of(session.level, chosen)
    card.text(f"{title} [{unit}]" if unit else title, 13, theme.BODIES[0])
    if title != chosen.measure:
        card.text(chosen.measure, 12, theme.DIM)
    _point_text(card, session.level, chosen, exploring.points, mouse)
    card.y += GAP
    field = pygame.Rect(0, card.y, width, pen.px(HEIGHT))
    value = session.values[chosen.parameter] if mouse is None else mouse.at
    span = span_of(pen, width, session.level, chosen)
    series = list(_series(exploring.points))
    up = plot.vertical_scale(pen, field.height, [each.y for each in series], EQUAL)
    card.put(plot.draw(pen, field.size, series, span, value, up), 0)
    card.y += pen.px(HEIGHT) + 2
    across = named(session.level, chosen.parameter, session.level.parameters[chosen.parameter].unit)
    card.text(say("against {quantity}", quantity=across), 12, theme.DIM)
    _progress(card, exploring)
    return card.drawn(), field


def unit_of(level: Level, chosen: CurveChoice) -> str:
    """Return the unit of the measured quantity; empty if it has none, or is unknown."""
    try:
        return parse(chosen.measure, level, until=False).unit
    except MeasureError:
        return ""


def shown_as(level: Level, measure: str) -> str:
    """Return the label of the check that measures the same; else the measure itself."""
    labels = {of_check(each): level_translation.of(level)(each.label) for each in level.checks}
    return labels.get(measure) or measure


def span_of(pen: Pen, width: int, level: Level, chosen: CurveChoice) -> Scale:
    """Return the horizontal scale of a curve with a width [px], over the parameter's range."""
    parameter = level.parameters[chosen.parameter]
    return plot.horizontal_scale(pen, width, [np.array([parameter.min, parameter.max])])


def nearest(points: Sequence[Point], at: float) -> Point | None:
    """Return the point nearest to a value; None while there are none."""
    return min(points, key=lambda point: abs(point.at - at), default=None)


def _series(points: Sequence[Point]) -> Iterator[Series]:
    """Yield the closed form, and the measured values."""
    at = np.array([p.at for p in points])
    for color, dashed, column in (
        (theme.mix(theme.BODIES[0], theme.TEXT, 0.5), True, [p.expected for p in points]),
        (theme.BODIES[0], False, [p.measured for p in points]),
    ):
        values = np.array([np.nan if v is None else v for v in column], dtype=float)
        if np.isfinite(values).any():
            yield Series(color, at, values, dashed=dashed, marked=not dashed)


def _point_text(
    card: TextColumn,
    level: Level,
    chosen: CurveChoice,
    points: Sequence[Point],
    point: Point | None,
) -> None:
    """Add the result of a run in numbers.

    It gets as many lines as the longest of all results, so that the curve stays where it is while
    the mouse moves over it.
    """
    hint, top, unit = say(HINT), card.y, level.parameters[chosen.parameter].unit
    lines = _most_lines(card.pen, card.width, hint, chosen.parameter, unit, tuple(points))
    if point is None:
        card.text(hint, 12, theme.DIM)
    else:
        card.text(_result(chosen.parameter, unit, point), 12, theme.NOTICE)
    card.y = max(card.y, top + lines * card.pen.write(hint, 12).height)


@lru_cache(maxsize=4)
def _most_lines(
    pen: Pen, width: int, hint: str, parameter: str, unit: str, points: tuple[Point, ...]
) -> int:
    """Return the largest number of lines of the hint and the results; counting them takes 4 ms."""
    texts = hint, *(_result(parameter, unit, each) for each in points)
    return max(len(pen.wrap(text, width, 12)) for text in texts)


def _result(parameter: str, unit: str, point: Point) -> str:
    """Return the result of a run in words."""
    value = formatting.quantity(point.at, unit, 4)
    if point.measured is None:
        return f"{parameter} = {value}: {say(point.failure or DID_NOT_HAPPEN)}"
    message = f"{parameter} = {value}: {formatting.number(point.measured, DIGITS)}"
    if point.expected is not None:
        closed = formatting.number(point.expected, DIGITS)
        message += say(", closed form {value}", value=closed)
    return message


def named(level: Level, name: str, unit: str = "") -> str:
    """Return a parameter with its label, and a unit in brackets."""
    parameter = level.parameters[name]
    label = level_translation.of(level)(parameter.label)
    shown = f"{name} [{unit}]" if unit else name
    return f"{shown}, {label}" if label and label != name else shown


def _progress(card: TextColumn, exploring: CurveWorker) -> None:
    """Add the progress of the runs, and the number of failures."""
    if exploring.failure:
        card.text(say(exploring.failure), 12, theme.FAILED)
    elif exploring.share < 1:
        message = plural("{count} run so far", "{count} runs so far", len(exploring.points))
        card.text(message, 12, theme.DIM)
    failed = [p.failure for p in exploring.points if p.failure]
    if failed:
        message = plural(
            "{count} run has failed: {reason}",
            "{count} runs have failed: {reason}",
            len(failed),
            reason=say(failed[0]),
        )
        card.text(message, 12, theme.FAILED)
