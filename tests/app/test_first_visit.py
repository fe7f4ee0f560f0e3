"""The first visit to the window: from a search to a film, by mouse and keyboard alone."""

from math import cos, pi, sqrt
from pathlib import Path

import numpy as np
import pygame
import pytest

from sandbox.app.files import save_folder
from sandbox.app.files.challenge_stars import ChallengeStars
from sandbox.app.pages.graph.chosen_quantities import Choice
from sandbox.app.pages.graph.panel import GraphPage
from sandbox.app.pages.predict.panel import PredictPage
from sandbox.app.pages.predict.prediction_in_progress import PredictionWorker
from sandbox.app.pages.share.background_film import FilmWorker
from sandbox.app.pages.share.panel import SharePage
from tests.app.person import Person, until

SPEED = sqrt(2 * 9.81 * (sqrt(1 - 0.02**2) - cos(30 * pi / 180)))
"""The speed of the cradle's last ball after the impact [m/s]."""


def find(person: Person, words: str) -> None:
    """Open the level that a search on the home page finds first."""
    person.press(pygame.K_F2)
    person.press(pygame.K_SLASH, "/")
    person.type(words)
    person.press(pygame.K_RETURN, "\r")
    person.wait(0.1)


def play(person: Person) -> None:
    """Play a run to its end."""
    person.press(pygame.K_SPACE, " ")
    until(person, lambda: not person.session.playing)
    person.wait(0.2)


@pytest.mark.sweep
@pytest.mark.all_levels
def test_everything_one_would_try_first_works(
    person: Person, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(save_folder, "folder", lambda: tmp_path / "documents")
    find(person, "cradle")
    assert person.session.level.title == "Newton's cradle"

    # lift two balls: two swing out on the other side
    person.set_to("n", "2")
    play(person)
    assert person.session.at_end

    # the forces on the last ball are its weight and that of its rod
    person.press(pygame.K_j, "j")
    row = list(person.session.level.bodies).index("ball5")
    x, y = person.session.world.snapshot.position[row]
    person.click(person.on_screen((float(x), float(y))))
    assert person.session.looking.body(person.session.level) == "ball5"

    # graph its speed beside that of the next, and go back to the impact on the graph
    person.press(pygame.K_d, "d")
    graph = person.page(GraphPage)
    person.click(graph.sought.rect)
    person.type("ball4.speed")
    person.wait(0.1)
    assert graph.up.item_list_container is not None
    (shown,) = graph.up.item_list_container.elements
    person.click(shown.rect)
    person.wait(0.1)
    drawn = person.window.workers.of(Choice).up(person.session)
    assert drawn == ("ball5.speed", "ball4.speed")
    line = person.page(GraphPage)
    left = line._graphs.rect.left + line._zooming.graphs[0].place.x
    impact = left + float(line._zooming.graphs[0].across.pixels(np.array(pi / 2 / sqrt(9.81))))
    person.click((impact, line._graphs.rect.top + line._zooming.graphs[0].place.centery))
    until(person, lambda: person.session.sought is None)
    assert person.session.t == pytest.approx(pi / 2 / sqrt(9.81), abs=0.03)

    # predict that speed, from the start
    person.press(pygame.K_HOME)
    person.press(pygame.K_q, "q")
    person.click(person.page(PredictPage).button.rect)
    person.type("1.6")
    person.press(pygame.K_RETURN, "\r")
    predicting = person.window.workers.of(PredictionWorker)
    until(person, lambda: not person.session.playing and not predicting.running)
    assert predicting.outcome is not None
    assert predicting.outcome.simulated == pytest.approx(SPEED, rel=1e-4)
    assert predicting.outcome.verdict == "within 5 %"

    # win a challenge
    find(person, "stop dead")
    person.set_to("m2", "2")
    person.set_to("v1", "3")
    play(person)
    assert ChallengeStars().stars("Stop dead") == 3

    # and take a film of it along
    person.press(pygame.K_w, "w")
    person.click(person.page(SharePage).button("GIF").rect)
    until(person, lambda: not person.window.workers.of(FilmWorker).running)
    (file,) = (tmp_path / "documents").iterdir()
    assert file.suffix == ".gif"
    assert file.read_bytes()[:4] == b"GIF8"
