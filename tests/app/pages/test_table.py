"""The table of the graphed quantities."""

from pathlib import Path

import numpy as np
import pygame
import pytest

from sandbox.app.drawing.text import Pen
from sandbox.app.files import save_folder
from sandbox.app.pages.table import card
from sandbox.app.pages.table.panel import TablePage
from sandbox.app.runs.session import Session
from sandbox.app.words import formatting
from sandbox.model import level_catalog
from sandbox.model.loading import load
from tests.app.person import Person
from tests.app.writing import noted


@pytest.fixture
def seated(person: Person, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Person:
    """A person who has opened the table after half a second of a throw."""
    monkeypatch.setattr(save_folder, "folder", lambda: tmp_path / "files")
    person.window.open_level("kinematics/projectile")
    for _ in range(30):
        person.press(pygame.K_RIGHT)
    person.press(pygame.K_1, "1")
    return person


@pytest.mark.parametrize("count", [1, 2, 24, 25, 1000])
def test_the_instants_are_few_and_the_last_is_one_of_them(count: int) -> None:
    shown = list(card.instants(np.arange(count) / 240))

    assert len(shown) <= card.ROWS + 1
    assert (shown[0], shown[-1]) == (0, count - 1)
    assert len(set(shown)) == len(shown)


@pytest.mark.parametrize("rate", [60, 240, 234.1])
def test_the_instants_are_those_nearest_to_round_times(rate: float) -> None:
    """Kepler's ellipse was told at 0.08542 s, 0.1708 s, 0.2562 s."""
    t = np.arange(round(2 * rate) + 1) / rate

    shown = t[card.instants(t)][:-1]

    assert np.abs(shown - 0.1 * np.arange(len(shown))).max() <= 0.5 / rate + 1e-12
    assert len(shown) in (20, 21)


def test_a_ball_at_rest_has_no_speed_in_the_table(
    pen: Pen, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The last ball of the cradle had 4.9×10⁻¹⁴ m/s before the impact."""
    session = Session(load(level_catalog.find("momentum/cradle")))
    for _ in range(400):
        session.step()
    written = noted(pen, monkeypatch)
    card.values(pen, 300, session, ["ball5.speed"], {})

    assert not [text for text in written if "10⁻¹" in text]
    assert any(text.startswith("1.6") for text in written)  # after it


def test_angles_are_in_degrees_and_so_is_their_heading(
    pen: Pen, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The heading was rad/s above values in degrees per second, each with its unit."""
    session = Session(load(level_catalog.find("rotation/rolling")))
    for _ in range(60):
        session.step()
    written = noted(pen, monkeypatch)
    card.values(pen, 300, session, ["disc.angular_velocity"], {})

    assert "°/s" in written
    assert "rad/s" not in written
    spin = session.history.snapshots.angular_velocity[-1]
    told = formatting.quantity(
        float(spin[list(session.world.scene.bodies).index("disc")]), "rad/s", card.DIGITS
    )
    assert told.removesuffix("°/s") in written


@pytest.mark.sweep
def test_the_file_has_what_is_graphed_at_every_instant(seated: Person, tmp_path: Path) -> None:
    seated.click(seated.page(TablePage).save.rect)

    (path,) = (tmp_path / "files").glob("*.csv")
    lines = [x for x in path.read_text(encoding="utf-8").splitlines() if not x.startswith("#")]
    found = np.array([[float(cell) for cell in line.split(",")] for line in lines[1:]])
    states = seated.session.history.snapshots
    assert lines[0].startswith("t [s],ball.")
    assert found.shape[0] == 31
    np.testing.assert_array_equal(found[:, 0], states.t)


def test_the_unit_of_a_quantity_with_a_long_name_is_written(
    pen: Pen, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Name and unit were shortened as one text, which lost the unit."""
    session = Session(load(level_catalog.find("newton/atwood")))
    written = noted(pen, monkeypatch)

    card.values(pen, 278, session, ["left.acceleration.y", "string.tension"], {})

    assert {"m/s²", "N"} <= set(written)


def test_another_instant_is_another_table(seated: Person) -> None:
    page = seated.page(TablePage)
    before = pygame.image.tobytes(page._drawn(), "RGB")
    seated.press(pygame.K_RIGHT)
    assert pygame.image.tobytes(page._drawn(), "RGB") != before
