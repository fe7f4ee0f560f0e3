"""Still pictures, drawn without a window."""

from pathlib import Path

import numpy as np
import pygame
import pytest

from sandbox.app import level_picture
from sandbox.app.level_picture import render, save_picture
from sandbox.model import level_catalog
from sandbox.model.loading import parse
from sandbox.physics.state.simulation_errors import SimulationError
from tests.app import scenes
from validation.case import textbook


@pytest.mark.sweep
@pytest.mark.parametrize("name", level_catalog.names())
def test_every_level_is_drawn(name: str) -> None:
    """Those of the textbook at their most telling moment, the hard ones soon after their start."""
    level = textbook(name)
    at = None if not name.startswith("hard/") else 20 / level.stepping.rate

    level_picture = render(level, level.defaults, at)

    colors = np.unique(pygame.surfarray.array2d(level_picture)[::3, ::7])
    assert level_picture.get_size() == (1280, 720)
    assert len(colors) > 20


def test_a_picture_shows_the_time_that_is_asked_for() -> None:
    level = scenes.level()

    def height(at: float) -> float:
        level_picture = render(level, level.defaults, at=at)
        rows = [y for y in range(720) if level_picture.get_at((478, y))[:3] == (255, 0, 0)]
        return sum(rows) / len(rows)

    assert height(0.9) > height(0.1) + 100


def test_a_level_without_parameters_has_no_heading_for_them(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    level = textbook("hard/elastic-ball")
    monkeypatch.setattr(
        level_picture, "settings", lambda *_: pytest.fail("there is nothing to list")
    )

    render(level, level.defaults, at=0.0)


def test_the_same_level_gives_the_same_picture() -> None:
    level = scenes.level()

    first, second = (render(level, level.defaults) for _ in range(2))

    assert pygame.image.tobytes(first, "RGB") == pygame.image.tobytes(second, "RGB")


def test_a_picture_is_written_whole_and_leaves_nothing_beside_it(tmp_path: Path) -> None:
    level = scenes.level()

    save_picture(level, level.defaults, tmp_path / "a.png", size=(800, 600))

    assert [path.name for path in tmp_path.iterdir()] == ["a.png"]
    assert pygame.image.load(tmp_path / "a.png").get_size() == (800, 600)


def test_a_run_that_has_to_stop_is_no_picture(tmp_path: Path) -> None:
    level = parse(scenes.runaway())

    with pytest.raises(SimulationError):
        save_picture(level, level.defaults, tmp_path / "a.png", at=9)

    assert not list(tmp_path.iterdir())
