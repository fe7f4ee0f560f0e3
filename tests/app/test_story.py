"""The first three minutes of one who has read nothing: only what is visible is clicked on.

Keys are used for words and numbers alone. `CLICKS` says how many clicks the way takes.
"""

from pathlib import Path

import pygame
import pytest

from sandbox.app import main
from sandbox.app.files import save_folder
from sandbox.app.files.challenge_stars import ChallengeStars
from sandbox.app.pages.graph.chosen_quantities import Choice
from sandbox.app.pages.predict.panel import PredictPage
from sandbox.app.pages.predict.prediction_in_progress import PredictionWorker
from sandbox.app.pages.share.background_film import FilmWorker
from sandbox.app.pages.share.panel import SharePage
from sandbox.model.shapes import XY
from tests.app.person import Person, until

CLICKS = 20
"""The clicks of the whole way, drags included."""


class Newcomer(Person):
    """A person who counts clicks, and clicks only within the window."""

    clicks = 0

    def click(self, place: XY | pygame.Rect) -> None:
        """Click on a place that can be seen."""
        window = self.window.surface.get_rect()
        assert window.contains(place) if isinstance(place, pygame.Rect) else True
        self.clicks += 1
        super().click(place)

    def drag(self, start: XY, end: XY, which: int = 1, let_go: bool = True) -> None:
        """Drag something."""
        self.clicks += 1
        super().drag(start, end, which, let_go)

    def bar(self, command: str) -> None:
        """Click on a button of the bar below."""
        self.click(self.window.panels.controls.button(command).rect)

    def tab(self, page: str) -> None:
        """Click on the tab of a page."""
        self.click(self.side.tab(f"{page} page").rect)

    def ball(self, number: int) -> XY:
        """Return where a ball is in the window [px]."""
        row = list(self.session.level.bodies).index(f"ball{number}")
        x, y = self.session.world.snapshot.position[row].tolist()
        return self.on_screen((x, y))

    def run(self) -> None:
        """Click on Play, and watch the run to its end."""
        self.bar("play")
        assert self.session.playing
        until(self, lambda: not self.session.playing)

    def fill_in(self, name: str, text: str) -> None:
        """Click into the field of a parameter, and type."""
        self.click(self.side.parameters.row(name).field.rect)
        self.type(text)


@pytest.mark.sweep
@pytest.mark.all_levels
@pytest.mark.parametrize("size", [(1280, 800), (900, 600)], ids=["large", "small"])
def test_the_story_of_three_minutes_is_told_by_visible_buttons(
    person: Person, size: tuple[int, int], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(save_folder, "folder", lambda: tmp_path / "documents")
    newcomer = Newcomer(person.window)
    newcomer.resize(size)
    newcomer.window.open_level(main.FIRST)
    newcomer.window.do("home")
    newcomer.wait(0.1)

    find_the_cradle(newcomer)
    lift_a_second_ball(newcomer)
    see_the_forces_on_the_last_ball(newcomer)
    go_back_to_the_impact_on_the_graph(newcomer)
    predict_the_speed(newcomer)
    win_a_challenge(newcomer)
    save_a_film(newcomer)

    (file,) = (tmp_path / "documents").iterdir()
    assert file.read_bytes()[:4] == b"GIF8"
    assert newcomer.clicks <= CLICKS


def find_the_cradle(newcomer: Newcomer) -> None:
    newcomer.click(newcomer.listed.field.rect)
    newcomer.type("cradle")
    newcomer.wait(0.2)
    newcomer.click(newcomer.window.panels.home.card_rect(0))
    newcomer.wait(0.2)
    assert newcomer.session.level.title == "Newton's cradle"


def lift_a_second_ball(newcomer: Newcomer) -> None:
    """The first one is lifted already: two swing out on the other side."""
    (x, y), (first, top) = newcomer.ball(2), newcomer.ball(1)
    newcomer.drag((x, y), (first + 1.4 * (newcomer.ball(3)[0] - x), (y + top) / 2))
    newcomer.run()
    reached = newcomer.session.trail.points[..., 0].max(axis=0)
    rows = list(newcomer.session.level.bodies)
    assert reached[rows.index("ball4")] > 0.7
    assert reached[rows.index("ball3")] < 0.5


def see_the_forces_on_the_last_ball(newcomer: Newcomer) -> None:
    newcomer.tab("forces")
    newcomer.click(newcomer.ball(5))
    newcomer.wait(0.1)
    assert newcomer.session.looking.body(newcomer.session.level) == "ball5"
    assert "force weight " in "".join(newcomer.window.stage.view.kept)


def go_back_to_the_impact_on_the_graph(newcomer: Newcomer) -> None:
    newcomer.tab("graph")
    newcomer.wait(0.2)
    assert newcomer.window.workers.of(Choice).up(newcomer.session) == ("ball5.speed",)
    session, track = newcomer.session, newcomer.window.panels.controls._track  # type: ignore[attr-defined]
    blow = next(b for b in session.run.marks.shown if "ball5" in b.names)
    newcomer.click((track.x + track.width * blow.steps / session.span, track.bottom + 6))
    until(newcomer, lambda: newcomer.session.sought is None)
    assert newcomer.session.t == pytest.approx(blow.t, abs=0.01)


def predict_the_speed(newcomer: Newcomer) -> None:
    newcomer.tab("predict")
    newcomer.click(newcomer.page(PredictPage).button.rect)
    newcomer.type("1.4")
    newcomer.run()
    predicting = newcomer.window.workers.of(PredictionWorker)
    until(newcomer, lambda: not predicting.running)
    assert predicting.predicted == pytest.approx(1.4)
    assert predicting.outcome is not None


def win_a_challenge(newcomer: Newcomer) -> None:
    listed = newcomer.window.panels.list
    newcomer.click(listed.link_button("home").rect) if listed else newcomer.bar("home")
    newcomer.bar("challenges")
    newcomer.wait(0.5)
    cards = [level.title for level, _ in newcomer.window.panels.home.grid.cards]
    newcomer.click(newcomer.window.panels.home.card_rect(cards.index("Into the bucket")))
    newcomer.wait(0.2)
    newcomer.fill_in("speed", "13.3")
    newcomer.fill_in("angle", "45")
    newcomer.run()
    newcomer.wait(0.2)
    assert ChallengeStars().stars("Into the bucket") == 3


def save_a_film(newcomer: Newcomer) -> None:
    newcomer.tab("share")
    newcomer.click(newcomer.page(SharePage).button("GIF").rect)
    until(newcomer, lambda: not newcomer.window.workers.of(FilmWorker).running)
