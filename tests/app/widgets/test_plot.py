"""The axes of graphs: legible numbers, in the units of their quantities."""

from math import radians

import numpy as np
import pygame
import pytest

from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.widgets import plot
from sandbox.app.widgets.plot import GAP, Scale, Series

SIZE = 278, 150  # px


@pytest.mark.parametrize("end", [0.01983, 0.19833, 0.7, 1.61, 19.83, 1234.5, 2.3e-7])
@pytest.mark.parametrize("width", [120, 278, 360])
def test_the_numbers_of_an_axis_keep_apart(pen: Pen, end: float, width: int) -> None:
    span = plot.horizontal_scale(pen, width, [np.array([0.0, end])])

    ticks = plot._ticks_apart(span, lambda text: pen.write(text, 11).width, pen.px(GAP))

    assert ticks
    places = span.pixels(np.array(ticks))
    half = [pen.write(plot._brief(tick), 11).width / 2 for tick in ticks]
    for i in range(len(ticks) - 1):
        assert places[i] + half[i] + pen.px(GAP) / 2 < places[i + 1] - half[i + 1]


@pytest.mark.parametrize("text_scale", [1.0, 1.25, 1.5])
@pytest.mark.parametrize("height", [72, 90, 150])
def test_the_numbers_beside_a_low_graph_do_not_cover_each_other(
    height: int, text_scale: float
) -> None:
    """Each line at a round value has a number of its own, with empty rows around it."""
    pygame.font.init()
    pen, x = Pen(text_scale), np.linspace(0.5, 1.0, 9)
    span = plot.horizontal_scale(pen, SIZE[0], [np.array([0.0, 1.0])])
    series = Series(theme.ACCENT, x, 4.4 + 0.7 * x)

    drawn = pygame.surfarray.array3d(plot.draw(pen, (SIZE[0], height), [series], span, None))

    start, bottom = round(span.start), height - pen.px(plot.BELOW)
    lines = (drawn[start + 2, :bottom] == theme.GRID_STRONG).all(axis=1).sum()
    written = (drawn[: start - 3] != theme.STAGE).any(axis=(0, 2))
    written[bottom + pen.px(2) :] = False
    numbers = np.count_nonzero(np.diff(written.astype(int)) == 1)
    assert lines >= 1
    assert numbers == lines


def test_what_is_kept_in_radians_is_numbered_in_degrees(
    pen: Pen, monkeypatch: pytest.MonkeyPatch
) -> None:
    texts: list[str] = []
    brief = plot._brief
    monkeypatch.setattr(plot, "_brief", lambda v: texts.append(brief(v)) or brief(v))  # type: ignore[func-returns-value]
    line = Series((255, 255, 255), np.array([0.0, 1.0]), np.array([0.0, radians(90)]))
    span = plot.horizontal_scale(pen, SIZE[0], [line.x])

    plot.draw(pen, SIZE, [line], span, None, units=("s", "rad"))
    assert "80" in texts

    texts.clear()
    plot.draw(pen, SIZE, [line], span, None, units=("s", "m"))
    assert "1.2" in texts


def test_a_scale_of_another_unit_is_read_as_it_is() -> None:
    scale = Scale(0.0, 2.0, 0.0, 100.0)

    assert scale.in_shown_unit("m") is scale
    assert scale.in_shown_unit("rad/s").high == pytest.approx(360 / 3.14159265, rel=1e-6)


@pytest.mark.parametrize("slope", [-1e-5, 1e-5])
def test_what_numbers_are_told_beyond_stands_where_no_line_is(pen: Pen, slope: float) -> None:
    """It was drawn over a line that begins in the upper left corner."""
    x = np.linspace(0.0, 1.0, 50)
    series = Series(theme.ACCENT, x, 4.5 + slope * x**2, marked=True)

    drawn = pygame.surfarray.array3d(
        plot.draw(pen, SIZE, [series], plot.horizontal_scale(pen, SIZE[0], [x]), None)
    )

    columns, rows = np.nonzero((drawn == theme.NOTICE).all(axis=2))
    told = drawn[columns.min() : columns.max() + 1, rows.min() : rows.max() + 1]
    assert told.size
    assert not (told == theme.ACCENT).all(axis=2).any()
