"""The content of the right column fits into it."""

import pygame
import pytest
from pygame_gui import UIManager
from pygame_gui.elements import UIScrollingContainer

from sandbox.app.cards.energy import energy, total
from sandbox.app.cards.text_column import COLUMNS, INDENT, TextColumn
from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.observing.energy_history_and_balance import Energies
from sandbox.app.panels import play_bar
from sandbox.app.panels.window_layout import divide
from sandbox.app.runs.session import Session
from sandbox.app.widgets.parameter_sliders import ParameterSliders
from sandbox.app.widgets.scrolling_area import BAR, MARGIN
from sandbox.model import level_catalog
from sandbox.model.loading import load
from tests.app import scenes
from tests.app.writing import noted

LONGEST = 12
"""So many labels are tried, the longest that there are."""

WIDTH = divide((1280, 800), levels=True, side=True).side.width - MARGIN - BAR


@pytest.mark.sweep
def test_every_label_of_a_parameter_is_written_whole(
    pen: Pen, monkeypatch: pytest.MonkeyPatch
) -> None:
    pygame.display.set_mode((1280, 800))
    manager = UIManager((1280, 800), theme.widgets(1.0))
    container = UIScrollingContainer(pygame.Rect(0, 0, WIDTH, 740), manager)
    written = noted(pen, monkeypatch)
    levels = [load(level_catalog.find(name)) for name in level_catalog.names()]
    labelled = [(level, n, p) for level in levels for n, p in level.parameters.items()]
    for level, name, parameter in sorted(labelled, key=lambda each: len(each[2].label))[-LONGEST:]:
        area = pygame.Rect(MARGIN, 0, WIDTH, 740)
        ParameterSliders(manager, pen, container, area, {name: parameter}, level.defaults)

    assert len(written) >= 2 * LONGEST
    assert not [text for text in written if text.endswith("…")]


def test_a_long_number_keeps_off_the_column_beside_it(pen: Pen) -> None:
    card = TextColumn(pen, WIDTH)
    long = "−1.2345678 kg·m²/s"

    card.columns([(text, theme.TEXT) for text in (long, long, "2e-15")], 13)

    drawn = pygame.surfarray.array3d(card.drawn())
    for share in (COLUMNS[0], COLUMNS[0] + COLUMNS[1]):
        border = round(INDENT + share * (WIDTH - INDENT))
        assert (drawn[border - 3 : border] == theme.PANEL).all()


def test_a_speed_that_is_as_good_as_reached_is_not_told() -> None:
    session = Session(scenes.level(duration=100))
    session.toggle()

    def noted(simulated: float) -> str:
        session.pace.note(1.0, simulated, dropped=1)
        return next(play_bar.notes(session))[0]

    assert noted(0.97) == "of 100.00 s"
    assert noted(0.5).startswith("running at 0.5×, not 1×")


def test_an_energy_that_is_rounding_beside_the_rest_is_told_as_none(
    pen: Pen, monkeypatch: pytest.MonkeyPatch
) -> None:
    written = noted(pen, monkeypatch)
    start, now = Energies(50.0, 11.77, 61.77), Energies(1.2e-63, 1.962, 1.962)
    energy(pen, WIDTH, start, now, pygame.Surface((WIDTH, 60)))

    assert {"0 J", "1.962 J"} <= set(written)


def test_a_sum_of_energies_that_is_rounding_is_told_as_none(
    pen: Pen, monkeypatch: pytest.MonkeyPatch
) -> None:
    written = noted(pen, monkeypatch)
    total(pen, WIDTH, Energies(0.0, 0.0, 0.0), Energies(7.3, -7.3, 1.4e-14))

    assert "0 J, Δ 10⁻¹⁴ J" in written
